// The loop of the window.
#include "viewer/player/scene_player.hpp"

#include "app/guard.hpp"
#include "sinew/vk/check.hpp"
#include "viewer/tools/cut_tool.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr double idleWait = 0.1;                   // [s] longest wait between polls while nothing moves
constexpr double rehearsalWait = 0.005;            // [s] between polls of a rehearsal
constexpr std::chrono::milliseconds patience{300}; // delay of the message about preparation
constexpr std::uint32_t picturesOfATouch = 3;      // until Dear ImGui shows the effect of a press
constexpr std::uint32_t picturesOfAFocus = 5;      // until Dear ImGui passes keys to a new text field
constexpr double stillAfter = 0.25; // [s] without a change before a still picture in full quality

std::string softText(const SceneFacts& facts) {
    const std::string cure =
        facts.neededSubsteps > 0 ? " " + countText(facts.neededSubsteps, "substep") + " would do." : "";
    return facts.stiffness + cure;
}

static_assert(Presenter::framesInFlight * Playback::maxSteps <= sim::Simulation::framesInFlight);
static_assert(6 * Presenter::framesInFlight < Renderer::slots); // films and files of halves
static_assert(Presenter::framesInFlight <= Timing::slots);

} // namespace

ScenePlayer::ScenePlayer(Session& session, SceneLoader& sceneLoader, const Devices& devices,
                         const vk::Device& device, std::unique_ptr<OpenedScene> opening)
    : session_(session), sceneLoader_(sceneLoader), devices_(devices), ownOpening_(std::move(opening)),
      opening_(*ownOpening_), prepared_(*opening_.prepared),
      controller_(opening_.camera, opening_.loaded.scene.dt), document_(prepared_.document),
      parts_(isSoftware(device)),
      tools_(device, toolContext(opening_)), context_{session,
                                                      device,
                                                      opening_,
                                                      prepared_,
                                                      document_,
                                                      controller_,
                                                      tools_,
                                                      [this] { settleAll(); },
                                                      [this] { shown_ = Shown::nothing; },
                                                      [this] { forgetFlights(); }},
      comparison_(context_, layerLoader_),
      layerLoader_(device, prepared_, opening_.camera, Presenter::framesInFlight),
      gauges_(document_, opening_.loaded.scene.dt), layers_(context_, layerLoader_),
      capture_(context_, comparison_), observer_(context_, layers_, comparison_, gauges_),
      adjustments_(context_, sceneLoader, devices, comparison_), journal_(context_, sceneLoader),
      times_(context_),
      succession_(context_, {layerLoader_, layers_, observer_, times_, gauges_, adjustments_, journal_}),
      status_(opening_.loaded.scene, device) {
    if (!opening_.run || opening_.reload) {
        controller_.playback.reset(); // initialises the buffers
        return;
    }
    adjustments_.begin(*opening_.run);
    journal_.begin(*opening_.run);
}

ScenePlayer::~ScenePlayer() {
    session_.presenter().drain(); // an exception may have left frames in flight
}

void ScenePlayer::takeOver(const ScenePlayer& before) {
    document_.takeOver(before.document_, tools_.bringOf(before.tools_));
    succession_.restartParts(); // it may have had to make room first
    controller_ = before.controller_;
    tools_.goOn(before.tools_, document_);
    gauges_.goOn(before.gauges_);
    status_.setSleeping(gauges_.facts(document_).sleeping);
    status_.setPieces(gauges_.pieces());
    comparison_.takeOver(before.comparison_);
    observer_.takeOver(before.observer_);
    journal_.takeOver(before.journal_);
    adjustments_.takeOver(before.adjustments_);
}

std::unique_ptr<OpenedScene> ScenePlayer::run() {
    adjustments_.keepAsItWas(); // what was asked for could not be shown
    std::unique_ptr<OpenedScene> next;
    while (!next && !session_.window().isClosing() && !app::isInterrupted()) {
        turn();
        if (!document_.isGrowing() && !layerLoader_.isBusy() && !comparison_.isMaking())
            next = adjustments_.takeOpened();
    }
    settleAll();
    const app::Writing writing;
    endFilm();
    capture_.reportFiles(PictureWriter::Wait::yes);
    if (next && !next->reload) session_.layers().section.reset(); // it belonged to this scene
    shown_ = Shown::nothing;                                      // run() may be called again
    return next;
}

