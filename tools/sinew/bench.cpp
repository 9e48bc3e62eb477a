// `sinew bench`: time per step of each solver on the shipped scenes, sequential (one CPU thread) against the
// device. All programs take turns in one process, so that other load on the machine affects all alike.
#include "app/guard.hpp"
#include "scenes/load.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/bench_clutter.hpp"
#include "sinew/bench_contacts.hpp"
#include "sinew/bench_forms.hpp"
#include "sinew/bench_kernels.hpp"
#include "sinew/commands.hpp"
#include "sinew/gpu_tune.hpp"
#include "sinew/json.hpp"
#include "sinew/outputs.hpp"
#include "sinew/peers/compare.hpp"
#include "sinew/report.hpp"
#include "sinew/runner.hpp"
#include "sinew/sequential.hpp"
#include "sinew/skin_mesh.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace sinew::tools {

namespace {

using Clock = std::chrono::steady_clock;

struct BenchOptions {
    std::string scene = "all";
    double seconds = 10; // of measuring per scene
    bool isOfMotion = false;
    bool hasPeers = false, hasKernels = false, hasContacts = false, isByForm = false;
    std::string only; // only rows of contacts whose name contains this
    FormOptions forms;
    DeviceOptions device;
    std::optional<std::string> json;
};

struct BenchScene {
    const char* name;
    const char* size;
    const char* file; // its name in scenes/
};
constexpr BenchScene benchScenes[] = {{"cloth", "64x64", "cloth_links"}, {"cube", "16x16x16", "cube"}};

constexpr std::uint64_t stepsPerTurn = 8;

/// One row of the table: runs in turns, then reports its results.
struct Contestant {
    std::string solver, device;
    scenes::LoadedScene loaded;
    std::uint64_t sweeps = 0;               // in a step
    std::unique_ptr<Runner> runner;         // this one
    std::unique_ptr<Sequential> sequential; // or this one
    const char* order = nullptr;            // of constraints, if it is sequential
    std::vector<double> stepMs;

    void takeTurn();
    State state() const;
    std::uint64_t steps() const { return runner ? runner->steps() : stepMs.size(); }
};

void Contestant::takeTurn() {
    if (runner) { // one step in flight: each time is that of a whole step, with submission and wait
        runner->advance(stepsPerTurn, 1);
        stepMs = runner->frameMs();
        return;
    }
    for (std::uint64_t i = 0; i < stepsPerTurn; ++i) {
        const Clock::time_point start = Clock::now();
        sequential->step();
        stepMs.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
}

State Contestant::state() const {
    return runner ? runner->readState() : State{sequential->positions(), sequential->velocities()};
}

bool isFinite(const Contestant& contestant) {
    if (contestant.runner) return !contestant.runner->divergence();
    return std::ranges::all_of(contestant.sequential->positions(), [](const auto& x) {
        return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
    });
}

/// The error figures after the steps so far. Skins are computed here for all programs, from the particles.
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
    for (const auto& [order, name] :
         {std::pair{ConstraintOrder::natural, "natural"}, std::pair{ConstraintOrder::color, "color"}}) {
        auto& contestant = *result.emplace_back(std::make_unique<Contestant>());
        contestant.solver = "sequential";
        contestant.order = name;
        contestant.device = "CPU, one thread";
        contestant.loaded = scenes::loadBuiltIn(scene);
        const sim::Settings& settings = contestant.loaded.settings;
        contestant.sequential = std::make_unique<Sequential>(contestant.loaded.scene, settings, order);
        contestant.sweeps = std::uint64_t{settings.substeps} * settings.iterations;
    }
    for (const std::string& solver : sim::solverNames()) {
        auto& contestant = *result.emplace_back(std::make_unique<Contestant>());
        contestant.solver = solver;
        contestant.device = session.device.description().name;
        contestant.loaded = scenes::loadBuiltIn(scene, {.solver = solver});
        contestant.loaded.settings =
            sim::tuned(session.device, session.queue, contestant.loaded.scene, contestant.loaded.settings);
        contestant.runner =
            std::make_unique<Runner>(session, contestant.loaded.scene, contestant.loaded.settings);
        contestant.sweeps = contestant.runner->simulation().program().sweeps;
    }
    return result;
}

/// Medians of the sequential rows [ms]: in the scene's order, and of the faster order.
struct SequentialMs {
    double natural = 0, best = 0;
};

Json rowOf(const BenchScene& scene, const Contestant& contestant, const SequentialMs& sequential) {
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
            {"order", contestant.order ? Json(contestant.order) : Json(nullptr)},
            {"precision", "float"},
            {"flags", contestant.sequential ? Json(sequentialFlags()) : Json(nullptr)},
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
            {"speedup", sequential.natural / step.p50},
            {"speedup_over_best", sequential.best / step.p50},
            {"finite", isFinite(contestant)},
            {"error", toJson(errorsOf(contestant))}};
}

