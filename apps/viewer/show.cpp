// The loop of the window.
#include "viewer/show.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sim/gpu_tune.hpp"
#include "vk/check.hpp"
#include "vk/queue.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <numeric>

namespace sinew::viewer {

namespace {

constexpr double idleWait = 0.1;              // [s] at most between looks at signals while nothing moves
constexpr double strainEvery = 0.25;          // [s]: a copy of all positions
constexpr std::uint32_t picturesOfATouch = 3; // until Dear ImGui shows what a press has changed
constexpr double stillAfter = 0.25;           // [s] without a change before a paused picture is the last one

static_assert(Presenter::framesInFlight * Playback::maxSteps <= sim::Simulation::framesInFlight);
static_assert(Presenter::framesInFlight <= Renderer::slots);

// "organ-000120".
std::string nameAt(const std::string& scene, std::uint64_t step) {
    char stem[40];
    std::snprintf(stem, sizeof stem, "-%06" PRIu64, step);
    return scene + stem;
}

float aspect(VkExtent2D extent) {
    return static_cast<float>(extent.width) / static_cast<float>(extent.height);
}

// With a hand for the pointer.
sim::Settings fastest(const vk::Device& device, const scenes::LoadedScene& loaded) {
    vk::Queue queue(device);
    sim::Settings settings = loaded.settings;
    settings.grabs = std::max(settings.grabs, 1u);
    return sim::tuned(device, queue, loaded.scene, settings);
}

} // namespace

Show::View::View(const vk::Device& device, VkFormat format, const Quality& quality, const StageLight& light)
    : renderer(device, {.color = format, .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}, quality, light) {}

Show::Show(Screen& screen, Library& library, const vk::Device& device, std::unique_ptr<Opening> opening)
    : screen_(screen), library_(library), device_(device), ownOpening_(std::move(opening)),
      opening_(*ownOpening_), controller_(opening_.camera, opening_.loaded.scene.dt),
      stage_(device, opening_.loaded.scene, fastest(device, opening_.loaded)),
      probe_(std::in_place, device, stage_.simulation()), tools_(device, opening_),
      sceneFacts_(sceneFacts(opening_, stage_, device)), gauges_(stage_, opening_.loaded.scene.dt),
      knobs_(sceneFacts_.fromFile),
      moving_(device, screen.presenter().format(), isSoftware(device) ? reducedQuality() : Quality{},
              opening_.light),
      status_(opening_.loaded.scene, device) {
    if (isSoftware(device)) still_.emplace(device, screen.presenter().format(), Quality{}, opening_.light);
    const auto spans = static_cast<std::uint32_t>(stage_.simulation().phases().size());
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) times_.emplace_back(device, spans);
    stage_.setBlades({opening_.loaded.blades, opening_.loaded.scene.dt});
    controller_.playback.reset(); // fills the buffers
    if (opening_.again) goOn(*opening_.again);
}

// A scene that begins anew because something was turned is seen from where it was, and stays as it was
// turned.
void Show::goOn(const Again& again) {
    controller_.camera = again.camera;
    sceneFacts_.fromFile = again.fromFile;
    knobs_.gravity = again.turned.gravity;
    knobs_.pace = again.turned.pace;
    stage_.setGravity(knobs_.gravity);
    controller_.playback.setPace(double{knobs_.pace});
}

Show::~Show() {
    try {
        screen_.presenter().waitIdle(); // an exception may have left frames in flight
    } catch (const vk::Error&) {        // of a lost device there is nothing to wait for
    }
}

std::unique_ptr<Opening> Show::run() {
    std::unique_ptr<Opening> next;
    while (!next && !screen_.window().isClosing() && !app::isInterrupted()) {
        turn();
        next = takeOpened();
    }
    settleAll();
    stopRecording();
    reportFiles(PictureWriter::Wait::yes);
    shown_ = Shown::nothing; // should it go on
    return next;
}