// One look at the input, and a picture where there is something to be seen.
void ScenePlayer::turn() {
    const bool isIdle = isHidden_ || (shown_ == Shown::still && panelsDue_ == 0);
    const bool isBusy = layerLoader_.isBusy();       // pictures wait for it, input does not
    if (!isBusy) session_.presenter().waitForSlot(); // the next picture then uses the newest input
    session_.timing().beforeInput(isIdle);
    const bool isMaking = isAwaited() || document_.isGrowing();
    Input input = session_.window().poll(isBusy || (isIdle && isMaking) ? rehearsalWait
                                         : isIdle                       ? idleWait
                                                                        : 0);
    session_.timing().afterInput(!input.isEmpty() || input.panels.isTouched, times_.onTheirWay());
    comparison_.fold(input);
    const bool hasMoved = observer_.take(input);
    const bool isUsed = hasMoved || !input.presses.empty();
    // Changes of panels over a still scene keep its quality.
    const bool isLent = !journal_.isReplaying() && tools_.lend(input.held, isUsed);
    if (isLent) input.needsRedraw = true;
    const bool areAsked = !input.actions.empty() || !input.presses.empty() || isLent;
    if (input.panels.isTouched || areAsked || (hasMoved && observer_.isInspecting()))
        panelsDue_ = picturesOfATouch;
    grant(std::exchange(wishes_, {}), input);
    isInputDue_ = isInputDue_ || !input.isEmpty();
    handle(input);
    adjustments_.tend(journal_.isReplaying());
    capture_.reportFiles(PictureWriter::Wait::no);
    while (const auto preview = sceneLoader_.previews().take())
        session_.addPreview(preview->first, preview->second);
    if (!isBusy) play();
    if (!layers_.tend() && observer_.isInspecting()) observer_.toggleInspector();
    sayWhatIsMade();
    times_.countPipelines();
    if (const auto title = status_.title(controller_.playback.isPaused(), isDiverged_))
        session_.window().setTitle(*title);
}

// A button has the pointer over the panel: what is to be pinned or looked at is pointed at next.
void ScenePlayer::grant(const Wishes& wishes, Input& input) {
    for (const Action action : wishes.actions)
        if (Tools::actsAtPointer(action) && !journal_.isReplaying())
            tools_.arm(action);
        else if (action == Action::frameBody || action == Action::center)
            observer_.lookAtPress(action == Action::center ? Observer::Target::point
                                                           : Observer::Target::body);
        else
            input.actions.push_back(action);
    adjustments_.open(wishes);
    if (wishes.device && adjustments_.mayOpen()) {
        if (journal_.isReplaying())
            session_.tell(Journal::howToEnd());
        else
            adjustments_.changeDevice(*wishes.device);
    }
    if (wishes.sectionOffset && session_.layers().section) {
        layers_.moveSectionTo(*wishes.sectionOffset);
        input.needsRedraw = true;
    }
    if (wishes.beside) {
        session_.beside() = shapeOf(*wishes.beside);
        session_.isBesideDefault() = false;
    }
    if (wishes.knobs && !journal_.isReplaying()) adjustments_.turn(*wishes.knobs); // else the log has them
}

void ScenePlayer::handle(Input& input) {
    observer_.takePress(input);
    if (std::ranges::any_of(input.presses, &Input::Press::isDown)) session_.panels().closeAll();
    if (!input.files.empty()) adjustments_.openFile(input.files.front());
    for (const Action action : input.actions) {
        if (action == Action::drop) observer_.forgetLook();
        const bool isClosing = action == Action::drop && session_.panels().closeTop();
        if (!isClosing && !journal_.takes(action) && !controller_.act(action) && !tools_.act(action) &&
            !layers_.act(action))
            act(action);
    }
    if (!journal_.isReplaying()) tools_.handle(input, controller_);
    if (const std::string note = tools_.takeNote(); !note.empty()) session_.tell(note);
    session_.feed(input.panels);
    status_.setTool(tools_.name());
    layers_.slideSection(input.slide);
    const float notches = input.notches + (tools_.takesWheel() ? 0 : input.growth);
    if (notches != 0 && !journal_.isReplaying()) controller_.wheel(notches, input.pointer);
}