Json measureScene(const BenchScene& scene, Session& session, double seconds) {
    const auto racing = contestants(scene.file, session);
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    do {
        for (const auto& contestant : racing) contestant->takeTurn();
    } while (Clock::now() < end && !app::isInterrupted());
    const auto median = [&](std::size_t i) {
        return summarise(racing[i]->stepMs).value_or(Statistics{}).p50;
    };
    const SequentialMs sequential{median(0), std::min(median(0), median(1))};
    Json rows = Json::array();
    for (const auto& contestant : racing) rows.push_back(rowOf(scene, *contestant, sequential));
    return rows;
}

/// In the scene's order, one sweep per substep of rigid links can be unstable, as on the cloth; the table
/// then says so.
std::string strainText(const Json& row) {
    const Json& strain = row["error"]["strain_rms"];
    const bool isAbsurd = strain.is_number() && !(strain.get<double>() < 10); // on its way to infinity
    if (!row["finite"].get<bool>() || isAbsurd) return "diverged";
    return strain.is_null() ? "-" : fmt::format("{:.2f} %", 100 * strain.get<double>());
}

std::string table(const Json& rows) {
    std::string text =
        fmt::format("{:<6} {:<9} {:<19} {:>15} {:>17} {:>8} {:>8} {:>9} {:>8} {:>9}\n", "scene", "size",
                    "solver", "FPS", "ms", "p50", "p99", "speed-up", "ns/c/swp", "strain");
    for (const Json& row : rows) {
        const auto number = [&](const char* key) { return row[key].get<double>(); };
        std::string solver = row["solver"];
        if (row["order"].is_string()) solver += ", " + row["order"].get<std::string>();
        text += fmt::format(
            "{:<6} {:<9} {:<19} {:>7.1f} +-{:>5.1f} {:>8.2f} +-{:>6.2f} {:>8.2f} {:>8.2f} {:>9.2f} {:>8.2f} "
            "{:>9}\n",
            row["scene"].get<std::string>(), row["size"].get<std::string>(), solver, number("fps_mean"),
            number("fps_stddev"), number("ms_mean"), number("ms_stddev"), number("ms_p50"), number("ms_p99"),
            number("speedup"), number("ns_per_constraint_sweep"), strainText(row));
    }
    return text +
           fmt::format("sequential: float, one thread, compiled {}; speed-up: over it in natural order\n",
                       sequentialFlags());
}

