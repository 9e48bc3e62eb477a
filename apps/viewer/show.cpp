// The loop of the window.
#include "viewer/show.hpp"

#include "app/guard.hpp"
#include "vk/check.hpp"
#include "vk/kernel_store.hpp"
#include "vk/queue.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew::viewer {

namespace {

constexpr double idleWait = 0.1;                   // [s] longest wait between polls while nothing moves
constexpr double rehearsalWait = 0.005;            // [s] between polls of a rehearsal
constexpr std::chrono::milliseconds patience{300}; // delay of the message about preparation
constexpr std::uint32_t picturesOfATouch = 3;      // until Dear ImGui shows the effect of a press
constexpr double stillAfter = 0.25; // [s] without a change before a still picture in full quality

static_assert(Presenter::framesInFlight * Playback::maxSteps <= sim::Simulation::framesInFlight);
static_assert(6 * Presenter::framesInFlight < Renderer::slots); // films and files of halves
static_assert(Presenter::framesInFlight <= Timing::slots);

} // namespace

Show::Show(Screen& screen, Library& library, const Devices& devices, const vk::Device& device,
           std::unique_ptr<Opening> opening)
    : screen_(screen), library_(library), devices_(devices), device_(device), ownOpening_(std::move(opening)),
      opening_(*ownOpening_), prepared_(*opening_.prepared),
      controller_(opening_.camera, opening_.loaded.scene.dt), stage_(prepared_.stage),
      probe_(std::in_place, device, stage_.scene(), stage_.settings(), stage_.simulation()),
      pieceProbe_(device, stage_), backstage_(device, prepared_, opening_.camera, Presenter::framesInFlight),
      inspector_(stage_, opening_.loaded.holds, Presenter::framesInFlight), tools_(device, opening_),
      sceneFacts_(prepared_.facts), gauges_(stage_, opening_.loaded.scene.dt),
      knobs_(sceneFacts_.fromFile), begun_{stage_.settings().solver, stage_.settings().substeps},
      status_(opening_.loaded.scene, device) {
    const auto spans = static_cast<std::uint32_t>(stage_.simulation().phases().size());
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) {
        times_.emplace_back(device, spans);
        drawingTimes_.emplace_back(device, 2);
    }
    pipelines_ = device.kernels().pipelinesMade(); // of the first scene, before there was a window
    if (!opening_.run || opening_.again)
        controller_.playback.reset(); // initialises the buffers
    else
        goOn(*opening_.run);
    if (opening_.input) replay_.emplace(*opening_.input);
}

// Continues from a loaded state: shows its parameters, which stay after a reset.
void Show::goOn(const app::SavedRun& run) {
    const auto [x, y, z] = run.gravity;
    knobs_ = turnedTo(run.material, knobs_, sceneFacts_.fromFile);
    knobs_.gravity = std::hypot(x, y, z);
    sceneFacts_.stiffness = stiffnessText(stage_);
    tools_.begin(stage_);
    from_ = {rememberedScene(library_.shown().scene, {}), run.fileHash};
}

Show::~Show() {
    screen_.presenter().drain(); // an exception may have left frames in flight
}

std::unique_ptr<Opening> Show::run() {
    keepAsItWas(); // if the requested change failed
    std::unique_ptr<Opening> next;
    while (!next && !screen_.window().isClosing() && !app::isInterrupted()) {
        turn();
        next = takeOpened();
    }
    settleAll();
    const app::Writing writing;
    stopRecording();
    reportFiles(PictureWriter::Wait::yes);
    if (next && !next->again) screen_.layers().section.reset(); // it belonged to this scene
    shown_ = Shown::nothing;                                    // run() may be called again
    return next;
}