void ScenePlayer::act(Action action) {
    switch (action) {
    case Action::frame:
        return observer_.frameAll();
    case Action::frameBody:
        return observer_.lookAt(Observer::Target::body);
    case Action::center:
        return observer_.lookAt(Observer::Target::point);
    case Action::inspect:
        return observer_.toggleInspector();
    case Action::beside:
        return comparison_.toggle();
    case Action::screenshot:
        return capture_.wantPicture();
    case Action::record:
        return capture_.isFilming() ? endFilm() : capture_.beginFilm();
    case Action::saveInput:
        return journal_.saveInput();
    case Action::saveState:
        return journal_.saveState(isDiverged_);
    case Action::previousScene:
        return adjustments_.openNext(-1);
    case Action::nextScene:
        return adjustments_.openNext(1);
    case Action::open:
        session_.panels().toggleFiles();
        panelsDue_ = picturesOfAFocus;
        return;
    default:
        if (!adjustments_.act(action)) session_.act(action);
    }
}

void ScenePlayer::play() {
    journal_.compareReplay();
    succession_.takeRoom();
    if (!layerLoader_.isBusy()) comparison_.tend(isDiverged_);
    if (layerLoader_.isBusy()) return;
    succession_.takeShape();
    journal_.dropReplay();
    isHidden_ = !prepareSwapchain();
    if (!isHidden_ && !capture_.isFilming() && !comparison_.isButtonDown()) observer_.keepFraming();
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - std::exchange(lastTurn_, now)).count();
    if (isHidden_) return; // time stops while the window is hidden
    const Plan plan = this->plan(elapsed);
    const bool hasInput = std::exchange(isInputDue_, false);
    const bool isChanged = !controller_.playback.isPaused() || plan.isReset || plan.steps > 0 || hasInput ||
                           capture_.wantsPicture() || observer_.isWaiting() || tools_.isWaiting() ||
                           shown_ == Shown::nothing;
    if (isChanged) lastChange_ = now;
    if (session_.hasNewNotice()) panelsDue_ = picturesOfATouch;
    if (!isChanged && shown_ == Shown::still && panelsDue_ == 0) return;
    const bool isLast = !isChanged && (shown_ == Shown::still ||
                                       now - lastChange_ >= std::chrono::duration<double>(stillAfter));
    arePanelsDue_ = isLast || panelsDue_ > 0;
    panelsDue_ -= std::min(panelsDue_, 1u);
    shown_ = isLast ? Shown::still : Shown::moving;
    gauges_.frame(elapsed, plan.steps);
    if (plan.steps > 0) budget_.pictureTaken(elapsed, plan.steps);
    draw(plan, isLast && prepared_.still ? *prepared_.still : prepared_.moving);
    if (isLast) settleAll();
}

// Plans steps; a film has a picture of every step.
Plan ScenePlayer::plan(double elapsed) {
    const bool isOneByOne = capture_.isFilming() || journal_.isReplaying();
    const std::uint32_t most = isOneByOne ? 1 : budget_.steps(Playback::maxSteps);
    const std::uint64_t undone = isDiverged_ ? 0 : document_.undoneSteps();
    const bool isWaiting = document_.lacksContactRoom() || (document_.wantsShape() && undone == 0);
    Plan plan = controller_.playback.plan(elapsed, isWaiting ? 0 : most, undone);
    if (capture_.isFilming() && !isWaiting && !controller_.playback.isPaused() && !plan.isReset)
        plan.steps = 1;
    if (plan.isReset && journal_.beginsFromState()) { // the state is put in anew, beside what plays
        adjustments_.playAgain(*journal_.replayed());
        plan.isReset = false;
    }
    return plan;
}

// False while the window has no size.
bool ScenePlayer::prepareSwapchain() {
    return session_.prepare([this] {
        shown_ = Shown::nothing;
        prepared_.moving.dropCanvases();
        if (prepared_.still) prepared_.still->dropCanvases();
    });
}

void ScenePlayer::draw(Plan plan, View& view) {
    session_.presenter().waitForSlot();
    settleNext(plan);
    succession_.beginSurfaceRoom();
    if (isDiverged_ && !plan.isReset) { // keeps the last finite picture
        plan.steps = 0;
        controller_.playback.dropSingleSteps();
    }
    if (document_.lacksContactRoom()) plan.steps = 0; // since settle()
    std::optional<Presenter::Frame> frame = session_.presenter().begin();
    if (!frame) {
        if (plan.isReset) controller_.playback.reset();
        return;
    }
    recordSteps(*frame, plan);
    const Overlay overlay = layers_.record(*frame);
    if (capture_.isFilming() && plan.steps > 0) capture_.recordFilm(*frame, overlay);
    const bool isCutting = !inFlight_[frame->slot].sweeps.empty();
    drawPicture(*frame, overlay, view);
    session_.presenter().end(*frame);
    times_.submitted(*frame, isCutting);
    status_.frameDrawn();
}

