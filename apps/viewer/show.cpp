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

constexpr double idleWait = 0.1;     // [s] at most between looks at signals while nothing moves
constexpr double strainEvery = 0.25; // [s]: a copy of all positions
constexpr double stillAfter = 0.25;  // [s] without a change before a paused picture is the last one

static_assert(Presenter::framesInFlight * Playback::maxSteps <= sim::Simulation::framesInFlight);
static_assert(Presenter::framesInFlight <= Renderer::slots);

// "organ-000120.png", or with a number where that exists.
std::filesystem::path screenshotFile(const std::string& scene, std::uint64_t step) {
    char stem[40];
    std::snprintf(stem, sizeof stem, "-%06" PRIu64, step);
    std::string name = scene + stem;
    for (char& c : name)
        if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 32) c = '_';
    std::filesystem::path file = name + ".png";
    for (int copy = 2; std::filesystem::exists(file); ++copy)
        file = name + "-" + std::to_string(copy) + ".png";
    return file;
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

Show::Show(Screen& screen, const vk::Device& device, const Opening& opening)
    : screen_(screen), device_(device), opening_(opening),
      controller_(opening.camera, opening.loaded.scene.dt),
      stage_(device, opening.loaded.scene, fastest(device, opening.loaded)),
      probe_(std::in_place, device, stage_.simulation()), tools_(device, opening),
      sceneFacts_(sceneFacts(opening, stage_, device)), gauges_(stage_, opening.loaded.scene.dt),
      moving_(device, screen.presenter().format(), isSoftware(device) ? reducedQuality() : Quality{},
              opening.light),
      status_(opening.loaded.scene, device) {
    if (isSoftware(device)) still_.emplace(device, screen_.presenter().format(), Quality{}, opening.light);
    const auto spans = static_cast<std::uint32_t>(stage_.simulation().phases().size());
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) times_.emplace_back(device, spans);
    stage_.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
    controller_.playback.reset(); // fills the buffers
}

Show::~Show() {
    try {
        screen_.presenter().waitIdle(); // an exception may have left frames in flight
    } catch (const vk::Error&) {        // of a lost device there is nothing to wait for
    }
}

void Show::run() {
    while (!screen_.window().isClosing() && !app::isInterrupted()) turn();
    settleAll();
    reportFiles(PictureWriter::Wait::yes);
}

void Show::turn() {
    Input input = screen_.window().poll(isHidden_ || shown_ == Shown::still ? idleWait : 0);
    const Wishes wishes = std::exchange(wishes_, {});
    input.actions.insert(input.actions.end(), wishes.actions.begin(), wishes.actions.end());
    handle(input);
    reportFiles(PictureWriter::Wait::no);
    isHidden_ = !prepareSwapchain();
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - std::exchange(lastTurn_, now)).count();
    if (isHidden_) return; // time stands still while nobody can look
    const Plan plan = controller_.playback.plan(elapsed);
    const bool isChanged = !controller_.playback.isPaused() || plan.isReset || plan.steps > 0 ||
                           !input.isEmpty() || input.panels.isTouched || screen_.hasNewNotice() ||
                           wantsScreenshot_ || wantsProbe_ || tools_.isWaiting() || shown_ == Shown::nothing;
    if (isChanged) lastChange_ = now;
    if (isChanged || shown_ != Shown::still) {
        const bool isLast = !isChanged && now - lastChange_ >= std::chrono::duration<double>(stillAfter);
        shown_ = isLast ? Shown::still : Shown::moving;
        gauges_.frame(elapsed, plan.steps);
        draw(plan, isLast && still_ ? *still_ : moving_);
        if (isLast) settleAll();
    }
    if (const auto title = status_.title(controller_.playback.isPaused(), isDiverged_))
        screen_.window().setTitle(*title);
}

void Show::handle(const Input& input) {
    for (const Action action : input.actions) {
        if (action == Action::drop && screen_.panels().isHelpShown())
            screen_.panels().closeHelp();
        else if (!controller_.act(action) && !tools_.act(action))
            handle(action);
    }
    tools_.handle(input, controller_);
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
    if (isDiverged_ && !plan.isReset) plan.steps = 0; // keeps the last finite picture
    const std::optional<Presenter::Frame> frame = screen_.presenter().begin();
    if (!frame) {
        if (plan.isReset) controller_.playback.reset();
        return;
    }
    recordSteps(*frame, plan);
    if (!view.canvas)
        view.canvas = view.renderer.makeCanvas(screen_.presenter().extent(), screen_.presenter().views());
    view.renderer.record(frame->commands, frame->slot, *view.canvas, frame->image, controller_.camera,
                         stage_.simulation(), tools_.overlay());
    if (std::exchange(wantsScreenshot_, false)) recordScreenshot(*frame);
    drawPanels(*frame, &view != &moving_ || !still_);
    screen_.presenter().end(*frame);
    status_.frameDrawn();
}

void Show::drawPanels(const Presenter::Frame& frame, bool isFullQuality) {
    wishes_ = screen_.drawPanels(frame, sceneFacts_, facts(isFullQuality));
    if (!wishes_.isEmpty()) lastChange_ = Clock::now();
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
    for (InFlight& flight : inFlight_) {
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

void Show::recordScreenshot(const Presenter::Frame& frame) {
    InFlight& flight = inFlight_[frame.slot];
    flight.screenshot = std::make_unique<Offscreen>(device_, screen_.presenter().extent(), opening_.light);
    flight.screenshotStep = stage_.steps();
    flight.screenshot->record(frame.commands, controller_.camera, stage_.simulation(), tools_.overlay());
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
    for (std::uint32_t i = 0; i < flight.steps && !isDiverged_; ++i) {
        const std::uint64_t step = flight.firstStep + i;
        if (stage_.neededRoom(step) > 0) {
            makeRoom(step, flight);
            break; // what came after it was undone as well
        }
        if (const std::optional<Divergence> divergence = stage_.check(step)) stop(divergence->sentence());
        const sim::Status status = stage_.simulation().status(step);
        status_.setCounts(status.sleeping, status.pieces);
        gauges_.stepFinished(status);
        isCut_ = status.linksCutInAll > 0;
        if (status.cutSurfaceMissing > 0) warnOfSurface();
    }
    if (flight.screenshot) {
        const std::filesystem::path file = screenshotFile(opening_.loaded.scene.name, flight.screenshotStep);
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
    if (flight.isMeasured) gauges_.strainMeasured(measureStrain(stage_.scene(), probe_->positions()));
    if (!flight.isProbed) return;
    if (const Box bounds = probe_->bounds(); !bounds.isEmpty()) {
        controller_.camera = framing(controller_.camera, bounds, aspect(screen_.presenter().extent()));
        shown_ = Shown::nothing; // what is on screen was seen from elsewhere
    }
}

// Once: nothing but the picture suffers.
void Show::warnOfSurface() {
    if (std::exchange(isSurfaceMissing_, true)) return;
    screen_.warn("the cuts have more surface than there is room for: it is not drawn");
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
    std::vector<Sweep> sweeps = undone.sweeps;
    for (const InFlight& later : inFlight_) // at most one has some
        sweeps.insert(sweeps.end(), later.sweeps.begin(), later.sweeps.end());
    tools_.restart(sweeps);
    for (InFlight& other : inFlight_) {
        other.steps = 0;
        other.sweeps.clear();
        wantsProbe_ = std::exchange(other.isProbed, false) || wantsProbe_;
        other.isMeasured = false;
        other.question.reset();
    }
}

void Show::settleAll() {
    screen_.presenter().waitIdle();
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) settle(slot);
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
