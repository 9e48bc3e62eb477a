// Frames in flight: the work recorded into a frame, and its results when the frame has finished.
#include "viewer/show.hpp"

#include "app/guard.hpp"
#include "vk/check.hpp"
#include "vk/queue.hpp"

#include <algorithm>
#include <numeric>

namespace sinew::viewer {

namespace {

constexpr double strainEvery = 0.25; // [s]: a copy of all positions
constexpr double countEvery = 0.25;  // [s]: a copy of all triangles, while something is being cut

} // namespace

void Show::recordSteps(const Presenter::Frame& frame, Plan& plan) {
    InFlight& flight = inFlight_[frame.slot];
    if (plan.isReset) {
        stage_.recordReset(frame.commands);
        if (beside_) beside_->recordReset(frame.commands);
        isBesideOut_ = false;
        gauges_.restart();
        if (replay_) tools_.putAway(stage_);
        tools_.reset();
        inputSaved_ = tools_.log().events().size();
        const sim::Settings& begun = replay_ ? stage_.madeWith() : stage_.settings();
        begun_ = {begun.solver, begun.substeps};
        if (replay_) replay_->restart();
        if (std::exchange(from_, std::nullopt)) tools_.pull(stage_, knobs_.gravity); // logged from now on
        forgetFlights();
        isDiverged_ = isBroken_ = false;
    }
    const bool isWhole = stage_.undoneSteps() == 0 || isDiverged_; // otherwise those steps are repeated first
    if (!stage_.lacksContactRoom() && !stage_.wantsShape() && isWhole &&
        tools_.recordHistory(frame.commands, stage_)) { // otherwise later
        forgetFlights();
        isDiverged_ = false;
        isBesideOut_ = true; // it must take over the restored state
    }
    if (replay_ && plan.steps > 0 && !playInput(frame)) plan.steps = 0;
    stage_.setRepeats(!replay_); // a log has no such steps
    flight.firstStep = stage_.steps() + 1;
    if (const std::uint64_t undone = stage_.undoneSteps();
        undone > 0) // repeats them alone: new steps come in later frames
        plan.steps = static_cast<std::uint32_t>(std::min<std::uint64_t>(plan.steps, undone));
    else
        controller_.playback.taken(plan.steps);
    flight.steps = plan.steps;
    for (std::uint32_t step = 0; step < plan.steps; ++step) {
        if (const auto material = stage_.recordTurn(frame.commands)) {
            tools_.turned(*material);
            sceneFacts_.stiffness = stiffnessText(stage_);
        }
        const StepHands hands = tools_.takeStep(frame.commands, stage_);
        if (hands.sweep) flight.sweeps.push_back(*hands.sweep);
        recordStep(frame.commands, stage_, hands, step == 0 ? &times_[frame.slot] : nullptr);
        if (beside_ && !isBesideOut_)
            beside_->recordStep(frame.commands, stage_, hands, frame.slot, step == 0);
    }
    drawn_ = backstage_.ready({screen_.layers(), inspector_.isOn()});
    const bool isLooked = askProbe(flight); // a ray needs all triangles
    stage_.recordSkin(frame.commands, isLooked ? sim::Overlap::none : drawn_.layers.overlap());
    recordProbe(frame);
    if (beside_)
        beside_->recordPicture(frame.commands, frame.slot, flight.isMeasured, drawn_.layers.overlap());
}

// Drops the results of frames in flight, whose state was replaced; their cuts are not repeated.
void Show::forgetFlights() {
    if (recording_) screen_.presenter().waitIdle(); // the film keeps past pictures
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) {
        InFlight& flight = inFlight_[slot];
        if (std::exchange(flight.isRecorded, false)) settleCamera(slot, flight);
        flight.steps = 0;
        flight.sweeps.clear();
    }
}

bool Show::isStrainDue(std::uint32_t steps) {
    const auto now = Clock::now();
    const bool isDue = steps > 0 && screen_.panels().isShown(screen_.presenter().extent()) &&
                       now - lastStrain_ >= std::chrono::duration<double>(strainEvery);
    if (isDue) lastStrain_ = now;
    return isDue;
}

