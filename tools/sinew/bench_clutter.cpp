// Each program is a pair of closures: one takes steps, one returns the positions of the balls.
#include "sinew/bench_clutter.hpp"

#include "app/guard.hpp"
#include "app/progress.hpp"
#include "scenes/load.hpp"
#include "sinew/clutter/jacobi.hpp"
#include "sinew/clutter/sequential.hpp"
#include "sinew/gpu_tune.hpp"
#include "sinew/peers/compare.hpp"
#include "sinew/report.hpp"
#include "sinew/sequential.hpp"
#include "sinew/simulation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace sinew::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t leastSteps = 240, stepsPerTurn = 8; // 4 s: the balls are at rest
constexpr const char* clutterScenes[] = {"clutter", "pile_8000"};

ClutterEntrant onDevice(Session& session, const sim::Scene& scene, sim::Settings settings,
                        std::uint32_t substeps) {
    settings.substeps = substeps;
    settings = sim::tuned(session.device, session.queue, scene, settings);
    const auto runner = std::make_shared<Runner>(session, scene, settings);
    ClutterEntrant entrant{.solver = "split",
                           .device = session.device.description().name,
                           .substeps = substeps,
                           .iterations = 1};
    entrant.advance = [runner](std::uint64_t count, std::vector<double>& ms) {
        runner->advance(count, 1); // one step in flight: each time is that of a whole step
        ms = runner->frameMs();
    };
    entrant.state = [runner] { return runner->readState(); };
    return entrant;
}

std::vector<ClutterEntrant> entrantsFor(Session& session, const scenes::LoadedScene& loaded, bool hasPeers) {
    const sim::Scene& scene = loaded.scene;
    std::vector<ClutterEntrant> entrants;
    // Two settings: as many sweeps as the device, and 4 substeps of 5 iterations, common in position based
    // dynamics.
    const std::uint32_t substeps = loaded.settings.substeps;
    entrants.push_back(onCpu("sequential",
                             std::make_shared<clutter::Sequential>(clutter::ballsOf(scene, substeps, 1)),
                             substeps, 1));
    entrants.push_back(
        onCpu("native jacobi", std::make_shared<clutter::Jacobi>(clutter::ballsOf(scene, 4, 5)), 4, 5));
    entrants.back().device = fmt::format("CPU, {} threads", clutter::Jacobi::threads);
    for (const std::uint32_t n : {substeps / 2, substeps})
        entrants.push_back(onDevice(session, scene, loaded.settings, n));
    if (hasPeers)
        for (const auto& [n, iterations] : {std::pair{1u, 10u}, std::pair{4u, 5u}})
            entrants.push_back(bulletClutter(scene, n, iterations));
    return entrants;
}

Json rowOf(const scenes::LoadedScene& loaded, const ClutterEntrant& entrant, double sequentialMs,
           double nativeMs) {
    std::vector<double> fps;
    for (const double ms : entrant.stepMs) fps.push_back(1000 / ms);
    const Statistics step = summarise(entrant.stepMs).value_or(Statistics{});
    const Statistics rate = summarise(fps).value_or(Statistics{});
    const State state = entrant.state();
    const bool isFinite =
        std::ranges::all_of(state.positions, [](const auto& x) { return std::isfinite(x[0] + x[1] + x[2]); });
    const Errors errors = measure(loaded.scene, state, {}, entrant.stepMs.size());
    const bool isOurs = entrant.solver != "bullet" && entrant.solver != "split";
    return {{"scene", "clutter"},
            {"size", std::to_string(loaded.scene.particles.size())},
            {"solver", entrant.solver},
            {"device", entrant.device},
            {"order", entrant.solver == "sequential" ? Json("natural") : Json(nullptr)},
            {"precision", entrant.solver == "bullet" ? "double" : "float"},
            {"flags", isOurs ? Json(sequentialFlags()) : Json(nullptr)},
            {"particles", loaded.scene.particles.size()},
            {"constraints", 0},
            {"substeps", entrant.substeps},
            {"iterations", entrant.iterations},
            {"steps", entrant.stepMs.size()},
            {"fps_mean", rate.mean},
            {"fps_stddev", rate.stddev},
            {"ms_mean", step.mean},
            {"ms_stddev", step.stddev},
            {"ms_min", step.min},
            {"ms_p50", step.p50},
            {"ms_p99", step.p99},
            {"ns_per_constraint_sweep", nullptr},
            {"ns_per_constraint_sweep_min", nullptr},
            {"speedup", sequentialMs / step.p50},
            {"speedup_over_best", sequentialMs / step.p50},
            {"speedup_over_native", nativeMs / step.p50},
            {"finite", isFinite},
            {"error", toJson(errors)}};
}

Json measureOne(const char* name, Session& session, double seconds, bool hasPeers) {
    const scenes::LoadedScene loaded = scenes::loadBuiltIn(name);
    std::vector<ClutterEntrant> racing = entrantsFor(session, loaded, hasPeers);
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::uint64_t steps = 0;
    while ((steps < leastSteps || Clock::now() < end) && !app::isInterrupted()) {
        for (ClutterEntrant& entrant : racing) entrant.advance(stepsPerTurn, entrant.stepMs);
        steps += stepsPerTurn;
    }
    const auto median = [&](std::size_t i) { return summarise(racing[i].stepMs).value_or(Statistics{}).p50; };
    Json rows = Json::array();
    for (const ClutterEntrant& entrant : racing) rows.push_back(rowOf(loaded, entrant, median(0), median(1)));
    return rows;
}

} // namespace

Json measureClutter(Session& session, double seconds, bool hasPeers) {
    Json rows = Json::array();
    for (const char* name : clutterScenes) {
        if (app::isInterrupted()) break;
        for (Json& row : measureOne(name, session, seconds, hasPeers)) rows.push_back(std::move(row));
    }
    return rows;
}

std::string clutterTable(const Json& rows) {
    std::string text =
        fmt::format("\n{:<8} {:>6} {:<14} {:>7} {:>17} {:>8} {:>8} {:>9} {:>9} {:>16}\n", "scene", "balls",
                    "solver", "sweeps", "ms", "p50", "p99", "speed-up", "native x", "overlap rms, max");
    for (const Json& row : rows) {
        const auto number = [&](const char* key) { return row[key].get<double>(); };
        const auto overlap = [&](const char* key) {
            const Json& depth = row["error"][key];
            return depth.is_number() ? fmt::format("{:.2f} mm", 1000 * depth.get<double>())
                                     : std::string("-");
        };
        text += fmt::format(
            "{:<8} {:>6} {:<14} {:>7} {:>8.2f} +-{:>6.2f} {:>8.2f} {:>8.2f} {:>9.2f} {:>9.2f} {:>16}\n",
            row["scene"].get<std::string>(), row["size"].get<std::string>(), row["solver"].get<std::string>(),
            fmt::format("{}x{}", row["substeps"].get<int>(), row["iterations"].get<int>()), number("ms_mean"),
            number("ms_stddev"), number("ms_p50"), number("ms_p99"), number("speedup"),
            number("speedup_over_native"),
            row["finite"].get<bool>() ? overlap("penetration_rms") + ", " + overlap("penetration_max")
                                      : "diverged");
    }
    return text + "sequential and native jacobi: float, compiled " + sequentialFlags() +
           "; native x: speed over native jacobi on two threads\n";
}

} // namespace sinew::tools
