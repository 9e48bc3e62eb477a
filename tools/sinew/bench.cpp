// `sinew bench`: time per step of each solver on the shipped scenes, sequential (double precision, one CPU
// thread) against the device. The solvers take turns in one process, so that whatever else the machine does
// hits all alike.
#include "app/guard.hpp"
#include "scenes/load.hpp"
#include "sim/compile.hpp"
#include "sim/reference/reference.hpp"
#include "sinew/commands.hpp"
#include "sinew/json.hpp"
#include "sinew/outputs.hpp"
#include "sinew/report.hpp"
#include "sinew/runner.hpp"
#include "sinew/skin_mesh.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <memory>

namespace sinew::tools {

namespace {

using Clock = std::chrono::steady_clock;

struct BenchOptions {
    std::string scene = "all";
    double seconds = 10; // of measuring per scene
    DeviceOptions device;
    std::optional<std::string> json;
};

struct BenchScene {
    const char* name;
    const char* size;
};
constexpr BenchScene benchScenes[] = {{"cloth", "64x64"}, {"cube", "16x16x16"}};

constexpr std::uint64_t stepsPerTurn = 8;

/// One solver of the table: takes turns, then says what it measured.
struct Contestant {
    std::string solver, device;
    scenes::LoadedScene loaded;
    std::uint64_t sweeps = 0;       // a step
    std::unique_ptr<Runner> runner; // null for the sequential one
    sim::reference::State reference;
    std::vector<double> stepMs;