// Returns a loaded scene; on an error everything stays as it is. A reload with less capacity than the present
// simulation is requested again, since growing would block this thread.
std::unique_ptr<Opening> Show::takeOpened() {
    if (stage_.isGrowing() || backstage_.isBusy() || besideMaking_.valid()) return nullptr;
    try {
        std::unique_ptr<Opening> opened = library_.take();
        const auto hasRoom = [this](const Again& other) {
            return sim::haveRoomsOf(other.settings, stage_.settings());
        };
        if (!opened || !opened->again || hasRoom(*opened->again)) return opened;
        library_.askAgain({opened->again->material, stage_.settings()}, pictureAspect());
    } catch (const std::exception& error) {
        screen_.warn(error.what());
        keepAsItWas();
    }
    return nullptr;
}

float Show::pictureAspect() const {
    const std::uint32_t height = screen_.presenter().extent().height;
    if (!beside_ || height == 0) return wholeAspect();
    return 0.5f * static_cast<float>(halvesWidth()) / static_cast<float>(height);
}

float Show::wholeAspect() const {
    const VkExtent2D extent = screen_.presenter().extent();
    return extent.height > 0 ? static_cast<float>(extent.width) / static_cast<float>(extent.height) : 1;
}

void Show::turn() {
    const bool isIdle = isHidden_ || (shown_ == Shown::still && panelsDue_ == 0);
    const bool isBusy = backstage_.isBusy();        // pictures wait for it, input does not
    if (!isBusy) screen_.presenter().waitForSlot(); // the next picture then uses the newest input
    const bool isMaking =
        backstage_.isMaking() || stage_.isGrowing() || stage_.wantsShape() || besideMaking_.valid();
    screen_.timing().beforeInput(isIdle);
    Input input = screen_.window().poll(isBusy || (isIdle && isMaking) ? rehearsalWait
                                        : isIdle                       ? idleWait
                                                                       : 0);
    screen_.timing().afterInput(!input.isEmpty() || input.panels.isTouched, picturesOnTheirWay());
    foldPointer(input);
    const bool hasMoved = input.pointer != std::exchange(pointer_, input.pointer);
    const bool isUsed = hasMoved || !input.presses.empty();
    // Changes of panels over a still scene keep its quality.
    const bool isBladeLent = !replay_ && tools_.lendBlade(input.held == Action::blade, isUsed);
    if (isBladeLent) input.needsRedraw = true;
    const bool areAsked = !input.actions.empty() || !input.presses.empty() || isBladeLent;
    if (input.panels.isTouched || areAsked || (hasMoved && inspector_.isOn())) panelsDue_ = picturesOfATouch;
    const Wishes wishes = std::exchange(wishes_, {});
    grant(wishes, input);
    handle(input);
    takeTurn();
    reopenWhereTurned();
    reportFiles(PictureWriter::Wait::no);
    while (const auto preview = library_.previews().take())
        screen_.addPreview(preview->first, preview->second);
    isInputDue_ = isInputDue_ || !input.isEmpty();
    if (!isBusy) play();
    goOn();
    countPipelines();
    if (const auto title = status_.title(controller_.playback.isPaused(), isDiverged_))
        screen_.window().setTitle(*title);
}

// Takes steps and draws a picture, unless nothing has changed.
void Show::play() {
    if (replayed_) compareReplay();
    takeGrowth();
    if (!backstage_.isBusy()) tendBeside();
    if (backstage_.isBusy()) return;
    if (stage_.wantsShape() && stage_.isShapeMade()) reshape();
    dropReplay();
    isHidden_ = !prepareSwapchain();
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - std::exchange(lastTurn_, now)).count();
    if (isHidden_) return; // time stops while the window is hidden
    const Plan plan = this->plan(elapsed);
    const bool hasInput = std::exchange(isInputDue_, false);
    const bool isChanged = !controller_.playback.isPaused() || plan.isReset || plan.steps > 0 || hasInput ||
                           wantsScreenshot_ || wantsProbe_ || wantsLook_ || wantsCount_ ||
                           tools_.isWaiting() || shown_ == Shown::nothing;
    if (isChanged) lastChange_ = now;
    if (screen_.hasNewNotice()) panelsDue_ = picturesOfATouch;
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