void ScenePlayer::recordReset(VkCommandBuffer commands) {
    forgetFlights();
    document_.recordReset(commands);
    comparison_.recordReset(commands);
    gauges_.restart();
    status_.setPieces(gauges_.pieces());
    journal_.reset(adjustments_.gravity());
    isDiverged_ = false;
}

// A paused scene shows the counts of the state that it returns to: no step brings them.
bool ScenePlayer::recordHistory(VkCommandBuffer commands) {
    if (!tools_.wantsHistory()) return false;
    std::vector<std::uint64_t> times = tools_.history().times();
    times.push_back(document_.played()); // of the state that is left
    if (!tools_.recordHistory(commands, document_)) return false;
    gauges_.keepCuts(times);
    gauges_.returnTo(document_.played());
    gauges_.keepCuts(tools_.history().times());
    observer_.stateRestored();
    status_.setPieces(gauges_.pieces());
    return true;
}

void ScenePlayer::recordSteps(Presenter::Frame& frame, Plan& plan) {
    InFlight& flight = inFlight_[frame.slot];
    if (plan.isReset) recordReset(frame.commands);
    const bool isWhole =
        document_.undoneSteps() == 0 || isDiverged_; // otherwise those steps are repeated first
    if (!document_.lacksContactRoom() && !document_.wantsShape() && isWhole &&
        recordHistory(frame.commands)) { // otherwise later
        forgetFlights();
        isDiverged_ = false;
    }
    if (journal_.isReplaying() && plan.steps > 0 && !journal_.playUntilStep(frame)) plan.steps = 0;
    document_.setRepeats(!journal_.isReplaying()); // a log has no such steps
    flight.firstStep = document_.steps() + 1;
    if (const std::uint64_t undone = document_.undoneSteps();
        undone > 0) // repeats them alone: new steps come in later frames
        plan.steps = static_cast<std::uint32_t>(std::min<std::uint64_t>(plan.steps, undone));
    else
        controller_.playback.taken(plan.steps);
    flight.steps = plan.steps;
    for (std::uint32_t step = 0; step < plan.steps; ++step) {
        if (const auto material = document_.recordTurn(frame.commands)) {
            tools_.turned(*material);
            const bool wasSoft = !prepared_.facts.stiffness.empty();
            setStiffness(prepared_.facts, document_.stiffness());
            if (!wasSoft && !prepared_.facts.stiffness.empty()) session_.tell(softText(prepared_.facts));
        }
        const StepHands hands = tools_.takeStep(frame.commands, document_);
        if (hands.sweep) flight.sweeps.push_back(*hands.sweep);
        if (hands.sweep && !hands.sweep->isCarried) gauges_.keepCuts(tools_.history().times());
        const auto parts = session_.presenter().divide(frame, parts_.count());
        recordStep(parts, document_, hands, step == 0 ? times_.ofStep(frame.slot) : nullptr);
        session_.presenter().submitParts(frame, parts);
        comparison_.recordStep(frame, hands, step == 0);
    }
    layers_.prepare(observer_.isInspecting());
    observer_.ask(frame.slot, plan.steps, !journal_.isReplaying());
    document_.recordSkin(frame.commands);
    observer_.record(frame);
    comparison_.recordPicture(frame, observer_.isMeasured(frame.slot));
}

