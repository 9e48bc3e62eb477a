// Dispatches x latency, waves over SIMDs, bytes over bandwidth.
#include "sinew/predict/predict.hpp"

#include "app/guard.hpp"
#include "sinew/predict/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

namespace sinew::tools {

namespace {

constexpr double wavesOfTable = 32; // most that a SIMD holds, in kernels.csv
constexpr std::size_t shownPasses = 12;

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    for (std::size_t end; (end = text.find(at)) != std::string_view::npos; text.remove_prefix(end + 1))
        parts.push_back(text.substr(0, end));
    parts.push_back(text);
    return parts;
}

std::optional<double> numberAboveZero(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isWhole = error == std::errc{} && end == text.data() + text.size();
    return isWhole && std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

// Lines other than comments and the heading: a name, then numbers.
template <typename Row, std::size_t columns>
std::vector<Row> readTable(std::string_view text, const std::string& file, std::string_view heading,
                           const std::array<double Row::*, columns>& members, std::string Row::*name) {
    const auto fail = [&](std::size_t line, const std::string& why) {
        throw app::Failure(app::badInput, fmt::format("cannot read cards: {}:{}: {}", file, line, why));
    };
    std::vector<Row> rows;
    bool hasHeading = false;
    std::size_t number = 0;
    for (std::string_view line : split(text, '\n')) {
        ++number;
        if (line.empty() || line.front() == '#') continue;
        if (!std::exchange(hasHeading, true)) {
            if (line != heading) fail(number, fmt::format("expected the heading {}", heading));
            continue;
        }
        const std::vector<std::string_view> fields = split(line, ',');
        if (fields.size() != columns + 1) fail(number, fmt::format("expected {} fields", columns + 1));
        Row row;
        row.*name = std::string(fields[0]);
        for (std::size_t i = 0; i < columns; ++i) {
            const auto value = numberAboveZero(fields[i + 1]);
            if (!value) fail(number, fmt::format("\"{}\" is no number above 0", fields[i + 1]));
            row.*members[i] = *value;
        }
        rows.push_back(std::move(row));
    }
    if (rows.empty()) fail(number, "there is no card");
    return rows;
}

struct NamedCost : KernelCost {
    std::string name;
};

double itemsOf(const sim::Pass& pass) {
    return pass.kind == sim::PassKind::dispatch ? pass.items : 0;
}

double bytesOf(const sim::StepProgram& program, const sim::Pass& pass) {
    double bytes = 0;
    for (const sim::BufferUse& use : pass.uses) {
        const auto size = static_cast<double>(program.buffers[use.buffer.index].bytes());
        bytes += use.access == vk::Access::readWrite ? 2 * size : size;
    }
    return bytes;
}

// The costs of a program's kernels, by index.
class Costs {
public:
    Costs(const sim::StepProgram& program, const KernelCosts& known) {
        KernelCost longest;
        for (const auto& [name, cost] : known)
            if (cost.latency > longest.latency) longest = cost;
        for (const sim::KernelUse& use : program.kernels) {
            const auto found = known.find(std::string_view(use.code->name));
            costs_.push_back(found == known.end() ? longest : found->second);
            if (found == known.end()) unknown.emplace_back(use.code->name);
        }
        std::ranges::sort(unknown);
        unknown.erase(std::ranges::unique(unknown).begin(), unknown.end());
    }
    const KernelCost& of(const sim::Pass& pass) const {
        static const KernelCost memoryOnly{.waves = wavesOfTable, .latency = 1, .issue = 1};
        return pass.kind == sim::PassKind::dispatch ? costs_[pass.kernel] : memoryOnly;
    }
    std::vector<std::string> unknown;

private:
    std::vector<KernelCost> costs_;
};

double leastLaunchUs(const Card& card, const sim::Pass& pass, sim::Recording recording) {
    if (!sim::hasBarrier(recording, pass)) return 0;
    return pass.isIndirect ? card.emptyUs : card.dispatchUs;
}

const char* toText(Bound bound) {
    constexpr const char* names[] = {"the dispatch", "latency", "instructions", "memory"};
    return names[static_cast<std::size_t>(bound)];
}

std::string milliseconds(double least, double most) {
    return most - least < 0.0005 * most ? fmt::format("{:.3f}", most / 1000)
                                        : fmt::format("{:.3f} to {:.3f}", least / 1000, most / 1000);
}

std::string tableOf(const Prediction& prediction) {
    std::string text =
        fmt::format("  {:<34} {:>6} {:>18}  {}\n", "pass", "number", "ms a step", "most of it is");
    for (std::size_t i = 0; i < std::min(shownPasses, prediction.passes.size()); ++i) {
        const PassCost& pass = prediction.passes[i];
        text += fmt::format("  {:<34} {:>6} {:>18}  {}\n", pass.label, pass.count,
                            milliseconds(pass.leastUs, pass.mostUs), toText(pass.bound));
    }
    if (prediction.passes.size() > shownPasses)
        text += fmt::format("  and {} others\n", prediction.passes.size() - shownPasses);
    return text + fmt::format("  all: {} ms, {} dispatches ({} of them indirect), {} barriers\n",
                              milliseconds(prediction.leastUs, prediction.mostUs), prediction.dispatches,
                              prediction.indirect, prediction.barriers);
}

} // namespace

std::vector<Card> shippedCards() {
    return readCards(tables::cards, "cards.csv");
}

KernelCosts shippedKernels() {
    KernelCosts costs;
    const std::array<double NamedCost::*, 3> members{&NamedCost::waves, &NamedCost::latency,
                                                     &NamedCost::issue};
    for (const NamedCost& row : readTable<NamedCost>(tables::kernels, "kernels.csv",
                                                     "kernel,waves,latency,issue", members, &NamedCost::name))
        costs[row.name] = row;
    return costs;
}

std::vector<Card> readCards(std::string_view text, const std::string& file) {
    const std::array members{&Card::simds,     &Card::lanes,      &Card::waves,  &Card::ghz,
                             &Card::gigabytes, &Card::dispatchUs, &Card::emptyUs};
    return readTable<Card>(text, file, "name,simds,lanes,waves,ghz,gb_s,dispatch_us,empty_us", members,
                           &Card::name);
}

std::vector<Card> loadCards(const std::string& file) {
    std::error_code error;
    std::ifstream stream;
    if (!std::filesystem::is_directory(file, error)) stream.open(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (!stream.is_open() || stream.bad())
        throw app::Failure(app::badInput,
                           "cannot read cards: " + file +
                               ": it is missing, no file, or not to be read: name a table like "
                               "tools/sinew/predict/cards.csv");
    std::erase(text, '\r');
    return readCards(text, file);
}

Card findCard(const std::vector<Card>& cards, const std::string& name) {
    std::string names;
    for (const Card& card : cards) {
        if (card.name == name) return card;
        names += (names.empty() ? "" : ", ") + card.name;
    }
    throw app::Failure(app::wrongUsage, fmt::format("--predict: no card \"{}\": choose {}", name, names));
}

double workUs(const Card& card, const KernelCost& kernel, double items, double bytes, Bound& bound) {
    const double waves = std::ceil(items / card.lanes);
    const double held = std::max(1.0, std::floor(card.waves * kernel.waves / wavesOfTable));
    const double rounds = std::ceil(waves / (card.simds * held));
    const double cycle = 1e-3 / card.ghz; // us
    const std::array times{std::pair(Bound::latency, rounds * kernel.latency * cycle),
                           std::pair(Bound::issue, waves / card.simds * kernel.issue * cycle),
                           std::pair(Bound::memory, bytes / card.gigabytes * 1e-3)};
    const auto longest = *std::ranges::max_element(times, {}, [](const auto& time) { return time.second; });
    bound = longest.first;
    return longest.second;
}

double launchUs(const sim::StepProgram& program, const Card& card, sim::Recording recording) {
    double us = 0;
    for (const sim::Pass& pass : program[sim::List::step]) us += leastLaunchUs(card, pass, recording);
    return us;
}

Prediction predict(const sim::StepProgram& program, const Card& card, const KernelCosts& kernels,
                   sim::Recording recording) {
    Costs costs(program, kernels);
    Prediction prediction;
    std::map<std::string, PassCost> byLabel;
    for (const sim::Pass& pass : program[sim::List::step]) {
        if (!sim::isIn(recording, pass)) continue;
        PassCost& cost = byLabel[pass.label];
        const bool waits = sim::hasBarrier(recording, pass);
        const double launch = waits ? card.dispatchUs : 0;
        const double work = workUs(card, costs.of(pass), itemsOf(pass), bytesOf(program, pass), cost.bound);
        if (work < launch) cost.bound = Bound::dispatch;
        if (work > prediction.longestUs) {
            prediction.longestUs = work;
            prediction.longest = pass.label;
        }
        cost.label = pass.label;
        ++cost.count;
        cost.mostUs += launch + work;
        cost.leastUs += pass.isIndirect ? leastLaunchUs(card, pass, recording) : launch + work;
        prediction.dispatches += pass.kind == sim::PassKind::dispatch ? 1 : 0;
        prediction.indirect += pass.isIndirect ? 1 : 0;
        prediction.barriers += waits ? 1 : 0;
    }
    for (auto& [label, cost] : byLabel) {
        prediction.leastUs += cost.leastUs;
        prediction.mostUs += cost.mostUs;
        prediction.passes.push_back(std::move(cost));
    }
    std::ranges::stable_sort(prediction.passes, std::greater{}, &PassCost::mostUs);
    prediction.unknown = std::move(costs.unknown);
    return prediction;
}

std::string predictionText(const sim::StepProgram& program, const Card& card, const KernelCosts& kernels) {
    const Prediction whole = predict(program, card, kernels, sim::plainStep);
    const Prediction calm = predict(program, card, kernels, sim::calmStep);
    std::string text =
        fmt::format("predicted for {}, not measured; kernels as compiled for an AMD GPU\n", card.name);
    if (whole.indirect > 0) text += "from empty indirect dispatches to full ones\n";
    for (const std::string& name : whole.unknown)
        text += fmt::format("no cost is known of {}: counted as the longest kernel\n", name);
    const bool isSame = calm.dispatches == whole.dispatches;
    if (!isSame) text += "a calm step, which makes contact lists at its start alone:\n" + tableOf(calm);
    text +=
        (isSame ? "a step:\n" : "a step that may make contact lists in every substep:\n") + tableOf(whole);
    text += fmt::format("  longest dispatch: {}, {:.3g} ms at most\n", whole.longest, whole.longestUs / 1000);
    if (whole.longestUs > longestAllowedUs)
        text += fmt::format("warning: a dispatch of more than {:g} ms: other programs wait for it, and a "
                            "driver may reset the device\n",
                            longestAllowedUs / 1000);
    return text;
}

} // namespace sinew::tools
