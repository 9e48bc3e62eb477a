// `sinew run`: simulates a scene without a window and writes the results.
#include "app/guard.hpp"
#include "app/kept_forms.hpp"
#include "app/progress.hpp"
#include "app/take_over.hpp"
#include "app/thread_advice.hpp"
#include "mesh/export.hpp"
#include "sim/core/counted.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sinew/commands.hpp"
#include "sinew/outputs.hpp"
#include "sinew/pilot.hpp"
#include "sinew/ranges.hpp"
#include "sinew/report.hpp"
#include "sinew/substeps.hpp"
#include "sinew/trace.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace sinew::tools {

namespace {

struct RunOptions {
    SceneOptions scene;
    DeviceOptions device;
    std::uint64_t frames = 240;
    std::uint64_t traceEvery = 10;
    bool timesPasses = false;
    std::optional<std::string> error; // empty text: only measure
    std::optional<std::string> folder, json, trace, save;
};

/// "1%" or "1", as a share; empty if it is no percentage above 0 and up to 100.
std::optional<double> shareOf(std::string text) {
    while (!text.empty() && (text.back() == '%' || text.back() == ' ')) text.pop_back();
    double percent = 0;
    if (!CLI::detail::lexical_cast(text, percent) || !(percent > 0 && percent <= 100)) return {};
    return percent / 100;
}

// Empty if correct (the form that CLI11 requires).
std::string checkError(const std::string& text) {
    if (text.empty() || shareOf(text)) return {};
    return text + " is no error: write a percentage, as 1%, or put --error after the scene";
}

std::vector<mesh::ParticleState> particleStates(const State& state) {
    std::vector<mesh::ParticleState> particles;
    particles.reserve(state.positions.size());
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
        if (!state.has(i)) continue;
        const auto &x = state.positions[i], &v = state.velocities[i];
        particles.push_back({{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, x[3]});
    }
    return particles;
}

void writeFolder(const std::filesystem::path& folder, const RunRecord& record, const std::string& report) {
    std::set<std::string> used;
    for (std::size_t i = 0; i < record.skins.whole.size(); ++i) {
        std::string name = fileName(record.skins.whole[i].name);
        if (!used.insert(name).second) used.insert(name += "-" + std::to_string(i));
        mesh::exportObj(folder / (name + ".obj"), record.skins.pieces[i]);
        mesh::exportPly(folder / (name + ".ply"), record.skins.pieces[i]);
        mesh::exportGlb(folder / (name + ".glb"), record.skins.shaded[i]);
    }
    mesh::exportParticles(folder / "state.ply", particleStates(record.state));
    mesh::writeWhole(folder / "report.json", [&](std::ostream& stream) { stream << report; });
}

void step(const RunOptions& options, const scenes::LoadedScene& loaded, Runner& runner,
          std::vector<Sample>& samples) {
    app::Progress progress(options.frames, stderr);
    const auto update = [&](std::uint64_t done) { progress.update(done); };
    if (options.trace)
        samples = trace(runner, loaded.scene, options.frames, options.traceEvery, update);
    else
        runner.advance(options.frames, sim::Simulation::framesInFlight, update);
    progress.finish();
}

/// The pilot runs of --error. An error to reach sets the substeps. Empty if nothing can be said.
std::optional<ErrorEstimate> pilot(const RunOptions& options, scenes::LoadedScene& loaded, Session& session) {
    constexpr std::uint64_t mostSteps = 30; // half a second of a common step: the first fall and turn
    if (!options.error) return {};
    if (app::isRunFile(options.scene.file))
        throw app::Failure(app::wrongUsage, "wrong usage: --error needs a scene, not a saved state");
    const std::optional<double> wanted = shareOf(*options.error);
    if (wanted && options.scene.overrides.substeps)
        throw app::Failure(app::wrongUsage,
                           "wrong usage: --substeps and an error to reach exclude each other");
    Pilot pilot(session, loaded, static_cast<std::uint32_t>(std::min(options.frames, mostSteps)));
    if (!wanted) return pilot.estimate(loaded.settings.substeps);
    const std::optional<ErrorEstimate> found = pilot.find(*wanted);
    if (app::isInterrupted()) return found;
    if (!found)
        throw app::Failure(
            app::badInput,
            fmt::format(
                "cannot reach an error of {:g} % of the motion with up to {:g} substeps, "
                "in the first {} steps: the motion diverges or is chaotic there, or nothing moves: ask for a "
                "larger error, fewer --frames, or give --substeps",
                100 * *wanted, sim::ranges::substeps.high, std::min(options.frames, mostSteps)));
    loaded.settings.substeps = found->chosen;
    loaded.substeps = {.substeps = found->chosen, .wanted = found->chosen};
    return found;
}

/// Collects the record. Only the device's description stays in `session`; all else is copied.
RunRecord recordOf(const RunOptions& options, const scenes::LoadedScene& loaded, Session& session,
                   Runner& runner, std::optional<ErrorEstimate> estimate) {
    return {.loaded = loaded,
            .program = runner.simulation().program(),
            .device = session.device.description(),
            .phases = runner.simulation().phases(),
            .phaseMs = runner.phaseMs(),
            .frameMs = runner.frameMs(),
            .recordMs = runner.recordMs(),
            .wantedFrames = options.frames,
            .frames = runner.steps(),
            .divergence = runner.divergence(),
            .contactRoom = runner.contactRoom(),
            .surfaceRoom = runner.surfaceRoom(),
            .surfaceMissing = runner.surfaceMissing(),
            .slowed = runner.slowed(),
            .lists = runner.lists(),
            .cuts = runner.cuts(),
            .forces = runner.forces(),
            .isInterrupted = app::isInterrupted() && runner.steps() < options.frames,
            .state = runner.readState(),
            .skins = runner.readSkins(),
            .hasValidation = options.device.hasValidation,
            .validationMessages = session.device.validationMessages(),
            .estimate = std::move(estimate),
            .isForError = options.error && shareOf(*options.error)};
}

/// Warns if rigid links are more than twice as long as the tolerance allows: then there are too few substeps.
/// While moving, links may exceed the tolerance itself. The stretch falls with the square of the number of
/// substeps; at corners, which "auto" considers, more slowly.
std::optional<std::string> stretchWarning(const RunRecord& record) {
    const sim::Settings& settings = record.loaded.settings;
    const double most = rigidStretch(record.loaded.scene, record.state), wanted = double{settings.tolerance};
    if (record.divergence || !(most > 2 * wanted)) return std::nullopt;
    sim::Settings chosen = settings;
    chosen.substeps = 0;
    const double ofAuto = sim::chooseSubsteps(record.loaded.scene, chosen).substeps;
    const double substeps = std::max(ofAuto, std::ceil(settings.substeps * std::sqrt(most / wanted)));
    return fmt::format("rigid links are up to {:.3g} % too long at the end; solver.tolerance is {:.3g} %{}: ",
                       100 * most, 100 * wanted,
                       settings.substeps >= ofAuto ? " for bodies at rest, and \"auto\" ignores motion"
                                                   : "") +
           (substeps <= sim::ranges::substeps.high
                ? fmt::format("take about {:.0f} substeps instead of {}", substeps, settings.substeps)
                : std::string("take shorter steps (dt), or links that are elastic"));
}

/// Adds warnings that need a run, on stderr and in the report.
void warnAboutRun(const RunRecord& record, std::vector<std::string>& warnings,
                  const std::vector<std::string>& complaints) {
    const auto warn = [&](const std::string& sentence) {
        warnings.push_back(sentence);
        std::fprintf(stderr, "warning: %s\n", sentence.c_str());
    };
    for (const std::string& complaint : complaints) warn(complaint);
    if (record.slowed > 0)
        warn(sim::counted(record.slowed, "time") +
             " a particle was slowed down, so that its contacts are found: momentum was lost, "
             "take more substeps");
    if (record.surfaceMissing > 0)
        warn("the device has too little memory for the " + std::to_string(record.surfaceMissing) +
             " triangles of the cut surface: skins are written uncut, take coarser voxels");
    if (const std::optional<std::string> stretch = stretchWarning(record)) warn(*stretch);
    if (!record.loaded.blades.empty() && record.cuts.links == 0 && !record.isInterrupted &&
        !record.divergence)
        warn("no blade has cut anything in " +
             fmt::format("{:.3g} s", double{record.loaded.scene.dt} * static_cast<double>(record.frames)) +
             ": check its times, and that its edges, in metres, pass through a body");
}

/// Writes a state in the viewer's format, with the view of `start` if it has one.
void writeState(const std::string& file, const Start& start, Runner& runner) {
    app::SavedRun run = runner.save();
    run.scene = start.scene;
    run.gravity = start.loaded.scene.gravity;
    if (start.run) {
        run.material = start.run->material;
        run.view = start.run->view;
    }
    app::writeRun(file, run);
}

/// The exit code of a run whose outputs are written.
int conclude(const RunRecord& record) {
    if (record.divergence && record.divergence->isCrowded)
        throw app::Failure(app::diverged, app::tooCrowded(record.divergence->step));
    if (const auto& divergence = record.divergence) {
        const std::string body = divergence->body.empty() ? "" : "body \"" + divergence->body + "\", ";
        throw app::Failure(
            app::diverged,
            fmt::format("the simulation diverged: step {} ({:.4g} s): ", divergence->step,
                        static_cast<double>(divergence->step) * double{record.loaded.scene.dt}) +
                body + "particle " + std::to_string(divergence->particle) + ": " +
                sim::counted(divergence->count, "particle is", "particles are") +
                " not finite, the last finite state was kept: use more substeps, a lower "
                "omega or a softer material");
    }
    return record.isInterrupted ? app::reportInterruption() : app::done;
}

int run(const RunOptions& options) {
    app::catchSignals();
    // Checks outputs before anything that takes time.
    std::optional<OutputFolder> folder;
    std::optional<TextOutput> json, traceOutput, state;
    if (options.json) json.emplace(*options.json);
    if (options.trace) traceOutput.emplace(*options.trace);
    if (options.save) state.emplace(*options.save);
    Start start = loadStart(options.scene);
    scenes::LoadedScene& loaded = start.loaded;
    if (options.save) app::addRoomForUser(loaded.settings);
    if (options.folder) folder.emplace(*options.folder);
    Session session(options.device);
    loaded.settings.forms = sim::completed(loaded.settings.forms, sim::kindOf(session.device));
    const std::optional<ErrorEstimate> estimate = pilot(options, loaded, session);
    constexpr std::uint64_t worthTuning = 100; // frames: in shorter runs timing of forms does not pay off
    auto formSource = options.scene.forms.isGiven() ? app::FormSource::given : app::FormSource::usual;
    if (options.frames >= worthTuning && !start.run && formSource == app::FormSource::usual) {
        const app::FormChoice choice =
            app::chooseForms(session.device, session.queue, loaded.scene, loaded.settings);
        loaded.settings.forms = choice.forms;
        formSource = choice.source;
        if (const auto advice = app::adviseOnThreads(session.device, loaded.scene, loaded.settings)) {
            loaded.notes.push_back(*advice);
            std::fprintf(stderr, "%s\n", advice->c_str());
        }
    }
    loaded.settings.timesPasses = options.timesPasses;
    Runner runner(session, loaded.scene, loaded.settings, {loaded.blades, loaded.scene.dt});
    if (start.run) runner.load(*start.run);
    std::vector<Sample> samples;
    step(options, loaded, runner, samples);
    const app::Writing writing;
    RunRecord record = recordOf(options, loaded, session, runner, estimate);
    record.formSource = formSource;
    for (const std::string& message : record.validationMessages)
        std::fprintf(stderr, "validation: %s\n", message.c_str());
    warnAboutRun(record, loaded.warnings, runner.complaints());

    const std::string report = toJson(record);
    if (options.save) writeState(*options.save, start, runner);
    if (folder) writeFolder(folder->path(), record, report);
    if (json) json->write(report);
    if (traceOutput) traceOutput->write(toCsv(samples));
    if (options.json != "-" && options.trace != "-") TextOutput("-").write(toText(record));
    return conclude(record);
}

} // namespace