void ScenePlayer::drawPicture(const Presenter::Frame& frame, const Overlay& overlay, View& view) {
    const bool isReduced = prepared_.still && &view == &prepared_.moving;
    const bool areHalves = comparison_.simulation() != nullptr;
    const std::size_t scale = isReduced && !areHalves ? budget_.scale() : 0;
    std::optional<Canvas>& canvas = view.canvases[scale];
    if (!canvas && !areHalves)
        canvas.emplace(view.renderer.makeCanvas(session_.presenter().extent(), session_.presenter().views(),
                                                PictureBudget::scales[scale]));
    if (canvas) view.renderer.prepareCanvas(overlay.layers, *canvas);
    times_.begin(frame, PictureTimes::Part::drawing);
    if (areHalves)
        comparison_.drawHalves(frame, overlay, view);
    else
        view.renderer.record(frame.commands, frame.slot, *canvas, frame.image, observer_.seenBesidePanels(),
                             document_.simulation(), overlay);
    times_.end(frame, PictureTimes::Part::drawing);
    capture_.recordPicture(frame, overlay);
    times_.begin(frame, PictureTimes::Part::panels);
    const auto reduced = isReduced ? std::optional(PictureBudget::scales[scale]) : std::nullopt;
    const bool areDue = layers_.takeNewLegend() || arePanelsDue_; // it must fit the colors of this picture
    wishes_ = session_.drawPanels(frame, prepared_.facts, facts(reduced), areDue);
    if (!wishes_.isEmpty()) panelsDue_ = picturesOfATouch;
    times_.end(frame, PictureTimes::Part::panels);
}

// `reduced` as Facts::reduced.
Facts ScenePlayer::facts(std::optional<float> reduced) const {
    Facts facts = gauges_.facts(document_);
    facts.isPaused = controller_.playback.isPaused();
    facts.isDiverged = isDiverged_;
    facts.reduced = reduced;
    facts.toolsOn = tools_.shownOn();
    facts.hint = tools_.hintFacts();
    for (const std::uint64_t steps : tools_.history().times()) {
        char time[40];
        std::snprintf(time, sizeof time, "at %.2f s",
                      static_cast<double>(steps) * double{document_.scene().dt});
        facts.cuts.push_back(time);
    }
    facts.undos = tools_.history().undos();
    facts.scenes = sceneLoader_.names();
    facts.sentences = sceneLoader_.sentences();
    facts.marks = sceneLoader_.marks();
    facts.recent = sceneLoader_.recent();
    facts.scene = sceneLoader_.current();
    facts.isOpening = sceneLoader_.isOpening();
    facts.devices = devices_.list();
    layers_.addTo(facts);
    observer_.addTo(facts);
    facts.beside = comparison_.facts();
    if (const std::uint32_t height = session_.presenter().extent().height; height > 0)
        facts.metersPerPixel = pictureHeight(controller_.camera) / static_cast<float>(height);
    facts.recorded = capture_.filmSeconds();
    facts.knobs = adjustments_.shown();
    facts.bladeDepths = tools_.settingRange(tool::blade);
    facts.pace = controller_.playback.pace();
    return facts;
}

// Takes the results of a frame that has finished.
void ScenePlayer::settle(std::uint32_t slot) {
    const InFlight flight = std::exchange(inFlight_[slot], {});
    const std::vector<double> phases = times_.settle(slot, flight.steps > 0);
    if (!phases.empty()) {
        const double step = std::accumulate(phases.begin(), phases.end(), 0.0);
        status_.stepTimed(step);
        parts_.measured(step);
        budget_.stepTimed(step / 1000);
        gauges_.stepTimed(phases);
    }
    observer_.settle(slot);
    layers_.settle(slot);
    comparison_.settle(slot, observer_.probe());
    const bool isUndone = !settleSteps(flight);
    if (observer_.settleCount(slot, isUndone)) {
        status_.setPieces(gauges_.pieces());
        panelsDue_ = std::max(panelsDue_, 1u);
    }
    capture_.settle(slot, isUndone);
}

// False if a step was undone: all that came after it were undone as well.
bool ScenePlayer::settleSteps(const InFlight& flight) {
    for (std::uint32_t i = 0; i < flight.steps && !isDiverged_; ++i) {
        const std::uint64_t step = flight.firstStep + i;
        if (document_.neededRoom(step) > 0) {
            makeRoom(step, flight);
            return false;
        }
        if (document_.lacksLists(step)) {
            repeatFrom(step, flight);
            return false;
        }
        if (const std::optional<Divergence> divergence = document_.check(step)) stop(divergence->advice());
        const sim::Status status = document_.simulation().status(step);
        observer_.stepFinished(status);
        succession_.surfaceMissing(status.cutSurfaceMissing);
        status_.setSleeping(status.sleeping);
        status_.setPieces(gauges_.pieces());
    }
    return true;
}

