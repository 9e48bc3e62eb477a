// A scene takes turns with itself without contacts: radii 0 and no faces, otherwise equal. Both restart
// before each round, so that both are measured in the same steps, whatever their speed.
#include "sinew/bench_contacts.hpp"

#include "app/guard.hpp"
#include "common/layout.h"
#include "scenes/load.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/gpu_tune.hpp"
#include "sinew/predict/predict.hpp"
#include "sinew/report.hpp"
#include "sinew/runner.hpp"
#include "sinew/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace sinew::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t stepsOfTurn = 4;
constexpr const char* predictedCard = "h200"; // of the column "GPU us"

std::string organText(const char* gravity, const char* height, const char* below) {
    return fmt::format(R"(damping = 1.5
gravity = [0, {}, 0]
[solver]
substeps = 37
[[mesh]]
name = "organ"
generate = "organ"
detail = 49
size = 0.4
center = [0, {}, 0]
rotation = [0, 30, 0]
resolution = 20
young_modulus = 2e5
density = 1000
collides = true
{})",
                       gravity, height, below);
}

std::string clothText(const char* gravity, const char* held) {
    return fmt::format(R"(damping = 0.2
gravity = [0, {}, 0]
[solver]
substeps = 24
[[cloth]]
name = "sheet"
size = [60, 60]
spacing = 0.02
origin = [-0.6, 2, 0]
area_density = 0.3
thickness = 0.01
{})",
                       gravity, held);
}

std::string boxText() {
    return R"([solver]
substeps = 32
[[box]]
name = "box"
particles = [14, 14, 14]
spacing = 0.04
center = [0, 0, 0]
young_modulus = 1e6
density = 1000
collides = true
)";
}

scenes::LoadedScene ownScene(const std::string& text) {
    return scenes::loadText(text, "bench");
}

struct ContactRow {
    const char* name;
    scenes::LoadedScene (*load)();
    std::uint64_t settle, steps; // steps before the measured ones; measured steps
    bool isPair = false;         // also measured without contacts
};

const ContactRow rowsOfContacts[] = {
    {"organ in free fall", [] { return ownScene(organText("-9.81", "0.2", "")); }, 8, 32, true},
    {"box 14^3 in free fall", [] { return ownScene(boxText()); }, 8, 32, true},
    {"organ at rest, no gravity", [] { return ownScene(organText("0", "0.2", "")); }, 8, 32, true},
    {"organ at rest on a plane",
     [] { return ownScene(organText("-9.81", "0.14", "[[plane]]\nfriction = 0.4\n")); }, 160, 32, true},
    {"cloth 60^2 swinging",
     [] { return ownScene(clothText("-9.81", "pinned = [\"first_row_start\", \"first_row_end\"]\n")); }, 8,
     32, true},
    {"cloth 60^2 at rest, no gravity", [] { return ownScene(clothText("0", "")); }, 8, 32, true},
    {"cloth_links_on_sphere", [] { return scenes::loadBuiltIn("cloth_links_on_sphere"); }, 40, 40},
    {"cloth_fold", [] { return scenes::loadBuiltIn("cloth_fold"); }, 40, 40},
    {"clutter_bodies, falling", [] { return scenes::loadBuiltIn("clutter_bodies"); }, 8, 40},
    {"stack", [] { return scenes::loadBuiltIn("stack"); }, 8, 40},
    {"pile_8000, falling", [] { return scenes::loadBuiltIn("pile_8000"); }, 8, 40},
    {"pile_8000, at rest", [] { return scenes::loadBuiltIn("pile_8000"); }, 240, 40},
    {"clutter, 1,000 balls, 4 s", [] { return scenes::loadBuiltIn("clutter"); }, 0, 240},
    {"clutter, 8,000 balls, 4 s", [] { return scenes::loadBuiltIn("pile_8000"); }, 0, 240},
};

sim::Scene withoutContacts(sim::Scene scene) {
    for (sim::Particle& particle : scene.particles) particle.radius = 0;
    scene.faces.clear();
    return scene;
}

std::uint64_t bytesOf(const sim::StepProgram& program) {
    std::uint64_t sum = 0;
    for (const sim::BufferSpec& buffer : program.buffers) sum += buffer.bytes();
    return sum;
}