// What cannot be opened leaves all as it is.
std::unique_ptr<Opening> Show::takeOpened() {
    try {
        return library_.take();
    } catch (const std::exception& error) {
        screen_.warn(error.what());
    }
    return nullptr;
}

// One at a time.
bool Show::mayOpen() {
    if (library_.isOpening()) screen_.tell("another scene is still being opened");
    return !library_.isOpening();
}

float Show::pictureAspect() const {
    const VkExtent2D extent = screen_.presenter().extent();
    return extent.height > 0 ? aspect(extent) : 1;
}

void Show::turn() {
    Input input =
        screen_.window().poll(isHidden_ || (shown_ == Shown::still && panelsDue_ == 0) ? idleWait : 0);
    const Wishes wishes = std::exchange(wishes_, {});
    grant(wishes);
    input.actions.insert(input.actions.end(), wishes.actions.begin(), wishes.actions.end());
    handle(input);
    reportFiles(PictureWriter::Wait::no);
    isHidden_ = !prepareSwapchain();
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - std::exchange(lastTurn_, now)).count();
    if (isHidden_) return; // time stands still while nobody can look
    const Plan plan = this->plan(elapsed);
    const bool isChanged = !controller_.playback.isPaused() || plan.isReset || plan.steps > 0 ||
                           !input.isEmpty() || wantsScreenshot_ || wantsProbe_ || tools_.isWaiting() ||
                           shown_ == Shown::nothing;
    if (isChanged) lastChange_ = now;
    // Panels change over a still scene without taking its quality away.
    if (input.panels.isTouched || screen_.hasNewNotice()) panelsDue_ = picturesOfATouch;
    if (isChanged || shown_ != Shown::still || panelsDue_ > 0) {
        const bool isLast = !isChanged && (shown_ == Shown::still ||
                                           now - lastChange_ >= std::chrono::duration<double>(stillAfter));
        panelsDue_ -= std::min(panelsDue_, 1u);
        shown_ = isLast ? Shown::still : Shown::moving;
        gauges_.frame(elapsed, plan.steps);
        draw(plan, isLast && still_ ? *still_ : moving_);
        if (isLast) settleAll();
    }
    if (const auto title = status_.title(controller_.playback.isPaused(), isDiverged_))
        screen_.window().setTitle(*title);
}

// A film has a picture of every step.
Plan Show::plan(double elapsed) {
    Plan plan = controller_.playback.plan(elapsed, recording_ ? 1 : Playback::maxSteps);
    if (recording_ && !controller_.playback.isPaused() && !plan.isReset) plan.steps = 1;
    return plan;
}

void Show::grant(const Wishes& wishes) {
    if (wishes.scene && mayOpen()) library_.open(*wishes.scene, pictureAspect());
    if (wishes.knobs) turnKnobs(*wishes.knobs);
}

void Show::turnKnobs(const Knobs& knobs) {
    if (knobs.gravity != knobs_.gravity) stage_.setGravity(knobs.gravity);
    controller_.playback.setPace(double{knobs.pace});
    knobs_.gravity = knobs.gravity;
    knobs_.pace = knobs.pace;
    const auto shape = [](const Knobs& some) { return std::pair(some.substeps, some.solver); };
    if (shape(knobs) == shape(knobs_) || library_.isOpening()) return;
    scenes::Overrides overrides;
    overrides.solver = sceneFacts_.solvers[static_cast<std::size_t>(knobs.solver)];
    overrides.substeps = static_cast<std::uint32_t>(knobs.substeps);
    library_.reopen(overrides, {controller_.camera, knobs, sceneFacts_.fromFile}, pictureAspect());
}

void Show::handle(const Input& input) {
    if (!input.files.empty() && mayOpen()) library_.openFile(input.files.front(), pictureAspect());
    for (const Action action : input.actions) {
        if (action == Action::drop && screen_.panels().isHelpShown())
            screen_.panels().closeHelp();
        else if (!controller_.act(action) && !tools_.act(action))
            handle(action);
    }
    tools_.handle(input, controller_);
    if (const std::string note = tools_.takeNote(); !note.empty()) screen_.tell(note);
    screen_.feed(input.panels);
    status_.setTool(tools_.name());
    if (input.notches != 0) controller_.wheel(input.notches, input.pointer);
}

