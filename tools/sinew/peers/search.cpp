#include "sinew/peers/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::tools::peers {

namespace {

constexpr std::size_t fewestVariants = 4, timedVariants = 2;
constexpr double sure = 1; // an error of one body size, or of the whole motion: no need to run on

/// The counts of a variant between which its error passes a target.
struct Bracket {
    const Probe *below = nullptr,
                *reached = nullptr; ///< the largest that misses it, the smallest that does not
};

class Finder {
public:
    explicit Finder(const Search& search) : search_(search) {}

    SearchResult find() {
        doubleSweeps();
        for (std::size_t target = 0; target < search_.targets.size(); ++target) bisect(target);
        return std::move(result_);
    }

private:
    bool isOver() {
        if (search_.isOver()) result_.isComplete = false;
        return !result_.isComplete;
    }

    const Probe& probe(std::size_t variant, std::uint32_t count, double enough) {
        for (const Probe& known : result_.probes)
            if (known.variant == variant && known.count == count) return known;
        const Variant& tried = search_.variants[variant];
        result_.probes.push_back(
            {variant, count, tried.sweeps(count), search_.errorOf(tried.at(count), enough)});
        return result_.probes.back();
    }

    void doubleSweeps() {
        std::vector<std::size_t> alive(search_.variants.size());
        for (std::size_t i = 0; i < alive.size(); ++i) alive[i] = i;
        for (std::uint32_t sweeps = 1;; sweeps = std::min(2 * sweeps, search_.mostSweeps)) {
            std::vector<std::pair<double, std::size_t>> errors;
            for (const std::size_t i : alive) {
                const Variant& variant = search_.variants[i];
                const bool hasCount = variant.isWholeFrame ? sweeps > 1 : sweeps % variant.iterations == 0;
                const std::uint32_t count = variant.isWholeFrame ? sweeps : sweeps / variant.iterations;
                if (hasCount && isOver()) return;
                const double none = std::numeric_limits<double>::infinity();
                errors.emplace_back(hasCount ? probe(i, count, sure).error.value_or(none) : 0.0, i);
            }
            if (std::ranges::any_of(
                    result_.probes,
                    [&](const Probe& p) { return p.error && *p.error <= search_.targets.back(); }) ||
                sweeps == search_.mostSweeps)
                return;
            std::ranges::stable_sort(errors, {}, &std::pair<double, std::size_t>::first);
            errors.resize(std::min(errors.size(), std::max(fewestVariants, (errors.size() + 1) / 2)));
            alive.clear();
            for (const auto& [error, variant] : errors) alive.push_back(variant);
        }
    }

    Bracket bracket(std::size_t variant, double target) const {
        Bracket result;
        for (const Probe& p : result_.probes)
            if (p.variant == variant && p.error && *p.error <= target &&
                (!result.reached || p.count < result.reached->count))
                result.reached = &p;
        if (!result.reached) return result;
        for (const Probe& p : result_.probes)
            if (p.variant == variant && p.count < result.reached->count &&
                (!result.below || p.count > result.below->count))
                result.below = &p;
        return result;
    }

    /// The sweeps at which a variant is expected to reach the target.
    double expected(std::size_t variant, double target) const {
        const Bracket ends = bracket(variant, target);
        const auto most = static_cast<double>(ends.reached->sweeps);
        if (!ends.below || !ends.below->error || *ends.reached->error <= 0) return most;
        const double share =
            std::log(*ends.below->error / target) / std::log(*ends.below->error / *ends.reached->error);
        const auto least = static_cast<double>(ends.below->sweeps);
        return least * std::pow(most / least, share);
    }

    void bisect(std::size_t target) {
        const double error = search_.targets[target];
        std::vector<std::size_t> best;
        for (std::size_t i = 0; i < search_.variants.size(); ++i)
            if (bracket(i, error).reached) best.push_back(i);
        std::ranges::stable_sort(best, {}, [&](std::size_t i) { return expected(i, error); });
        best.resize(std::min(best.size(), timedVariants));
        for (const std::size_t variant : best) {
            for (;;) {
                const Bracket ends = bracket(variant, error);
                const std::uint32_t high = ends.reached->count, low = ends.below ? ends.below->count : 0;
                if (high - low <= std::max(1u, high / 24) || isOver()) break;
                const auto middle =
                    static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(low) * high)));
                probe(variant, std::clamp(middle, low + 1, high - 1), error);
            }
            const Probe& found = *bracket(variant, error).reached;
            result_.candidates.push_back({target, search_.variants[variant].at(found.count), *found.error});
        }
    }

    const Search& search_;
    SearchResult result_;
};

} // namespace

sim::Settings Variant::at(std::uint32_t count) const {
    sim::Settings settings = tuning;
    settings.substeps = isWholeFrame ? 1 : count;
    settings.iterations = isWholeFrame ? count : iterations;
    return settings;
}

std::uint64_t Variant::sweeps(std::uint32_t count) const {
    return isWholeFrame ? count : std::uint64_t{count} * iterations;
}

SearchResult findCheapest(const Search& search) {
    return Finder(search).find();
}

} // namespace sinew::tools::peers
