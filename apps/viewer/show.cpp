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

constexpr double idleWait = 0.1;    // [s] at most between looks at signals while nothing moves
constexpr double stillAfter = 0.25; // [s] without a change before a paused picture is the last one

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

Show::Show(Window& window, const vk::Device& device, const Opening& opening)
    : window_(window), device_(device), opening_(opening),
      controller_(opening.camera, opening.loaded.scene.dt),
      stage_(device, opening.loaded.scene, fastest(device, opening.loaded)),
      probe_(std::in_place, device, stage_.simulation()), tools_(device, opening), presenter_(device, window),
      moving_(device, presenter_.format(), isSoftware(device) ? reducedQuality() : Quality{}, opening.light),
      status_(opening.loaded.scene, device) {
    if (isSoftware(device)) still_.emplace(device, presenter_.format(), Quality{}, opening.light);
    const auto spans = static_cast<std::uint32_t>(stage_.simulation().phases().size());
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) times_.emplace_back(device, spans);
    stage_.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
    controller_.playback.reset(); // fills the buffers
}

Show::~Show() {
    try {
        presenter_.waitIdle();   // an exception may have left frames in flight
    } catch (const vk::Error&) { // of a lost device there is nothing to wait for
    }
}

void Show::run() {
    while (!window_.isClosing() && !app::isInterrupted()) turn();
    settleAll();
    reportFiles(PictureWriter::Wait::yes);
}

void Show::turn() {
    const Input input = window_.poll(isHidden_ || shown_ == Shown::still ? idleWait : 0);
    handle(input);
    reportFiles(PictureWriter::Wait::no);
    isHidden_ = !prepareSwapchain();
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - std::exchange(lastTurn_, now)).count();
    if (isHidden_) return; // time stands still while nobody can look
    const Plan plan = controller_.playback.plan(elapsed);
    const bool isChanged = !controller_.playback.isPaused() || plan.isReset || plan.steps > 0 ||
                           !input.isEmpty() || wantsScreenshot_ || wantsProbe_ || tools_.isWaiting() ||
                           shown_ == Shown::nothing;
    if (isChanged) lastChange_ = now;
    if (isChanged || shown_ != Shown::still) {
        const bool isLast = !isChanged && now - lastChange_ >= std::chrono::duration<double>(stillAfter);
        shown_ = isLast ? Shown::still : Shown::moving;
        draw(plan, isLast && still_ ? *still_ : moving_);
        if (isLast) settleAll();
    }
    if (const auto title = status_.title(controller_.playback.isPaused(), isDiverged_))
        window_.setTitle(*title);
}

void Show::handle(const Input& input) {
    for (const Action action : input.actions)
        if (!controller_.act(action) && !tools_.act(action)) handle(action);
    tools_.handle(input, controller_);
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
        window_.toggleFullScreen();
        break;
    case Action::vsync:
        isVsync_ = !isVsync_;
        pixels_ = {}; // makes a new swapchain
        break;
    case Action::help:
        std::printf("%s", helpText().c_str());
        std::fflush(stdout);
        break;
    case Action::quit:
        window_.close();
        break;
    default:
        break; // drags, the wheel, and what the controller has done
    }
}

// False while the window has no size.
bool Show::prepareSwapchain() {
    const VkExtent2D pixels = window_.pixels();
    const bool isSame = pixels.width == pixels_.width && pixels.height == pixels_.height;
    if (pixels.width > 0 && isSame && !presenter_.isOutdated()) return true;
    pixels_ = pixels;
    shown_ = Shown::nothing;
    if (pixels.width == 0) return false;
    presenter_.waitIdle();
    moving_.canvas.reset();
    if (still_) still_->canvas.reset();
    return presenter_.resize(pixels, isVsync_);
}

void Show::draw(Plan plan, View& view) {
    presenter_.waitForSlot();
    settle(presenter_.nextSlot());
    if (isDiverged_ && !plan.isReset) plan.steps = 0; // keeps the last finite picture
    const std::optional<Presenter::Frame> frame = presenter_.begin();
    if (!frame) {
        if (plan.isReset) controller_.playback.reset();
        return;
    }
    recordSteps(*frame, plan);
    if (!view.canvas) view.canvas = view.renderer.makeCanvas(presenter_.extent(), presenter_.views());
    view.renderer.record(frame->commands, frame->slot, *view.canvas, frame->image, controller_.camera,
                         stage_.simulation(), tools_.overlay());
    if (std::exchange(wantsScreenshot_, false)) recordScreenshot(*frame);
    presenter_.end(*frame);
    status_.frameDrawn();
}

void Show::recordSteps(const Presenter::Frame& frame, const Plan& plan) {
    InFlight& flight = inFlight_[frame.slot];
    if (plan.isReset) {
        stage_.recordReset(frame.commands);
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

// One copy is enough for all that is in flight: a question is asked again until it is answered.
void Show::recordProbe(const Presenter::Frame& frame) {
    InFlight& flight = inFlight_[frame.slot];
    const auto isAsked = [](const InFlight& other) { return other.isProbed || other.question; };
    if (std::ranges::any_of(inFlight_, isAsked)) return;
    flight.isProbed = std::exchange(wantsProbe_, false);
    flight.question = tools_.hand().question();
    if (isAsked(flight)) probe_->record(frame.commands);
}

void Show::recordScreenshot(const Presenter::Frame& frame) {
    InFlight& flight = inFlight_[frame.slot];
    flight.screenshot = std::make_unique<Offscreen>(device_, presenter_.extent(), opening_.light);
    flight.screenshotStep = stage_.steps();
    flight.screenshot->record(frame.commands, controller_.camera, stage_.simulation(), tools_.overlay());
}

// Takes what a finished frame has brought.
void Show::settle(std::uint32_t slot) {
    InFlight flight = std::exchange(inFlight_[slot], {});
    if (flight.steps > 0) {
        const std::vector<double> phases = times_[slot].milliseconds();
        if (!phases.empty()) status_.stepTimed(std::accumulate(phases.begin(), phases.end(), 0.0));
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
    if (!flight.isProbed) return;
    if (const Box bounds = probe_->bounds(); !bounds.isEmpty()) {
        controller_.camera = framing(controller_.camera, bounds, aspect(presenter_.extent()));
        shown_ = Shown::nothing; // what is on screen was seen from elsewhere
    }
}

// Once: nothing but the picture suffers.
void Show::warnOfSurface() {
    if (std::exchange(isSurfaceMissing_, true)) return;
    std::fprintf(stderr, "warning: the cuts have more surface than there is room for: it is not drawn\n");
}

void Show::stop(const std::string& why) {
    isDiverged_ = true;
    controller_.playback.pause();
    std::fprintf(stderr, "warning: %s\n", why.c_str());
}

// Later frames take the undone steps again.
void Show::makeRoom(std::uint64_t step, const InFlight& undone) {
    presenter_.waitIdle();
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
        other.question.reset();
    }
}

void Show::settleAll() {
    presenter_.waitIdle();
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot) settle(slot);
}

// A picture that cannot be written is no reason to close the window.
void Show::reportFiles(PictureWriter::Wait wait) {
    try {
        while (const auto file = writer_.take(wait)) {
            std::printf("picture: %s\n", file->c_str());
            std::fflush(stdout);
        }
    } catch (const mesh::ExportError& error) {
        std::fprintf(stderr, "warning: %s\n", error.what());
    }
}

} // namespace sinew::viewer