void Show::handle(Action action) {
    switch (action) {
    case Action::frame:
        wantsProbe_ = true;
        break;
    case Action::screenshot:
        wantsScreenshot_ = true;
        break;
    case Action::fullScreen:
        screen_.window().toggleFullScreen();
        break;
    case Action::vsync:
        screen_.toggleVsync();
        break;
    case Action::previousScene:
        if (mayOpen()) library_.openNext(-1, pictureAspect());
        break;
    case Action::nextScene:
        if (mayOpen()) library_.openNext(1, pictureAspect());
        break;
    case Action::skinLook:
        screen_.layers().skin = next(screen_.layers().skin);
        break;
    case Action::wires:
        toggleWires();
        break;
    case Action::balls:
        screen_.layers().hasBalls = !screen_.layers().hasBalls;
        break;
    case Action::contacts:
        screen_.layers().hasContacts = !screen_.layers().hasContacts;
        break;
    case Action::colorMap:
        screen_.layers().map = next(screen_.layers().map);
        mapRange_ = {};
        break;
    case Action::record:
        toggleRecording();
        break;
    case Action::panels:
        screen_.panels().toggle();
        break;
    case Action::help:
        screen_.panels().toggleHelp();
        break;
    case Action::quit:
        screen_.window().close();
        break;
    default:
        break; // drags, the wheel, and what the controller has done
    }
}

// False while the window has no size.
bool Show::prepareSwapchain() {
    return screen_.prepare([this] {
        shown_ = Shown::nothing;
        moving_.canvas.reset();
        if (still_) still_->canvas.reset();
    });
}

void Show::draw(Plan plan, View& view) {
    screen_.presenter().waitForSlot();
    settle(screen_.presenter().nextSlot());
    if (surfaceMissing_ > 0) makeSurfaceRoom();
    if (isDiverged_ && !plan.isReset) plan.steps = 0; // keeps the last finite picture
    const std::optional<Presenter::Frame> frame = screen_.presenter().begin();
    if (!frame) {
        if (plan.isReset) controller_.playback.reset();
        return;
    }
    recordSteps(*frame, plan);
    const Overlay overlay = recordLayers(*frame);
    if (recording_ && plan.steps > 0) recordCamera(*frame, overlay);
    if (!view.canvas)
        view.canvas = view.renderer.makeCanvas(screen_.presenter().extent(), screen_.presenter().views());
    view.renderer.prepare(overlay.layers);
    view.renderer.record(frame->commands, frame->slot, *view.canvas, frame->image, controller_.camera,
                         stage_.simulation(), overlay);
    if (std::exchange(wantsScreenshot_, false)) recordScreenshot(*frame, overlay);
    drawPanels(*frame, &view != &moving_ || !still_);
    screen_.presenter().end(*frame);
    status_.frameDrawn();
}

void Show::drawPanels(const Presenter::Frame& frame, bool isFullQuality) {
    wishes_ = screen_.drawPanels(frame, sceneFacts_, facts(isFullQuality));
    if (!wishes_.isEmpty()) panelsDue_ = picturesOfATouch;
}

Facts Show::facts(bool isFullQuality) const {
    Facts facts = gauges_.facts(stage_);
    facts.isPaused = controller_.playback.isPaused();
    facts.isDiverged = isDiverged_;
    facts.isFullQuality = isFullQuality;
    facts.isHolding = tools_.isHolding();
    facts.isBladeOn = tools_.isBladeOn();
    for (const std::uint64_t steps : tools_.history().times()) {
        char time[40];
        std::snprintf(time, sizeof time, "at %.2f s", static_cast<double>(steps) * double{stage_.scene().dt});
        facts.cuts.push_back(time);
    }
    facts.undos = tools_.history().undos();
    facts.scenes = library_.names();
    facts.scene = library_.current();
    facts.isOpening = library_.isOpening();
    facts.layers = screen_.layers();
    facts.map = mapRange_.newest();
    facts.mapRange = mapRange_.range();
    facts.contactsFound = contactsFound_;
    facts.isRecording = recording_.has_value();
    facts.knobs = knobs_;
    facts.pace = controller_.playback.pace();
    facts.knobs.pace = static_cast<float>(facts.pace);
    return facts;
}