    void takeTurn();
    State state() const;
    std::uint64_t steps() const { return runner ? runner->steps() : stepMs.size(); }
};

void Contestant::takeTurn() {
    if (runner) { // one step in flight: each time is that of a whole step, submission and wait included
        runner->advance(stepsPerTurn, 1);
        stepMs = runner->frameMs();
        return;
    }
    for (std::uint64_t i = 0; i < stepsPerTurn; ++i) {
        const Clock::time_point start = Clock::now();
        sim::reference::stepGaussSeidel(loaded.scene, loaded.settings, double{loaded.scene.dt}, reference);
        stepMs.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
}

State Contestant::state() const {
    if (runner) return runner->readState();
    const std::vector<float> inverseMass = sim::inverseMasses(loaded.scene);
    State state;
    for (std::size_t i = 0; i < inverseMass.size(); ++i) {
        const auto row = [&](const Eigen::Vector3d& v) {
            return std::array{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
                              inverseMass[i]};
        };
        state.positions.push_back(row(reference.x[i]));
        state.velocities.push_back(row(reference.v[i]));
    }
    return state;
}

/// The error figures after the steps made so far. Skins are placed here for all alike, from the particles.
Errors errorsOf(const Contestant& contestant) {
    const State state = contestant.state();
    sim::Scene moved = contestant.loaded.scene;
    for (std::size_t i = 0; i < moved.particles.size(); ++i) {
        const auto& x = state.positions[i];
        moved.particles[i].position = {x[0], x[1], x[2]};
    }
    std::vector<mesh::TriangleMesh> skins;
    for (const sim::Skin& skin : moved.skins) skins.push_back(skinMesh(skin, skinVertices(moved, skin)));
    return measure(contestant.loaded.scene, state, skins, contestant.steps());
}

std::vector<std::unique_ptr<Contestant>> contestants(const std::string& scene, Session& session) {
    std::vector<std::unique_ptr<Contestant>> result;
    auto& sequential = *result.emplace_back(std::make_unique<Contestant>());
    sequential.solver = "sequential";
    sequential.device = "CPU, one thread, double precision";
    sequential.loaded = scenes::loadBuiltIn(scene);
    sequential.reference = sim::reference::initialState(sequential.loaded.scene);
    const sim::Settings& settings = sequential.loaded.settings;
    sequential.sweeps = std::uint64_t{settings.substeps} * settings.iterations;
    for (const char* solver : {"jacobi", "split"}) {
        auto& contestant = *result.emplace_back(std::make_unique<Contestant>());
        contestant.solver = solver;
        contestant.device = session.device.description().name;
        contestant.loaded = scenes::loadBuiltIn(scene, {.solver = solver});
        contestant.runner =
            std::make_unique<Runner>(session, contestant.loaded.scene, contestant.loaded.settings);
        contestant.sweeps = contestant.runner->simulation().program().sweeps;
    }
    return result;
}

Json rowOf(const BenchScene& scene, const Contestant& contestant, double sequentialMs) {
    std::vector<double> fps;
    for (const double ms : contestant.stepMs) fps.push_back(1000 / ms);
    const Statistics step = summarise(contestant.stepMs).value_or(Statistics{});
    const Statistics rate = summarise(fps).value_or(Statistics{});
    const sim::Scene& described = contestant.loaded.scene;
    const auto work = static_cast<double>(described.distances.size() * contestant.sweeps);
    return {{"scene", scene.name},
            {"size", scene.size},
            {"solver", contestant.solver},
            {"device", contestant.device},
            {"particles", described.particles.size()},
            {"constraints", described.distances.size()},
            {"substeps", contestant.loaded.settings.substeps},
            {"iterations", contestant.loaded.settings.iterations},
            {"steps", contestant.steps()},
            {"fps_mean", rate.mean},
            {"fps_stddev", rate.stddev},
            {"ms_mean", step.mean},
            {"ms_stddev", step.stddev},
            {"ms_min", step.min},
            {"ms_p50", step.p50},
            {"ms_p99", step.p99},
            {"ns_per_constraint_sweep", 1e6 * step.p50 / work},
            {"ns_per_constraint_sweep_min", 1e6 * step.min / work},
            {"speedup", sequentialMs / step.p50},
            {"error", toJson(errorsOf(contestant))}};
}

Json measureScene(const BenchScene& scene, Session& session, double seconds) {
    const auto racing = contestants(scene.name, session);
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    do {
        for (const auto& contestant : racing) contestant->takeTurn();
    } while (Clock::now() < end && !app::isInterrupted());
    const double sequentialMs = summarise(racing.front()->stepMs).value_or(Statistics{}).p50;
    Json rows = Json::array();
    for (const auto& contestant : racing) rows.push_back(rowOf(scene, *contestant, sequentialMs));
    return rows;
}

std::string table(const Json& rows) {
    std::string text =
        fmt::format("{:<6} {:<9} {:<11} {:>9} {:>9} {:>9} {:>8} {:>9} {:>7} {:>8}\n", "scene", "size",
                    "solver", "ms p50", "ms p99", "ms mean", "ms dev", "ns/c/swp", "best", "speed-up");
    for (const Json& row : rows) {
        const auto number = [&](const char* key) { return row[key].get<double>(); };
        text += fmt::format(
            "{:<6} {:<9} {:<11} {:>9.3f} {:>9.3f} {:>9.3f} {:>8.3f} {:>9.2f} {:>7.2f} {:>8.2f}\n",
            row["scene"].get<std::string>(), row["size"].get<std::string>(), row["solver"].get<std::string>(),
            number("ms_p50"), number("ms_p99"), number("ms_mean"), number("ms_stddev"),
            number("ns_per_constraint_sweep"), number("ns_per_constraint_sweep_min"), number("speedup"));
    }
    return text;
}

int bench(const BenchOptions& options) {
    app::catchSignals();
    std::optional<TextOutput> json;
    if (options.json) json.emplace(*options.json);
    Session session(options.device);
    Json report{{"schema", reportSchema}, {"rows", Json::array()}};
    for (const BenchScene& scene : benchScenes) {
        if ((options.scene != "all" && options.scene != scene.name) || app::isInterrupted()) continue;
        for (Json& row : measureScene(scene, session, options.seconds))
            report["rows"].push_back(std::move(row));
    }
    if (json) json->write(dump(report));
    if (options.json != "-") TextOutput("-").write(table(report["rows"]));
    return app::isInterrupted() ? app::interrupted : app::done;
}

} // namespace

void addBench(CLI::App& app, Chosen& chosen) {
    CLI::App& command = *app.add_subcommand(
        "bench",
        "time the solvers on the shipped scenes: sequential on the CPU, jacobi and split on the device");
    const auto options = std::make_shared<BenchOptions>();
    command.add_option("--scene", options->scene)
        ->check(CLI::IsMember({"cloth", "cube", "all"}))
        ->capture_default_str();
    command.add_option("--seconds", options->seconds, "to measure, per scene")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    command.add_option("--json", options->json, "file for the rows, or - for the standard output");
    addDeviceOptions(command, options->device);
    command.callback([options, &chosen] { chosen = [options] { return bench(*options); }; });
}

} // namespace sinew::tools