// True if something was cut since the last count and a quarter of a second has passed.
bool Show::isCountDue() {
    const auto now = Clock::now();
    if (!wantsCount_ || now - lastCount_ < std::chrono::duration<double>(countEvery)) return false;
    wantsCount_ = false;
    lastCount_ = now;
    return true;
}

// One copy in flight is enough: a question is asked again until it is answered. True if a ray is to be cast.
bool Show::askProbe(InFlight& flight) {
    if (std::ranges::any_of(inFlight_, &InFlight::isAsked)) return false;
    flight.isProbed = std::exchange(wantsProbe_, false);
    flight.look = std::exchange(wantsLook_, std::nullopt);
    if (!replay_) flight.question = tools_.question(); // the log has the answers
    flight.isMeasured = isStrainDue(flight.steps);
    flight.isInspected = inspector_.isDue(rayThrough(controller_.camera, pointer_));
    flight.isCounted = isCountDue();
    return flight.look || flight.question || flight.isInspected || flight.isCounted;
}

// Record after the skins.
void Show::recordProbe(const Presenter::Frame& frame) {
    const InFlight& flight = inFlight_[frame.slot];
    if (!flight.isAsked()) return;
    probe_->record(frame.commands);
    if (flight.isCounted) pieceProbe_.record(frame.commands);
    if (flight.isInspected) inspect(frame, rayThrough(controller_.camera, pointer_));
}

void Show::inspect(const Presenter::Frame& frame, const Ray& ray) {
    probe_->recordVelocities(frame.commands);
    inspector_.record(frame.commands, frame.slot, ray, backstage_.inspection().counter());
}

// Records the layers that are ready.
Overlay Show::recordLayers(const Presenter::Frame& frame) {
    Overlay overlay = tools_.overlay();
    const Layers& layers = overlay.layers = drawn_.layers;
    if (!layers.needsBuffers()) return overlay;
    const Inspection& inspection = backstage_.inspection();
    inspection.record(frame.commands, layers, frame.slot);
    inFlight_[frame.slot].map = layers.map;
    inFlight_[frame.slot].hasContacts = layers.hasContacts;
    inFlight_[frame.slot].hasCells = layers.hasCells;
    overlay.buffers = inspection.buffers(layers, mapRange_.range(), cellRangeOf(grids_));
    return overlay;
}

// Handles the results of a finished frame.
void Show::settle(std::uint32_t slot) {
    InFlight flight = std::exchange(inFlight_[slot], {});
    settleTimes(slot, flight);
    settleProbe(flight);
    if (flight.isInspected)
        inspector_.settle(slot, opening_.light.balls, *probe_, opened(), backstage_.inspection().counter());
    settleMap(slot, flight);
    if (flight.hasContacts && drawn_.layers.hasContacts)
        contactsFound_ = backstage_.inspection().contacts(slot);
    if (flight.hasCells && drawn_.layers.hasCells) settleCells(slot);
    settleBeside(slot);
    bool isUndone = false;
    for (std::uint32_t i = 0; i < flight.steps && !isDiverged_; ++i) {
        const std::uint64_t step = flight.firstStep + i;
        if (stage_.neededRoom(step) > 0) {
            makeRoom(step, flight);
            isUndone = true;
            break; // later steps were undone as well
        }
        if (stage_.lacksLists(step)) {
            repeatFrom(step, flight);
            isUndone = true;
            break;
        }
        if (const std::optional<Divergence> divergence = stage_.check(step)) stop(divergence->sentence());
        const sim::Status status = stage_.simulation().status(step);
        showCounts(status);
        surfaceMissing_ = status.cutSurfaceMissing;
    }
    if (flight.isCounted && !isUndone) settleCount();
    if (flight.isRecorded && !isUndone) settleCamera(slot, flight);
    if (flight.screenshot) settleScreenshot(flight);
}

// Updates the counts of pieces; pieces with a surface are counted some pictures later, in a copy.
void Show::showCounts(const sim::Status& status) {
    wantsCount_ = status.linksCutInAll > 0 && (wantsCount_ || status.linksCutInAll != linksCut_);
    linksCut_ = status.linksCutInAll;
    allPieces_ = status.pieces;
    gauges_.stepFinished(status);
    status_.setSleeping(status.sleeping);
    status_.setPieces(gauges_.pieces());
}