int bench(const BenchOptions& options) {
    app::catchSignals();
    std::optional<TextOutput> json;
    if (options.json) json.emplace(*options.json);
    if (options.hasPeers) requirePeers();
    if (!options.hasPeers && (options.scene == "beam" || options.scene == "chain"))
        throw app::Failure(app::wrongUsage,
                           "wrong usage: --scene " + options.scene + " has rows only with --peers");
    Session session(options.device);
    const auto finish = [&](const Json& report, const std::string& text) {
        const app::Writing writing;
        if (json) json->write(dump(report));
        if (options.json != "-") TextOutput("-").write(text);
        return app::isInterrupted() ? app::interrupted : app::done;
    };
    if (options.hasKernels) {
        const Json rows = measureKernels(session, options.forms);
        return finish({{"schema", reportSchema}, {"kernels", rows}}, kernelsTable(rows));
    }
    if (options.isByForm) {
        const Json rows = measureForms(session);
        return finish({{"schema", reportSchema}, {"forms", rows}}, formsTable(rows));
    }
    if (options.hasContacts) {
        const Json rows = measureContacts(session, options.only, options.seconds);
        return finish({{"schema", reportSchema}, {"contacts", rows}}, contactsTable(rows));
    }
    Json report{{"schema", reportSchema}, {"rows", Json::array()}};
    for (const BenchScene& scene : benchScenes) {
        if ((options.scene != "all" && options.scene != scene.name) || app::isInterrupted()) continue;
        for (Json& row : measureScene(scene, session, options.seconds))
            report["rows"].push_back(std::move(row));
    }
    Json clutter = Json::array();
    if ((options.scene == "all" || options.scene == "clutter") && !app::isInterrupted())
        clutter = measureClutter(session, options.seconds, options.hasPeers);
    if (options.hasPeers)
        report["peers"] =
            comparePeers({.scene = options.scene,
                          .seconds = options.seconds,
                          .scale = options.isOfMotion ? study::Scale::motion : study::Scale::body,
                          .device = options.device},
                         session);
    std::string text = report["rows"].empty() ? std::string() : table(report["rows"]);
    if (!clutter.empty()) text += clutterTable(clutter);
    if (options.hasPeers && !report["peers"].empty()) text += peersTable(report["peers"]);
    for (Json& row : clutter) report["rows"].push_back(std::move(row));
    return finish(report, text);
}

// Empty if a row of contacts has such a name (the form that CLI11 requires).
std::string checkRow(const std::string& only) {
    std::string names;
    for (const std::string& name : contactRows()) {
        if (name.find(only) != std::string::npos) return {};
        names += (names.empty() ? "" : "; ") + name;
    }
    return "no row has " + only + " in its name: " + names;
}

} // namespace

void addBench(CLI::App& app, Chosen& chosen) {
    CLI::App& command = *app.add_subcommand(
        "bench", "time the solvers on the shipped scenes: sequential on the CPU, the others on the device");
    const auto options = std::make_shared<BenchOptions>();
    command.add_option("--scene", options->scene)
        ->check(CLI::IsMember({"cloth", "cube", "clutter", "beam", "chain", "all"}))
        ->capture_default_str();
    command.add_option("--seconds", options->seconds, "seconds to measure, per scene")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    CLI::Option* peers = command.add_flag(
        "--peers", options->hasPeers,
        "also compare with Bullet and a native explicit integration: soft bodies at equal error on elastic "
        "scenes, Bullet's rigid spheres on the clutter (takes minutes)");
    command
        .add_flag("--of-motion", options->isOfMotion,
                  "errors of --peers are shares of the motion, not of the body's size")
        ->needs(peers);
    CLI::Option* kernels = command
                               .add_flag("--kernels", options->hasKernels,
                                         "instead: time of a substep of split for bodies of many sizes")
                               ->excludes("--peers");
    addFormOptions(command, options->forms);
    command.get_option("--forms")->needs(kernels);
    command
        .add_flag("--by-form", options->isByForm,
                  "instead: time of a step in each form of the kernels, for bodies of many sizes")
        ->excludes("--peers")
        ->excludes(kernels);
    CLI::Option* contacts =
        command
            .add_flag("--contacts", options->hasContacts,
                      "instead: cost of contacts without any touch, with bodies at rest, and in shipped "
                      "scenes (takes minutes)")
            ->excludes("--peers")
            ->excludes("--kernels")
            ->excludes("--by-form");
    command.add_option("--only", options->only, "only the rows of --contacts whose names contain this")
        ->needs(contacts)
        ->check(checkRow);
    command.add_option("--json", options->json, "file for the rows, or - for the standard output");
    addDeviceOptions(command, options->device);
    command.callback([options, &chosen] { chosen = [options] { return bench(*options); }; });
}

} // namespace sinew::tools