// A scene with or without contacts, and its results.
class ContactRun {
public:
    ContactRun(Session& session, sim::Scene scene, const sim::Settings& settings)
        : session_(session), scene_(std::move(scene)),
          runner_(session, scene_, sim::tuned(session.device, session.queue, scene_, settings)) {}

    void begin(std::uint64_t settle) {
        runner_.restart();
        runner_.advance(settle, 1); // one step in flight: each time is that of a whole step
        builds_ = builds();
        lists_ = runner_.lists();
    }
    void takeTurn(std::uint64_t count) { runner_.advance(count, 1); }
    void end(std::uint64_t settle) {
        const std::vector<double>& ms = runner_.frameMs();
        for (std::size_t i = settle; i < ms.size(); ++i) stepMs_.push_back(ms[i]);
        const std::uint64_t now = builds(); // a simulation that has grown counts from 0 again
        listBuilds_ += now < builds_ ? now : now - builds_;
        calm_ += runner_.lists().calm - lists_.calm;
        repeated_ += runner_.lists().repeated - lists_.repeated;
    }
    const sim::StepProgram& program() const { return runner_.simulation().program(); }
    Json toJson() const;

private:
    std::uint64_t builds() const {
        std::uint64_t sum = 0;
        for (const sim::GridBuffers& grid : program().grids)
            sum += session_.queue.download<sim::layout::GridBounds>(runner_.simulation().view(grid.bounds))[0]
                       .builds;
        return sum;
    }

    Session& session_;
    sim::Scene scene_;
    Runner runner_;
    std::uint64_t builds_ = 0, listBuilds_ = 0;
    ListFigures lists_; // at the start of the measured steps
    std::uint64_t calm_ = 0, repeated_ = 0;
    std::vector<double> stepMs_;
};

Json ContactRun::toJson() const {
    const Statistics step = summarise(stepMs_).value_or(Statistics{});
    const Card card = findCard(shippedCards(), predictedCard);
    const SubstepCounts counts = countSubstep(program()), calm = countSubstep(program(), sim::calmStep);
    return {{"steps", stepMs_.size()},
            {"ms_p50", step.p50},
            {"ms_min", step.min},
            {"ms_p99", step.p99},
            {"passes_per_substep", counts.passes},
            {"dispatches_per_substep", counts.direct},
            {"indirect_dispatches_per_substep", counts.indirect},
            {"barriers_per_substep", counts.barriers},
            {"list_builds", listBuilds_},
            {"gpu_dispatch_us_predicted", launchUs(program(), card, sim::plainStep)},
            {"calm",
             {{"steps", calm_},
              {"repeated_steps", repeated_},
              {"passes_per_substep", calm.passes},
              {"indirect_dispatches_per_substep", calm.indirect},
              {"barriers_per_substep", calm.barriers},
              {"gpu_dispatch_us_predicted", launchUs(program(), card, sim::calmStep)}}},
            {"finite", !runner_.divergence()}};
}

Json measureRow(Session& session, const ContactRow& row, double seconds) {
    const scenes::LoadedScene loaded = row.load();
    const sim::Scene bare = withoutContacts(loaded.scene);
    ContactRun with(session, loaded.scene, loaded.settings);
    std::optional<ContactRun> without;
    if (row.isPair) without.emplace(session, bare, loaded.settings);
    const auto forEach = [&](const auto& act) {
        act(with);
        if (without) act(*without);
    };
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    do {
        forEach([&](ContactRun& one) { one.begin(row.settle); });
        for (std::uint64_t done = 0; done < row.steps && !app::isInterrupted(); done += stepsOfTurn)
            forEach([&](ContactRun& one) { one.takeTurn(std::min(stepsOfTurn, row.steps - done)); });
        forEach([&](ContactRun& one) { one.end(row.settle); });
    } while (Clock::now() < end && !app::isInterrupted());
    const std::uint64_t more =
        bytesOf(sim::compile(loaded.scene, loaded.settings)) - bytesOf(sim::compile(bare, loaded.settings));
    Json measured{{"scene", row.name},
                  {"device", session.device.description().name},
                  {"particles", loaded.scene.particles.size()},
                  {"substeps", loaded.settings.substeps},
                  {"settled_steps", row.settle},
                  {"with", with.toJson()},
                  {"without", without ? without->toJson() : Json(nullptr)},
                  {"ratio", nullptr},
                  {"contact_bytes_per_particle",
                   static_cast<double>(more) / static_cast<double>(loaded.scene.particles.size())}};
    if (without)
        measured["ratio"] =
            measured["with"]["ms_p50"].get<double>() / measured["without"]["ms_p50"].get<double>();
    return measured;
}

} // namespace