void Show::recordSteps(const Presenter::Frame& frame, const Plan& plan) {
    InFlight& flight = inFlight_[frame.slot];
    if (plan.isReset) {
        stage_.recordReset(frame.commands);
        gauges_.restart();
        tools_.drop();
        forgetFlights();
        isDiverged_ = false;
    }
    if (tools_.recordHistory(frame.commands, stage_)) {
        forgetFlights();
        isDiverged_ = false;
    }
    flight.firstStep = stage_.steps() + 1;
    flight.steps = plan.steps;
    for (std::uint32_t step = 0; step < plan.steps; ++step)
        tools_.recordStep(frame.commands, stage_, step == 0 ? &times_[frame.slot] : nullptr, flight.sweeps);
    stage_.recordSkin(frame.commands);
    recordProbe(frame);
}

// What is on its way belongs to a state that is no more: nobody need look at it, nor cut it again.
void Show::forgetFlights() {
    if (recording_) screen_.presenter().waitIdle(); // the film keeps what has happened
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) {
        InFlight& flight = inFlight_[slot];
        if (std::exchange(flight.isRecorded, false)) settleCamera(slot, flight);
        flight.steps = 0;
        flight.sweeps.clear();
    }
}

// The length of cut links says nothing of error.
bool Show::isStrainDue(std::uint32_t steps) {
    const auto now = Clock::now();
    const bool isDue = steps > 0 && !isCut_ && screen_.panels().isShown(screen_.presenter().extent()) &&
                       now - lastStrain_ >= std::chrono::duration<double>(strainEvery);
    if (isDue) lastStrain_ = now;
    return isDue;
}

// One copy is enough for all that is in flight: a question is asked again until it is answered.
void Show::recordProbe(const Presenter::Frame& frame) {
    InFlight& flight = inFlight_[frame.slot];
    const auto isAsked = [](const InFlight& other) {
        return other.isProbed || other.question || other.isMeasured;
    };
    if (std::ranges::any_of(inFlight_, isAsked)) return;
    flight.isProbed = std::exchange(wantsProbe_, false);
    flight.question = tools_.hand().question();
    flight.isMeasured = isStrainDue(flight.steps);
    if (isAsked(flight)) probe_->record(frame.commands);
}

// Without memory for them there are no layers.
Overlay Show::recordLayers(const Presenter::Frame& frame) {
    Overlay overlay = tools_.overlay();
    Layers& layers = screen_.layers();
    if (layers.needsBuffers()) {
        try {
            if (!inspection_) inspection_.emplace(device_, stage_, Presenter::framesInFlight);
            inspection_->prepare(layers);
        } catch (const vk::Error& error) {
            if (error.failure() != vk::Failure::outOfMemory) throw;
            layers = {};
            screen_.warn(error.what());
            return overlay;
        }
        inspection_->record(frame.commands, layers, frame.slot);
        inFlight_[frame.slot].map = layers.map;
        inFlight_[frame.slot].hasContacts = layers.hasContacts;
        overlay.buffers = inspection_->buffers(layers, mapRange_.range());
    }
    overlay.layers = layers;
    return overlay;
}

void Show::toggleWires() {
    if (!drawsEdges(device_)) return screen_.warn("this device cannot draw the edges of triangles");
    screen_.layers().hasWires = !screen_.layers().hasWires;
}

void Show::recordScreenshot(const Presenter::Frame& frame, const Overlay& overlay) {
    InFlight& flight = inFlight_[frame.slot];
    try {
        flight.screenshot =
            std::make_unique<Offscreen>(device_, screen_.presenter().extent(), opening_.light);
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        return screen_.warn(std::string("no picture: ") + error.what());
    }
    flight.screenshotStep = stage_.steps();
    flight.screenshot->prepare(overlay.layers);
    flight.screenshot->record(frame.commands, controller_.camera, stage_.simulation(), overlay);
}

