// First every trial runs the motion once, for its error and a first time. Then the trials on their solver's
// front run in turns until enough frames are timed, so that other load on the machine affects all alike.
#include "sinew/study/scene_study.hpp"

#include "app/guard.hpp"
#include "app/progress.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/gpu_tune.hpp"
#include "sinew/study/analysis.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

namespace sinew::tools::study {

namespace {

std::optional<double> clampedShare(const sim::Scene& scene, const sim::Settings& settings) {
    if (settings.solver != sim::Solver::split) return {}; // no other has a clamp
    const sim::StiffnessReport report = sim::inspectStiffness(scene, settings);
    if (report.elastic == 0) return {};
    return static_cast<double>(report.clamped) / static_cast<double>(report.elastic);
}

Trial prepare(const StudyScene& scene, const sim::Settings& settings, const vk::DeviceDescription& device) {
    const sim::StepProgram program = sim::compile(scene.loaded.scene, settings);
    Trial trial{.settings = settings};
    trial.identity = identityOf(scene, settings, program, device);
    // Without links a sweep covers contacts only.
    trial.sweeps = std::max(program.sweeps, std::uint64_t{settings.substeps} * settings.iterations);
    trial.barriers = sim::countPasses(program, {}).barriers;
    trial.clamped = clampedShare(scene.loaded.scene, settings);
    return trial;
}

/// All trials, by rising sweeps, solvers next to each other.
std::vector<Trial> prepareAll(const StudyScene& scene, std::uint32_t points,
                              const vk::DeviceDescription& device, std::vector<std::string>& notes) {
    const std::uint32_t fewest = isOfContacts(scene.loaded.scene) ? fewestSweepsOfContacts : fewestSweeps;
    std::vector<Trial> trials;
    for (const std::string& name : sim::solverNames()) {
        sim::Solver solver{};
        sim::parseSolver(name, solver);
        std::string refusal;
        for (const sim::Settings& tried : settingsToTry(solver, std::min(points, scene.points), fewest)) {
            if (tried.levels > 0 && scene.loaded.scene.grids.empty()) continue;     // it has no blocks
            if (isWithSum(tried) && scene.loaded.scene.distances.empty()) continue; // it has no links
            const sim::Settings settings = settingsOfContacts(scene, tried);
            const std::vector<std::string> complaints = sim::validate(scene.loaded.scene, settings);
            if (complaints.empty())
                trials.push_back(prepare(scene, settings, device));
            else
                refusal = complaints.front();
        }
        if (!refusal.empty()) notes.push_back(name + " was not tried everywhere: " + refusal);
    }
    std::ranges::stable_sort(trials, {}, &Trial::sweeps);
    return trials;
}

std::vector<Trial*> missing(std::vector<Trial>& trials) {
    std::vector<Trial*> result;
    for (Trial& trial : trials)
        if (!trial.isRun) result.push_back(&trial);
    return result;
}

void compareAll(Session& session, const StudyScene& scene, const Truth& truth,
                const std::vector<Trial*>& trials, const Store& store) {
    std::uint64_t total = 0, done = 0;
    for (const Trial* trial : trials) total += scene.frames * trial->sweeps;
    app::Progress progress(total, stderr, "sweeps");
    for (Trial* trial : trials) {
        compareWithTruth(session, scene, truth, *trial);
        if (!trial->isRun) return;
        store.keep(*trial);
        progress.update(done += scene.frames * trial->sweeps);
    }
    progress.finish();
}

/// The trials on the front of their solver, against time or sweeps, whose timing is not good enough yet.
std::vector<Trial*> untimed(std::vector<Trial>& trials, const Truth& truth) {
    std::vector<Trial*> result;
    for (const std::string& name : curveNames()) {
        std::vector<Trial*> own;
        for (Trial& trial : trials)
            if (trial.isRun && curveOf(trial.settings) == name) own.push_back(&trial);
        for (const bool isTime : {true, false}) {
            std::vector<Offer> offers;
            for (const Trial* trial : own) {
                const std::optional<TrialError> error = errorOf(*trial, truth);
                offers.push_back({isTime ? trial->medianMs() : static_cast<double>(trial->sweeps),
                                  error ? std::optional(error->rms) : std::nullopt});
            }
            for (const std::size_t i : paretoFront(offers))
                if (framesLeftToTime(*own[i]) > 0) result.push_back(own[i]);
        }
    }
    std::ranges::sort(result, [](const Trial* a, const Trial* b) { return a->sweeps < b->sweeps; });
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

struct Turn {
    Trial* trial;
    std::unique_ptr<Runner> runner;
    bool isDone() const { return framesLeftToTime(*trial) == 0; }
};

void takeTurn(Turn& turn, std::uint32_t frames) {
    turn.runner->restart();
    turn.runner->advance(frames, 1);
    turn.trial->add(turn.trial->hasDeviceClock ? turn.runner->deviceMs() : turn.runner->frameMs());
}

/// The fastest forms of a solver: they depend on scene and device, hardly on other settings.
sim::Forms fastestForms(Session& session, const sim::Scene& scene, sim::Settings probe) {
    probe.iterations = 1;
    return sim::tuned(session.device, session.queue, scene, probe).forms;
}

void timeAll(Session& session, const StudyScene& scene, const std::vector<Trial*>& trials,
             const Store& store) {
    std::vector<Turn> turns;
    std::uint64_t total = 0, done = 0;
    std::map<sim::Solver, sim::Forms> forms;
    for (Trial* trial : trials) {
        total += framesLeftToTime(*trial) * trial->sweeps;
        sim::Settings settings = trial->settings;
        if (!forms.contains(settings.solver))
            forms[settings.solver] = fastestForms(session, scene.loaded.scene, settings);
        settings.forms = forms[settings.solver];
        turns.push_back({trial, std::make_unique<Runner>(session, scene.loaded.scene, settings)});
    }
    app::Progress progress(total, stderr, "sweeps");
    while (!app::isInterrupted() && !std::ranges::all_of(turns, &Turn::isDone)) {
        for (Turn& turn : turns) {
            if (turn.isDone() || app::isInterrupted()) continue;
            const std::size_t left = framesLeftToTime(*turn.trial);
            takeTurn(turn, scene.frames);
            done += std::min<std::size_t>(left, scene.frames) * turn.trial->sweeps;
            progress.update(done);
        }
        for (const Turn& turn : turns) store.keep(*turn.trial);
    }
    if (!app::isInterrupted()) progress.finish();
}

/// The truth, with its frames only if a trial must be compared with it.
Truth findTruth(Session& session, const StudyScene& scene, bool needsFrames, const Store& store) {
    const std::string identity = identityOfTruth(scene, session.device.description());
    if (!needsFrames)
        if (std::optional<Truth> kept = store.loadTruth(identity)) return *kept;
    fmt::print(stderr, "{}: computing the true motion\n", scene.name);
    Truth truth = truthOf(session, scene);
    if (!app::isInterrupted()) store.keepTruth(identity, truth);
    return truth;
}

} // namespace

SceneResult study(Session& session, const StudyScene& scene, std::uint32_t points, const Store& store,
                  const Shard& shard) {
    SceneResult result{.name = scene.name,
                       .particles = scene.loaded.scene.particles.size(),
                       .constraints = scene.loaded.scene.distances.size(),
                       .frames = scene.frames,
                       .dt = double{scene.loaded.scene.dt},
                       .isOfContacts = isOfContacts(scene.loaded.scene),
                       .notes = scene.notes};
    std::vector<Trial> trials = prepareAll(scene, points, session.device.description(), result.notes);
    std::size_t place = 0; // trials rise by sweeps: parts take about equally long
    std::erase_if(trials, [&](const Trial&) { return !shard.has(place++); });
    for (Trial& trial : trials) store.load(trial);
    const std::vector<Trial*> toRun = missing(trials);
    result.truth = findTruth(session, scene, !toRun.empty(), store);
    if (!toRun.empty()) {
        fmt::print(stderr, "{}: {} of {} runs to do\n", scene.name, toRun.size(), trials.size());
        compareAll(session, scene, result.truth, toRun, store);
    }
    result.truth.frames.clear();
    // A better time may put another trial on the front, which then needs timing too.
    for (auto toTime = untimed(trials, result.truth); !toTime.empty() && !app::isInterrupted();
         toTime = untimed(trials, result.truth)) {
        fmt::print(stderr, "{}: timing {} runs in turns\n", scene.name, toTime.size());
        timeAll(session, scene, toTime, store);
    }
    if (result.isOfContacts && !app::isInterrupted()) result.rest = studyRest(session, scene, store, shard);
    std::erase_if(trials, [](const Trial& trial) { return !trial.isRun; });
    result.trials = std::move(trials);
    return result;
}

std::optional<TrialError> errorOf(const Trial& trial, const Truth& truth) {
    if (trial.isDiverged) return {};
    const std::size_t frames = comparableFrames(trial.frameRms, truth);
    TrialError error{.rms = rmsOver(trial.frameRms, frames),
                     .max = *std::max_element(trial.frameMax.begin(),
                                              trial.frameMax.begin() + static_cast<std::ptrdiff_t>(frames)),
                     .frames = frames};
    if (const double still = truth.standingStill(frames); still > 0) error.ofMotion = error.rms / still;
    return error;
}

} // namespace sinew::tools::study