// Continues the preparation of layers; without memory they are turned off.
void Show::goOn() {
    try {
        if (backstage_.goOn()) shown_ = Shown::nothing;
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        screen_.layers() = {};
        if (inspector_.isOn()) inspector_.toggle();
        screen_.warn(error.what());
    }
    const bool isMaking =
        backstage_.isMaking() || stage_.lacksContactRoom() || stage_.wantsShape() || besideMaking_.valid();
    if (!isMaking) isMakingSaid_ = false;
    if (!isMaking) return makingSince_.reset();
    if (!makingSince_) makingSince_ = Clock::now();
    if (isMakingSaid_ || Clock::now() - *makingSince_ < patience) return;
    isMakingSaid_ = true;
    screen_.tell(stage_.lacksContactRoom() ? "preparing room for more contacts: steps wait for it"
                                           : "the requested change is being prepared");
}

// Counts new pipelines, which this thread should not make.
void Show::countPipelines() {
    const std::size_t made = device_.kernels().pipelinesMade();
    screen_.timing().times().addPipelines(made - std::exchange(pipelines_, made));
}

// Plans steps; a film has a picture of every step.
Plan Show::plan(double elapsed) {
    const bool isOneByOne = recording_ || replay_;
    const std::uint32_t most = isOneByOne ? 1 : budget_.steps(Playback::maxSteps);
    const std::uint64_t undone = isDiverged_ ? 0 : stage_.undoneSteps();
    const bool isWaiting = stage_.lacksContactRoom() || (stage_.wantsShape() && undone == 0);
    Plan plan = controller_.playback.plan(elapsed, isWaiting ? 0 : most, undone);
    if (recording_ && !isWaiting && !controller_.playback.isPaused() && !plan.isReset) plan.steps = 1;
    if (plan.isReset && replay_ && from_) { // loads the state again in the background
        if (mayOpen()) library_.playAgain(replay_->file(), pictureAspect());
        plan.isReset = false;
    }
    return plan;
}

// Number of pictures in flight; reports finished ones to the timing.
std::size_t Show::picturesOnTheirWay() {
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < Presenter::framesInFlight; ++slot)
        if (screen_.presenter().isFinished(slot))
            screen_.timing().pictureFinished(slot);
        else
            ++count;
    return count;
}

// False while the window has no size.
bool Show::prepareSwapchain() {
    return screen_.prepare([this] {
        shown_ = Shown::nothing;
        prepared_.moving.dropCanvases();
        if (prepared_.still) prepared_.still->dropCanvases();
    });
}

void Show::draw(Plan plan, View& view) {
    screen_.presenter().waitForSlot();
    settleNext(plan);
    if (surfaceMissing_ > 0) makeSurfaceRoom();
    if (isDiverged_ && !plan.isReset) { // keeps the last finite picture
        plan.steps = 0;
        controller_.playback.dropSingleSteps();
    }
    if (stage_.lacksContactRoom()) plan.steps = 0; // since settle()
    const std::optional<Presenter::Frame> frame = screen_.presenter().begin();
    if (!frame) {
        if (plan.isReset) controller_.playback.reset();
        return;
    }
    recordSteps(*frame, plan);
    const Overlay overlay = recordLayers(*frame);
    if (recording_ && plan.steps > 0) recordCamera(*frame, overlay);
    const bool isCutting = !inFlight_[frame->slot].sweeps.empty();
    drawPicture(*frame, overlay, view);
    screen_.presenter().end(*frame);
    screen_.timing().pictureSubmitted(frame->slot, isOfCut(isCutting));
    picturesOnTheirWay(); // some finish during presentation
    if (screen_.timing().awaitsPicture()) {
        screen_.presenter().waitIdle();
        countPipelines();
        screen_.timing().firstPicture();
    }
    status_.frameDrawn();
}