// Takes what a finished frame has brought.
void Show::settle(std::uint32_t slot) {
    InFlight flight = std::exchange(inFlight_[slot], {});
    if (flight.steps > 0) {
        const std::vector<double> phases = times_[slot].milliseconds();
        if (!phases.empty()) status_.stepTimed(std::accumulate(phases.begin(), phases.end(), 0.0));
        gauges_.stepTimed(phases);
    }
    settleProbe(flight);
    settleMap(slot, flight);
    if (flight.hasContacts && inspection_) contactsFound_ = inspection_->contacts(slot);
    bool isUndone = false;
    for (std::uint32_t i = 0; i < flight.steps && !isDiverged_; ++i) {
        const std::uint64_t step = flight.firstStep + i;
        if (stage_.neededRoom(step) > 0) {
            makeRoom(step, flight);
            isUndone = true;
            break; // what came after it was undone as well
        }
        if (const std::optional<Divergence> divergence = stage_.check(step)) stop(divergence->sentence());
        const sim::Status status = stage_.simulation().status(step);
        status_.setCounts(status.sleeping, status.pieces);
        gauges_.stepFinished(status);
        isCut_ = status.linksCutInAll > 0;
        surfaceMissing_ = status.cutSurfaceMissing;
    }
    if (flight.isRecorded && !isUndone) settleCamera(slot, flight);
    if (flight.screenshot) {
        const std::string name = nameAt(opening_.loaded.scene.name, flight.screenshotStep);
        const std::filesystem::path file = freeName(name, ".png");
        writer_.add(file, flight.screenshot->read(), pictureText(opening_, device_, flight.screenshotStep));
    }
}

void Show::settleProbe(InFlight& flight) {
    if (flight.question && flight.question == tools_.hand().question()) {
        const sim::Scene& scene = stage_.scene();
        const auto found =
            pick(scene, opening_.light.balls, *flight.question, probe_->positions(), probe_->vertices());
        tools_.hand().answer(found, found ? holdRadius(scene, found->particle) : 0);
    }
    if (flight.isMeasured && !isCut_)
        gauges_.strainMeasured(measureStrain(stage_.scene(), probe_->positions()));
    if (!flight.isProbed) return;
    if (const Box bounds = probe_->bounds(); !bounds.isEmpty()) {
        controller_.camera = framing(controller_.camera, bounds, aspect(screen_.presenter().extent()));
        shown_ = Shown::nothing; // what is on screen was seen from elsewhere
    }
}

// A picture whose colors have another range by now is drawn once more.
void Show::settleMap(std::uint32_t slot, const InFlight& flight) {
    if (flight.map == ColorMap::none || flight.map != screen_.layers().map || !inspection_) return;
    const float before = mapRange_.range();
    mapRange_.read(inspection_->reading(slot));
    if (mapRange_.range() != before) shown_ = Shown::nothing;
}

// All steps have been taken: only the picture lacked something.
void Show::makeSurfaceRoom() {
    if (isSurfaceMissing_) return; // there is no such room
    settleAll();
    const std::uint32_t needed = std::exchange(surfaceMissing_, 0);
    if (needed == 0) return; // somebody has gone back to before
    vk::Queue queue(device_);
    if (!stage_.makeSurfaceRoom(needed, queue)) return warnOfSurface();
    probe_.emplace(device_, stage_.simulation());
    inspection_.reset(); // as layers want it, of the other simulation
    tools_.restart({});
    shown_ = Shown::nothing;
}

// Once: nothing but the picture suffers.
void Show::warnOfSurface() {
    if (std::exchange(isSurfaceMissing_, true)) return;
    screen_.warn(
        "the cuts have more surface than there is memory for: what is beyond is not drawn, or drawn uncut");
}