void Show::settleCount() {
    if (linksCut_ == 0) return; // an earlier state was restored
    gauges_.piecesCounted(pieceProbe_.count(allPieces_));
    status_.setPieces(gauges_.pieces());
    panelsDue_ = std::max(panelsDue_, 1u);
}

void Show::settleTimes(std::uint32_t slot, const InFlight& flight) {
    screen_.timing().pictureFinished(slot);
    FrameTimes& times = screen_.timing().times();
    if (flight.steps > 0) {
        const std::vector<double> phases = times_[slot].milliseconds();
        const double step = std::accumulate(phases.begin(), phases.end(), 0.0);
        if (!phases.empty()) status_.stepTimed(step);
        if (!phases.empty()) budget_.stepTimed(step / 1000);
        if (!phases.empty()) times.add(FrameTimes::Kind::step, step);
        gauges_.stepTimed(phases);
    }
    if (!flight.isTimed) return;
    const std::vector<double> drawing = drawingTimes_[slot].milliseconds();
    if (drawing.size() < 2) return; // the device has no timestamps
    times.add(FrameTimes::Kind::drawing, drawing[0]);
    times.add(FrameTimes::Kind::panels, drawing[1]);
}

void Show::settleProbe(InFlight& flight) {
    const bool isSeen = probe_->isComplete(); // otherwise asked again
    if (isSeen && flight.question && flight.question == tools_.question()) {
        const sim::Scene& scene = stage_.scene();
        const auto found = pick(scene, opening_.light.balls, flight.question->ray, probe_->seen(),
                                flight.question->among(), opened());
        tools_.answer(*flight.question, found, found ? holdRadius(scene, found->particle) : 0);
    }
    if (flight.isMeasured) gauges_.strainMeasured(measureStrain(stage_.scene(), *probe_));
    if (flight.look && isSeen) settleLook(*flight.look);
    if (flight.look && !isSeen && !wantsLook_) wantsLook_ = flight.look;
    if (!flight.isProbed) return;
    if (const Box bounds = probe_->bounds(); !bounds.isEmpty()) {
        controller_.camera = framing(controller_.camera, bounds, pictureAspect());
        shown_ = Shown::nothing; // the picture shows the old view
    }
}

// Moves the camera. On a miss, frames the scene, or keeps the orbit target.
void Show::settleLook(const Look& look) {
    const sim::Scene& scene = stage_.scene();
    const auto found = pick(scene, opening_.light.balls, look.ray, probe_->seen(), Among::all, opened());
    if (look.at == Look::At::point) {
        if (found) controller_.camera = centered(controller_.camera, found->point);
    } else {
        const Box box = found ? probe_->bounds(bodyOf(scene, found->particle)) : probe_->bounds();
        if (!box.isEmpty()) controller_.camera = framing(controller_.camera, box, pictureAspect());
    }
    shown_ = Shown::nothing;
}

std::optional<Opened> Show::opened() const {
    if (!screen_.layers().section) return std::nullopt;
    return Opened{*screen_.layers().section, opening_.light.isClosed};
}

// Draws a picture again if its colours have another range now.
void Show::settleMap(std::uint32_t slot, const InFlight& flight) {
    if (flight.map == ColorMap::none || flight.map != screen_.layers().map) return;
    const float before = mapRange_.range();
    mapRange_.read(backstage_.inspection().reading(slot));
    if (mapRange_.range() != before) shown_ = Shown::nothing;
}

void Show::settleCells(std::uint32_t slot) {
    const float before = cellRangeOf(grids_);
    grids_ = backstage_.inspection().grids(slot);
    if (cellRangeOf(grids_) != before) shown_ = Shown::nothing;
}

// Grows the surface of cuts: only the picture is incomplete, and steps go on.
void Show::makeSurfaceRoom() {
    if (isSurfaceMissing_ || stage_.isGrowing()) return; // there is no such room, or it comes
    if (stage_.wantsShape()) return;                     // first
    const std::uint32_t needed = std::exchange(surfaceMissing_, 0);
    if (needed == 0) return; // somebody has gone back to before
    if (!stage_.beginSurfaceRoom(needed)) warnOfSurface();
}

