// Change of solver, substeps, device, or of a material that needs other passes: another simulation of the
// scene takes over from the one on show.
#include "viewer/show.hpp"

#include "scenes/recovery.hpp"
#include "sim/compile.hpp"
#include "vk/queue.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sinew::viewer {

namespace {

bool areOfOneShape(const Knobs& a, const Knobs& b) {
    return a.solver == b.solver && a.substeps == b.substeps;
}

} // namespace

// The parameters that the stage was made with.
Knobs Show::madeKnobs() const {
    const sim::Settings& settings = stage_.settings();
    const std::vector<std::string>& solvers = sceneFacts_.solvers;
    Knobs knobs = knobs_;
    knobs.substeps = static_cast<int>(settings.substeps);
    knobs.solver =
        static_cast<int>(std::ranges::find(solvers, sim::solverName(settings.solver)) - solvers.begin());
    return knobs;
}

Again Show::again() const {
    return {materialOf(knobs_, sceneFacts_.fromFile), stage_.settings()};
}

// Requests another simulation if the parameters need one; while one is being made, the request waits.
void Show::reopenWhereTurned() {
    const bool isTurned = !areOfOneShape(knobs_, madeKnobs());
    if ((!isTurned && !isRefused_) || replay_ || library_.isOpening()) return;
    isRefused_ = false;
    scenes::Overrides overrides;
    if (isTurned) {
        overrides.solver = sceneFacts_.solvers[static_cast<std::size_t>(knobs_.solver)];
        overrides.substeps = static_cast<std::uint32_t>(knobs_.substeps);
    }
    asked_ = knobs_;
    library_.reopen(overrides, again(), pictureAspect());
}

void Show::changeDevice(std::size_t index) {
    if (replay_) return screen_.tell("a replay is running: " + std::string(keyOf(Action::drop)) + " ends it");
    asked_ = madeKnobs();
    library_.reopenOn(requestFor(devices_.list(), index), again(), pictureAspect());
}

// Resets the parameters after a failed request.
void Show::keepAsItWas() {
    if (!std::exchange(asked_, std::nullopt)) return;
    knobs_ = turnedTo(stage_.material(), madeKnobs(), sceneFacts_.fromFile);
}

void Show::takeOver(const Show& before) {
    stage_.takeOver(before.stage_, tools_.bringOf(before.tools_));
    restartViews(); // the take-over may have changed its capacities
    controller_ = before.controller_;
    tools_.goOn(before.tools_, stage_);
    gauges_.goOn(before.gauges_);
    status_.setSleeping(gauges_.facts(stage_).sleeping);
    status_.setPieces(gauges_.pieces());
    pointer_ = before.pointer_;
    fold_ = before.fold_;
    isButtonDown_ = before.isButtonDown_;
    if (before.inspector_.isOn()) inspector_.toggle();
    inputSaved_ = before.inputSaved_;
    begun_ = before.begun_;
    from_ = before.from_;
    isBroken_ = before.isBroken_;
    linksCut_ = before.linksCut_;
    allPieces_ = before.allPieces_;
    sceneFacts_.fromFile = before.sceneFacts_.fromFile;
    knobs_ = before.knobs_;
    if (!before.asked_ || areOfOneShape(knobs_, *before.asked_)) knobs_ = madeKnobs(); // 0 is a number now
    const sim::Material material = materialOf(knobs_, sceneFacts_.fromFile);
    if (material != stage_.material()) stage_.turn(material); // changed meanwhile
}

// Changes the simulation in a replay, once the new one is ready.
void Show::reshape() {
    settleAll();
    backstage_.forget(); // made for the old simulation
    vk::Queue queue(device_);
    try {
        stage_.reshape(queue, tools_.bring());
    } catch (const std::invalid_argument& error) {
        replay_.reset();
        return screen_.warn(std::string("the replay ends here: ") + error.what());
    }
    restartViews();
    tools_.reshaped();
    const auto spans = static_cast<std::uint32_t>(stage_.simulation().phases().size());
    for (vk::Timestamps& times : times_) times = vk::Timestamps(device_, spans);
    Gauges gauges(stage_, opening_.loaded.scene.dt);
    gauges.goOn(gauges_);
    gauges_ = std::move(gauges);
    const Knobs fromFile = sceneFacts_.fromFile;
    sceneFacts_ = sceneFacts(opening_, stage_, device_);
    sceneFacts_.fromFile = fromFile;
    knobs_ = turnedTo(stage_.material(), madeKnobs(), fromFile);
    for (const std::string& warning : scenes::newWarnings(opening_.loaded, stage_.settings()))
        screen_.warn(warning);
    for (const std::string& note : scenes::recoveryLeftOut(opening_.loaded, stage_.settings()))
        screen_.note(note);
}

// Call after the stage changed its simulation.
void Show::restartViews() {
    probe_.emplace(device_, stage_.scene(), stage_.settings(), stage_.simulation());
    pieceProbe_.restart();
    wantsCount_ = linksCut_ > 0; // a pending count is lost
    backstage_.forget();         // layers belong to the old one
    drawn_ = {};
    inspector_.restart();
    shown_ = Shown::nothing;
}

} // namespace sinew::viewer