SubstepCounts countSubstep(const sim::StepProgram& program, sim::Recording recording) {
    SubstepCounts counts;
    std::uint32_t substeps = 0;
    for (const sim::Pass& pass : program[sim::List::step]) {
        if (pass.substep == 0 || !isIn(recording, pass)) continue;
        const bool isDispatch = pass.kind == sim::PassKind::dispatch;
        substeps = std::max(substeps, pass.substep);
        counts.passes += 1;
        counts.direct += isDispatch && !pass.isIndirect ? 1 : 0;
        counts.indirect += isDispatch && pass.isIndirect ? 1 : 0;
        counts.barriers += hasBarrier(recording, pass) ? 1 : 0;
    }
    for (double* count : {&counts.passes, &counts.direct, &counts.indirect, &counts.barriers})
        *count /= std::max(1u, substeps);
    return counts;
}

std::vector<std::string> contactRows() {
    std::vector<std::string> names;
    for (const ContactRow& row : rowsOfContacts) names.emplace_back(row.name);
    return names;
}

Json measureContacts(Session& session, const std::string& only, double seconds) {
    Json measured = Json::array();
    for (const ContactRow& row : rowsOfContacts)
        if (std::string(row.name).find(only) != std::string::npos && !app::isInterrupted())
            measured.push_back(measureRow(session, row, seconds));
    return measured;
}

std::string contactsTable(const Json& measured) {
    std::string text =
        fmt::format("{:<30} {:>10} {:>10} {:>6} {:>7} {:>7} {:>11} {:>11} {:>7} {:>8} {:>11} {:>7} {:>7}\n",
                    "p50 of a step", "without ms", "ms", "ratio", "passes", "direct", "indirect", "barriers",
                    "builds", "B/part.", "GPU us", "calm %", "again");
    for (const Json& row : measured) {
        const Json& with = row["with"];
        const auto number = [&](const char* key) { return with[key].get<double>(); };
        const auto optional = [](const Json& value, const char* unit) {
            return value.is_null() ? std::string("-") : fmt::format("{:.2f}{}", value.get<double>(), unit);
        };
        const Json without = row["without"].is_null() ? Json(nullptr) : row["without"]["ms_p50"];
        const Json& calm = with["calm"];
        const auto both = [&](const char* key, int digits) {
            return fmt::format("{:.{}f}/{:.{}f}", number(key), digits, calm[key].get<double>(), digits);
        };
        text += fmt::format(
            "{:<30} {:>10} {:>10.2f} {:>6} {:>7.1f} {:>7.1f} {:>11} {:>11} {:>7.2f} {:>8.0f} "
            "{:>11} {:>7.0f} {:>7}{}\n",
            row["scene"].get<std::string>(), optional(without, ""), number("ms_p50"),
            optional(row["ratio"], ""), number("passes_per_substep"), number("dispatches_per_substep"),
            both("indirect_dispatches_per_substep", 1), both("barriers_per_substep", 1),
            number("list_builds") / std::max(1.0, number("steps")),
            row["contact_bytes_per_particle"].get<double>(), both("gpu_dispatch_us_predicted", 0),
            100 * calm["steps"].get<double>() / std::max(1.0, number("steps")),
            calm["repeated_steps"].get<std::uint64_t>(), with["finite"].get<bool>() ? "" : " diverged");
    }
    return text +
           fmt::format(
               "passes, dispatches (direct, indirect) and barriers: per substep; a/b: in a step with all "
               "passes, in a calm step; builds: list builds per step; B/part.: contact buffers per particle\n"
               "calm %: steps without list passes after their first substep; again: steps that were "
               "repeated, because such a pass or room was missing\n"
               "GPU us: predicted, not measured: launches of a step on {}, indirect dispatches empty, "
               "without "
               "the work of kernels\n",
               predictedCard);
}

} // namespace sinew::tools