// Changes to a larger simulation once no picture is in flight.
void Show::takeGrowth() {
    if (!stage_.isGrowing() || backstage_.isMaking()) return; // layers that are being made first
    const Stage::Growth growth = stage_.askGrowth();
    if (growth == Stage::Growth::none) warnOfSurface();
    if (growth != Stage::Growth::made) return;
    settleAll();
    backstage_.forget();
    vk::Queue queue(device_);
    stage_.bringGrowth(queue, tools_.bring());
    backstage_.rehearse([this](VkCommandBuffer commands) { stage_.recordGrowth(commands); },
                        [this] { endGrowth(); });
}

void Show::endGrowth() {
    stage_.endGrowth();
    restartViews();
    tools_.moveOn();
    if (surfaceMissing_ <= stage_.settings().cutSurfaceRoom)
        surfaceMissing_ = 0; // otherwise more was cut meanwhile
}

// Warns once: only the picture is affected.
void Show::warnOfSurface() {
    if (std::exchange(isSurfaceMissing_, true)) return;
    screen_.warn("too little memory for the surface of the cuts: a part is not drawn, or drawn uncut");
}

void Show::stop(const std::string& why) {
    isDiverged_ = isBroken_ = true;
    controller_.playback.pause();
    screen_.warn(why);
}

// Later frames repeat the undone steps, once a simulation with capacity for them is ready.
void Show::makeRoom(std::uint64_t step, const InFlight& undone) {
    screen_.presenter().waitIdle(); // pictures in flight write into what the tools drop
    const std::uint64_t newest = stage_.steps();
    if (!stage_.beginRoom(step)) return stop(app::tooCrowded(step));
    isBesideOut_ = true; // it has taken those steps
    if (std::exchange(replay_, std::nullopt)) {
        isBroken_ = isBroken_ || stage_.wantsShape(); // already in the log
        stage_.keepShape();
        screen_.warn("the replay ends here: contacts need more room than when it was recorded");
    }
    tools_.restart(stage_, forgetUndone(undone), newest - stage_.steps());
}

// Repeats from a step in the same simulation, in the next frame.
void Show::repeatFrom(std::uint64_t step, const InFlight& undone) {
    screen_.presenter().waitIdle();
    const std::uint64_t newest = stage_.steps();
    stage_.goBackBefore(step);
    isBesideOut_ = true; // it has taken those steps
    gauges_.stepsRepeated(newest - stage_.steps());
    tools_.takeBack(stage_, forgetUndone(undone), newest - stage_.steps());
}

// Handles the next frame's slot. Before an undo or a material change all frames are handled, since a step
// without contact lists must be repeated first. Does not wait if no step is in flight, or if no step will use
// the new material.
void Show::settleNext(const Plan& plan) {
    const bool isTurning = tools_.wantsHistory() || (stage_.isTurnReady() && plan.steps > 0);
    const bool areOnTheirWay =
        std::ranges::any_of(inFlight_, [](const InFlight& flight) { return flight.steps > 0; });
    if (stage_.repeats() && isTurning && areOnTheirWay) return settleAll();
    settle(screen_.presenter().nextSlot());
}

// Returns the cuts of `undone`, which was settled, and of later frames: all of those steps were undone.
std::vector<Sweep> Show::forgetUndone(const InFlight& undone) {
    std::vector<Sweep> sweeps = undone.sweeps;
    for (const InFlight& later : inFlight_) // at most one has some
        sweeps.insert(sweeps.end(), later.sweeps.begin(), later.sweeps.end());
    for (InFlight& other : inFlight_) {
        other.steps = 0;
        other.sweeps.clear();
        other.isRecorded = false;
    }
    return sweeps;
}

void Show::settleAll() {
    screen_.presenter().waitIdle();
    for (std::uint32_t i = 0; i < Presenter::framesInFlight; ++i) // oldest first
        settle((screen_.presenter().nextSlot() + i) % Presenter::framesInFlight);
    warnOfMistakes();
}

// Warns of complaints, except while undone steps wait for capacity.
void Show::warnOfMistakes() {
    if (stage_.lacksContactRoom() || isDiverged_) return;
    for (const std::string& complaint : stage_.complaints()) screen_.warn(complaint);
}

} // namespace sinew::viewer