void Show::stop(const std::string& why) {
    isDiverged_ = true;
    controller_.playback.pause();
    screen_.warn(why);
}

// Later frames take the undone steps again.
void Show::makeRoom(std::uint64_t step, const InFlight& undone) {
    screen_.presenter().waitIdle();
    vk::Queue queue(device_);
    if (!stage_.makeRoom(step, queue)) return stop(app::tooCrowded(step));
    probe_.emplace(device_, stage_.simulation());
    inspection_.reset(); // as layers want it, of the other simulation
    std::vector<Sweep> sweeps = undone.sweeps;
    for (const InFlight& later : inFlight_) // at most one has some
        sweeps.insert(sweeps.end(), later.sweeps.begin(), later.sweeps.end());
    tools_.restart(sweeps);
    for (InFlight& other : inFlight_) {
        other.steps = 0;
        other.sweeps.clear();
        wantsProbe_ = std::exchange(other.isProbed, false) || wantsProbe_;
        other.isMeasured = other.isRecorded = false;
        other.map = ColorMap::none;
        other.hasContacts = false;
        other.question.reset();
    }
}

void Show::settleAll() {
    screen_.presenter().waitIdle();
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) settle(slot);
}

void Show::toggleRecording() {
    if (recording_) return stopRecording();
    const VkExtent2D extent = screen_.presenter().extent();
    screen_.presenter().waitIdle(); // frames may still use the cameras of a film that failed
    try {
        recording_.emplace(nameAt(opening_.loaded.scene.name, stage_.steps()), extent.width, extent.height,
                           1 / double{stage_.scene().dt});
        for (auto& camera : cameras_) camera = std::make_unique<Offscreen>(device_, extent, opening_.light);
        std::printf("recording %s\n", recording_->target().c_str());
        std::fflush(stdout);
        screen_.tell("recording " + recording_->target().string() + ", a picture a step; " +
                     std::string(keyOf(Action::record)) + " stops");
    } catch (const std::runtime_error& error) { // app::Failure; vk::Error: no memory for the pictures
        recording_.reset();
        screen_.warn(error.what());
    }
}

void Show::stopRecording() {
    if (!recording_) return;
    settleAll(); // the last pictures
    if (!recording_) return;
    try {
        recording_->finish();
        const std::string text =
            std::to_string(recording_->count()) + " pictures in " + recording_->target().string();
        std::printf("%s\n", text.c_str());
        std::fflush(stdout);
        screen_.tell(text);
    } catch (const std::runtime_error& error) { // app::Failure, mesh::ExportError
        screen_.warn(error.what());
    }
    recording_.reset();
    for (auto& camera : cameras_) camera.reset();
}

void Show::recordCamera(const Presenter::Frame& frame, const Overlay& overlay) {
    cameras_[frame.slot]->prepare(overlay.layers);
    cameras_[frame.slot]->record(frame.commands, controller_.camera, stage_.simulation(), overlay);
    inFlight_[frame.slot].isRecorded = true;
}

// What goes wrong here ends the film, and nothing else.
void Show::settleCamera(std::uint32_t slot, const InFlight& flight) {
    if (!recording_) return;
    try {
        const std::uint64_t step = flight.firstStep + flight.steps - 1;
        recording_->add(cameras_[slot]->read(), pictureText(opening_, device_, step));
    } catch (const vk::Error&) {
        throw;
    } catch (const std::runtime_error& error) { // app::Failure, mesh::ExportError
        recording_.reset();
        for (InFlight& other : inFlight_) other.isRecorded = false;
        screen_.warn(error.what());
    }
}

// A picture that cannot be written is no reason to close the window.
void Show::reportFiles(PictureWriter::Wait wait) {
    try {
        while (const auto file = writer_.take(wait)) {
            std::printf("picture: %s\n", file->c_str());
            std::fflush(stdout);
            screen_.tell("picture: " + file->string());
        }
    } catch (const mesh::ExportError& error) {
        screen_.warn(error.what());
    }
}

} // namespace sinew::viewer