void addRun(CLI::App& app, Chosen& chosen) {
    CLI::App& command =
        *app.add_subcommand("run", "simulate a scene without a window; write report, meshes and state");
    const auto options = std::make_shared<RunOptions>();
    addSceneOptions(command, options->scene);
    addDeviceOptions(command, options->device);
    command.add_option("--frames", options->frames, "steps to simulate")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
        ->capture_default_str();
    command
        .add_option(
            "--error", options->error,
            "estimate the error of the substeps from pilot runs of the first 30 steps; with a percentage "
            "of the motion, as 1%, take the fewest substeps that reach it")
        ->expected(0, 1)
        ->check(checkError);
    command.add_flag(
        "--pass-times", options->timesPasses,
        "time every pass separately: phase_ms of the report has an entry per kind of pass (slower)");
    command.add_option(
        "--out", options->folder,
        "folder for report.json, state.ply, and an OBJ, a PLY and a GLB of every skin at the end");
    command.add_option("--json", options->json, "file for the report, or - for the standard output");
    command
        .add_option("--save", options->save,
                    "file for the state at the end, FILE.state: `sinew run FILE.state` and sinew-viewer "
                    "continue from it")
        ->check([](const std::string& file) {
            return app::isRunFile(file) ? std::string() : file + ": the name of a state must end in .state";
        });
    command.add_option("--trace", options->trace,
                       "file for energy, overlap, sleep and memory over time as CSV, or - for the standard "
                       "output");
    command.add_option("--trace-every", options->traceEvery, "steps between two of its lines")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
        ->capture_default_str();
    command.callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

} // namespace sinew::tools
