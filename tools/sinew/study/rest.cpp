// One run per setting, sampled every few frames.
#include "sinew/study/rest.hpp"

#include "app/guard.hpp"
#include "app/progress.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/validate.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::tools::study {

namespace {

constexpr std::uint64_t sampleEvery = 4; // frames

void runRest(Session& session, const StudyScene& scene, RestRun& run,
             const std::function<void(std::uint64_t)>& onStep) {
    const std::uint64_t frames = std::uint64_t{restLength} * scene.frames;
    Runner runner(session, scene.loaded.scene, run.settings);
    run.samples = trace(runner, scene.loaded.scene, frames, sampleEvery, onStep);
    run.isDiverged = runner.divergence().has_value();
    run.isRun = run.isDiverged || runner.steps() == frames;
}

} // namespace

std::vector<sim::Settings> restSettings(const StudyScene& scene) {
    std::vector<sim::Settings> list;
    for (const std::string& name : sim::solverNames()) {
        sim::Solver solver{};
        sim::parseSolver(name, solver);
        // Other solvers are compared only at the most substeps.
        for (const std::uint32_t substeps : {8u, 16u, 32u}) {
            if (solver != sim::Solver::split && substeps < 32) continue;
            const sim::Settings settings = settingsOfContacts(
                scene,
                {.solver = solver, .substeps = substeps, .hasSharpClamp = solver == sim::Solver::split});
            if (sim::validate(scene.loaded.scene, settings).empty()) list.push_back(settings);
        }
    }
    return list;
}

std::vector<RestRun> studyRest(Session& session, const StudyScene& scene, const Store& store,
                               const Shard& shard) {
    std::vector<RestRun> runs;
    std::size_t place = 0;
    for (const sim::Settings& settings : restSettings(scene)) {
        if (!shard.has(place++)) continue;
        const sim::StepProgram program = sim::compile(scene.loaded.scene, settings);
        runs.push_back({.settings = settings,
                        .identity = identityOfRest(scene, settings, program, session.device.description())});
    }
    std::uint64_t total = 0, done = 0;
    std::vector<RestRun*> missing;
    for (RestRun& run : runs)
        if (!store.load(run)) {
            missing.push_back(&run);
            total += run.settings.substeps * restLength * scene.frames;
        }
    if (!missing.empty()) fmt::print(stderr, "{}: {} runs to rest\n", scene.name, missing.size());
    app::Progress progress(std::max<std::uint64_t>(total, 1), stderr, "sweeps");
    for (RestRun* run : missing) {
        if (app::isInterrupted()) break;
        runRest(session, scene, *run,
                [&](std::uint64_t) { progress.update(done += run->settings.substeps); });
        if (run->isRun) store.keep(*run);
    }
    if (!missing.empty() && !app::isInterrupted()) progress.finish();
    std::erase_if(runs, [](const RestRun& run) { return !run.isRun; });
    return runs;
}

std::optional<double> deepest(const RestRun& run, double from) {
    if (run.isDiverged) return {};
    std::optional<double> result;
    for (const Sample& sample : run.samples)
        if (sample.time >= from && sample.penetrationMax)
            result = std::max(result.value_or(0), *sample.penetrationMax);
    return result;
}

std::optional<double> timeToRest(const RestRun& run, double share) {
    if (run.isDiverged || run.samples.empty()) return {};
    const double limit = share * std::ranges::max(run.samples, {}, &Sample::kineticEnergy).kineticEnergy;
    std::optional<double> since;
    for (const Sample& sample : run.samples) {
        if (sample.kineticEnergy > limit)
            since.reset();
        else if (!since)
            since = sample.time;
    }
    return since;
}

} // namespace sinew::tools::study