// Timed only on request: each timestamp costs a software device a flush.
void Show::drawPicture(const Presenter::Frame& frame, const Overlay& overlay, View& view) {
    const bool isReduced = prepared_.still && &view == &prepared_.moving;
    const std::size_t scale = isReduced && !beside_ ? budget_.scale() : 0;
    std::optional<Canvas>& canvas = view.canvases[scale];
    if (!canvas && !beside_)
        canvas.emplace(view.renderer.makeCanvas(screen_.presenter().extent(), screen_.presenter().views(),
                                                PictureBudget::scales[scale]));
    if (canvas) view.renderer.prepareCanvas(overlay.layers, *canvas);
    const bool isTimed = inFlight_[frame.slot].isTimed = screen_.timing().isOn();
    vk::Commands commands(device_, frame.commands);
    vk::Timestamps& times = drawingTimes_[frame.slot];
    if (isTimed) times.reset(commands);
    if (isTimed) times.begin(commands, 0);
    if (beside_)
        drawHalves(frame, overlay, view);
    else
        view.renderer.record(frame.commands, frame.slot, *canvas, frame.image, controller_.camera,
                             stage_.simulation(), overlay);
    if (isTimed) times.end(commands, 0);
    if (std::exchange(wantsScreenshot_, false)) recordScreenshot(frame, overlay);
    if (isTimed) times.begin(commands, 1);
    drawPanels(frame, isReduced ? std::optional(PictureBudget::scales[scale]) : std::nullopt);
    if (isTimed) times.end(commands, 1);
}

// Includes pictures that wait for one with a cut.
bool Show::isOfCut(bool isCutting) {
    if (isCutting) cutFrames_ = Presenter::framesInFlight + 1;
    return cutFrames_ > 0 && cutFrames_-- > 0;
}

void Show::drawPanels(const Presenter::Frame& frame, std::optional<float> reduced) {
    wishes_ = screen_.drawPanels(frame, sceneFacts_, facts(reduced), arePanelsDue_);
    if (!wishes_.isEmpty()) panelsDue_ = picturesOfATouch;
}

// Adds the parameters of tools and playback.
Knobs Show::shownKnobs() const {
    Knobs knobs = knobs_;
    knobs.bladeDepth = tools_.depth();
    knobs.pace = static_cast<float>(controller_.playback.pace());
    return knobs;
}

Facts Show::facts(std::optional<float> reduced) const {
    Facts facts = gauges_.facts(stage_);
    facts.isPaused = controller_.playback.isPaused();
    facts.isDiverged = isDiverged_;
    facts.reduced = reduced;
    facts.isHolding = tools_.isHolding();
    facts.isBladeOn = tools_.isBladeOn();
    facts.isPokeOn = tools_.isPokeOn();
    facts.pins = tools_.pins();
    for (const std::uint64_t steps : tools_.history().times()) {
        char time[40];
        std::snprintf(time, sizeof time, "at %.2f s", static_cast<double>(steps) * double{stage_.scene().dt});
        facts.cuts.push_back(time);
    }
    facts.undos = tools_.history().undos();
    facts.scenes = library_.names();
    facts.scene = library_.current();
    facts.isOpening = library_.isOpening();
    facts.devices = devices_.list();
    facts.layers = screen_.layers();
    if (const auto& section = screen_.layers().section) {
        const Reach reach = reachOf(*section, opening_.light.bounds);
        facts.sectionReach = {reach.low, reach.high};
    }
    facts.map = mapRange_.newest();
    facts.mapRange = mapRange_.range();
    facts.contactsFound = contactsFound_;
    if (drawn_.layers.hasCells) facts.grids = grids_;
    if (drawn_.layers.hasLinks) facts.links = backstage_.inspection().links();
    facts.isPreparing = drawn_.layers != screen_.layers();
    facts.beside = besideFacts();
    facts.isInspecting = inspector_.isOn();
    facts.found = inspector_.found();
    facts.isRecording = recording_.has_value();
    facts.knobs = shownKnobs();
    facts.bladeDepths = {tools_.depths().least, tools_.depths().most};
    facts.pace = controller_.playback.pace();
    return facts;
}

} // namespace sinew::viewer