// Handles the next frame's slot. Before an undo or a material change all frames are handled, since a step
// without contact lists must be repeated first. Does not wait if no step is in flight, or if no step will use
// the new material.
void ScenePlayer::settleNext(const Plan& plan) {
    const bool isTurning = tools_.wantsHistory() || (document_.isTurnReady() && plan.steps > 0);
    const bool areOnTheirWay =
        std::ranges::any_of(inFlight_, [](const InFlight& flight) { return flight.steps > 0; });
    if (document_.repeats() && isTurning && areOnTheirWay) return settleAll();
    settle(session_.presenter().nextSlot());
}

// Steps without room are undone by then and done again: no mistake of the program.
void ScenePlayer::settleAll() {
    session_.presenter().waitIdle();
    for (std::uint32_t i = 0; i < Presenter::framesInFlight; ++i) // oldest first
        settle((session_.presenter().nextSlot() + i) % Presenter::framesInFlight);
    if (document_.lacksContactRoom() || isDiverged_) return;
    for (const std::string& complaint : document_.complaints()) session_.warn(complaint);
}

// Later frames repeat the undone steps, once a simulation with capacity for them is ready.
void ScenePlayer::makeRoom(std::uint64_t step, const InFlight& undone) {
    session_.presenter().waitIdle(); // pictures in flight write into what the tools drop
    const std::uint64_t newest = document_.steps();
    if (!document_.beginRoom(step)) return stop(app::tooCrowded(step));
    comparison_.fallBehind(); // it has taken those steps
    if (journal_.isReplaying()) {
        if (document_.wantsShape()) journal_.breakOff(); // the shape stands in the log already
        document_.keepShape();
        journal_.endReplay("contacts need more room than when it was recorded");
    }
    tools_.restart(document_, forgetUndone(undone), newest - document_.steps());
}

// Repeats from a step in the same simulation, in the next frame.
void ScenePlayer::repeatFrom(std::uint64_t step, const InFlight& undone) {
    session_.presenter().waitIdle();
    const std::uint64_t newest = document_.steps();
    document_.goBackBefore(step);
    comparison_.fallBehind(); // it has taken those steps
    gauges_.stepsRepeated(newest - document_.steps());
    tools_.takeBack(document_, forgetUndone(undone), newest - document_.steps());
}

// Returns the cuts of `undone`, which was settled, and of later frames: all of those steps were undone.
std::vector<Sweep> ScenePlayer::forgetUndone(const InFlight& undone) {
    std::vector<Sweep> sweeps = undone.sweeps;
    for (InFlight& later : inFlight_) { // at most one has some
        sweeps.insert(sweeps.end(), later.sweeps.begin(), later.sweeps.end());
        later = {};
    }
    capture_.leaveOut();
    return sweeps;
}

// The state of the document is an earlier one. Steps on their way lead to a state that is no more: nobody
// need look at them, nor cut again what they cut.
void ScenePlayer::forgetFlights() {
    capture_.keepAll(); // the film keeps what has happened
    for (InFlight& flight : inFlight_) flight = {};
    comparison_.fallBehind(); // it goes on from there, too
}

void ScenePlayer::stop(const std::string& why) {
    isDiverged_ = true;
    journal_.breakOff();
    controller_.playback.pause();
    session_.warn(why);
}

void ScenePlayer::endFilm() {
    if (!capture_.isFilming()) return;
    settleAll(); // the last pictures
    capture_.endFilm();
    capture_.freeCameras();
}

// True while something is made that hands wait for. Nobody waits for room for a surface.
bool ScenePlayer::isAwaited() const {
    return layerLoader_.isMaking() || document_.lacksContactRoom() || document_.wantsShape() ||
           comparison_.isMaking() || sceneLoader_.isOpening();
}

void ScenePlayer::sayWhatIsMade() {
    if (!isAwaited()) {
        isMakingSaid_ = false;
        return makingSince_.reset();
    }
    if (!makingSince_) makingSince_ = Clock::now();
    if (isMakingSaid_ || Clock::now() - *makingSince_ < patience) return;
    isMakingSaid_ = true;
    session_.tell(document_.lacksContactRoom()
                      ? "Making room for more contacts; the scene continues in a moment"
                  : document_.wantsShape()  ? "Preparing the solver; the scene continues in a moment"
                  : comparison_.isMaking()  ? "Preparing the comparison"
                  : layerLoader_.isMaking() ? "Preparing the view"
                                            : "Opening the scene");
}

} // namespace sinew::viewer
