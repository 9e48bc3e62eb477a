// Comparison: another simulation is made in a thread, kept in step, and drawn in the right half.
#include "viewer/show.hpp"

#include "vk/check.hpp"

#include <stdexcept>
#include <utility>

namespace sinew::viewer {

namespace {

// The first line of a message.
std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

} // namespace

void Show::toggleBeside() {
    std::optional<BesideShape>& wanted = screen_.beside();
    if (!wanted)
        wanted = BesideShape{stage_.settings().solver == sim::Solver::gaussSeidel ? sim::Solver::split
                                                                                  : sim::Solver::gaussSeidel};
    else
        wanted.reset();
}

// Makes or drops the second simulation when the request has changed.
void Show::tendBeside() {
    const std::optional<BesideShape>& wanted = screen_.beside();
    if (besideMaking_.valid()) {
        if (besideMaking_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) takeBeside();
    } else if (wanted && (wanted != besideAsked_ || !isBesideFit())) {
        makeBeside(*wanted, beside_ ? beside_->stage().settings() : stage_.settings());
    } else if (!wanted && besideAsked_) {
        dropBeside();
    } else if (beside_ && isBesideOut_ && !stage_.lacksContactRoom() && !isDiverged_) {
        settleAll();
        backstage_.rehearse([this](VkCommandBuffer commands) { beside_->recordTakeOver(commands, stage_); });
        isBesideOut_ = false;
        shown_ = Shown::nothing;
    }
}

// Whether it has the first one's material and, if it is to take over, the capacities.
bool Show::isBesideFit() const {
    if (!beside_) return true;
    const Stage& beside = beside_->stage();
    return beside.material() == stage_.material() && (!isBesideOut_ || beside.hasRoomOf(stage_));
}

// Starts to make the second simulation with the first one's capacities, and at least those of `room`.
void Show::makeBeside(const BesideShape& shape, const sim::Settings& room) {
    besideAsked_ = shape;
    const sim::Settings settings = sim::withRoomsOf(stage_.settings(), room);
    besideMaking_ = std::async(std::launch::async, [this, shape, settings, material = stage_.material()] {
        return std::make_unique<Beside>(device_, opening_.loaded, settings, material, shape,
                                        Presenter::framesInFlight);
    });
}

// Takes over from the first simulation, after a rehearsal step. If the first has grown meanwhile, another one
// is made at once; if its material has changed, tendBeside() makes another.
void Show::takeBeside() {
    std::unique_ptr<Beside> made;
    try {
        made = besideMaking_.get();
    } catch (const std::invalid_argument& error) {
        screen_.warn("not beside: " + firstLine(error.what()));
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        screen_.warn(std::string("not beside: ") + error.what());
    }
    if (!made || !screen_.beside()) {
        screen_.beside().reset();
        return dropBeside();
    }
    if (!made->stage().hasRoomOf(stage_)) return makeBeside(*besideAsked_, made->stage().settings());
    const std::optional<BesideShape> asked = besideAsked_;
    dropBeside();
    besideAsked_ = asked; // for tendBeside(), if the request has changed
    beside_ = std::move(made);
    for (const std::string& warning : beside_->warnings()) screen_.warn("beside: " + warning);
    for (const std::string& note : beside_->notes()) screen_.note("beside: " + note);
    backstage_.rehearse([this](VkCommandBuffer commands) {
        beside_->recordReset(commands);
        beside_->recordStep(commands, stage_, {}, 0, false);
        beside_->recordTakeOver(commands, stage_);
    });
    isBesideOut_ = false;
    shown_ = Shown::nothing;
}

void Show::dropBeside() {
    isBesideOut_ = true; // its results are no longer needed
    settleAll();
    beside_.reset();
    besideAsked_.reset();
    shown_ = Shown::nothing;
}

void Show::settleBeside(std::uint32_t slot) {
    if (!beside_) return;
    const std::optional<Beside::Trouble> trouble = beside_->settle(slot);
    if (!trouble || isBesideOut_) return;
    screen_.presenter().waitIdle();
    sim::Settings room = beside_->stage().settings();
    beside_.reset();
    if (trouble->room > 0) { // made again, from the state of the first
        room.contactRoom = trouble->room;
        if (!besideMaking_.valid()) makeBeside(*besideAsked_, room);
        return;
    }
    screen_.warn("beside: " + trouble->why);
    screen_.beside().reset();
}

// Width beside the panels, if that is at least half of the window.
std::uint32_t Show::halvesWidth() const {
    const VkExtent2D extent = screen_.presenter().extent();
    const std::uint32_t side = screen_.panels().sideWidth(extent);
    return 2 * side < extent.width ? extent.width - side : extent.width;
}

// Maps the pointer from either half to the whole. A press selects the half until the release, even if halves
// appear or vanish.
void Show::foldPointer(Input& input) {
    const VkExtent2D extent = screen_.presenter().extent();
    const auto foldAt = [&](const Vector2& at) {
        if (!beside_ || extent.height == 0) return 0.0f;
        const auto width = static_cast<float>(halvesWidth()), whole = static_cast<float>(extent.width),
                   height = static_cast<float>(extent.height);
        const bool isRight = at.x() * height + 0.5f * (whole - width) >= 0;
        return ((isRight ? 0.75f : 0.25f) * width - 0.5f * whole) / height;
    };
    if (!isButtonDown_) fold_ = foldAt(input.pointer);
    for (Input::Press& press : input.presses) {
        if (press.isDown) fold_ = foldAt(press.pointer);
        isButtonDown_ = press.isDown;
        press.pointer.x() -= fold_;
    }
    input.pointer.x() -= fold_;
}

void Show::drawHalves(const Presenter::Frame& frame, const Overlay& overlay, View& view) {
    const std::uint32_t width = halvesWidth();
    if (view.halves && view.halves->width != width) {
        screen_.presenter().waitIdle(); // the other frame may use them; this one is not submitted yet
        view.halves.reset();
    }
    if (!view.halves)
        view.halves.emplace(
            view.renderer.makeHalves(screen_.presenter().extent(), screen_.presenter().views(), width));
    const std::uint32_t other = frame.slot + 3 * Presenter::framesInFlight;
    for (Canvas& canvas : view.halves->canvases) view.renderer.prepareCanvas(overlay.layers, canvas);
    view.renderer.record(frame.commands, frame.slot, view.halves->canvases[0], 0, controller_.camera,
                         stage_.simulation(), overlay);
    view.renderer.record(frame.commands, other, view.halves->canvases[1], 0, controller_.camera,
                         beside_->simulation(), overlayBeside(overlay));
    view.renderer.recordHalves(frame.commands, {frame.slot, other}, *view.halves, frame.image);
}

BesideFacts Show::besideFacts() const {
    BesideFacts facts{.isOn = screen_.beside().has_value(), .isMaking = besideMaking_.valid()};
    if (const auto& wanted = screen_.beside()) facts.knobs = knobsOf(*wanted);
    if (!beside_) return facts;
    const sim::Settings& first = stage_.settings();
    const Facts measured = beside_->facts();
    facts.names = {toText({first.solver, first.substeps}), toText(beside_->shape())};
    facts.phases = measured.phases;
    facts.strainRms = measured.strainRms;
    facts.strainMax = measured.strainMax;
    return facts;
}

} // namespace sinew::viewer
