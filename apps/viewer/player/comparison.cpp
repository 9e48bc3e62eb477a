// A thread makes it. Rehearsals in LayerLoader put it into the state of the first.
#include "viewer/player/comparison.hpp"

#include "sinew/vk/check.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

namespace sinew::viewer {

namespace {

// The first complaint of several.
std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

} // namespace

void Comparison::toggle() {
    Session& session = player_.session;
    isOfScene_ = true;
    isInstead_ = false;
    session.isBesideDefault() = !session.beside();
    if (session.beside())
        session.beside().reset();
    else
        session.beside() = defaultShape();
}

BesideShape Comparison::defaultShape() const {
    const bool isGaussSeidel = player_.document.settings().solver == sim::Solver::gaussSeidel;
    return {isGaussSeidel ? sim::Solver::split : sim::Solver::gaussSeidel};
}

// A comparison that the key B began in the scene before begins anew: another default may suit this scene.
void Comparison::beginInScene() {
    Session& session = player_.session;
    if (std::exchange(isOfScene_, true) || !session.beside() || !session.isBesideDefault()) return;
    session.beside() = defaultShape();
}

// A solver that the key B has chosen cannot play the scene: compares with fewer substeps. False if nothing
// else can be shown, or if the user has chosen the solver.
bool Comparison::compareInstead() {
    std::optional<BesideShape>& wanted = player_.session.beside();
    const auto instead = shapeInstead(player_.document.settings());
    if (!player_.session.isBesideDefault() || isInstead_ || !instead || wanted != asked_) return false;
    isInstead_ = true;
    player_.session.tell(toText(*asked_) + " cannot play this scene; comparing " + toText(*instead));
    wanted = instead;
    return true;
}

void Comparison::tend(bool isDiverged) {
    beginInScene();
    const std::optional<BesideShape>& wanted = player_.session.beside();
    if (making_.valid()) {
        if (making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) take();
    } else if (wanted && (wanted != asked_ || !isFit())) {
        make(*wanted, beside_ ? beside_->document().settings() : player_.document.settings());
    } else if (!wanted && asked_) {
        drop();
    } else if (beside_ && isBehind_ && !player_.document.lacksContactRoom() && !isDiverged) {
        player_.settleAll();
        layerLoader_.rehearse(
            [this](VkCommandBuffer commands) { beside_->recordTakeOver(commands, player_.document); });
        isBehind_ = false;
        player_.redraw();
    }
}

// The material of the first, and room enough to go on from its state.
bool Comparison::isFit() const {
    if (!beside_) return true;
    const Document& beside = beside_->document();
    return beside.material() == player_.document.material() &&
           (!isBehind_ || beside.hasRoomOf(player_.document));
}

// Starts to make the second simulation with the first one's capacities, and at least those of `room`.
void Comparison::make(const BesideShape& shape, const sim::Settings& room) {
    asked_ = shape;
    const sim::Settings settings = sim::withRoomsOf(player_.document.settings(), room);
    making_ = std::async(std::launch::async, [this, shape, settings, material = player_.document.material()] {
        return std::make_unique<SecondSimulation>(player_.device, player_.opening.loaded, settings, material,
                                                  shape, Presenter::framesInFlight);
    });
}

// It goes on from the state of the first; a step before that is its rehearsal. If the first has come to more
// room meanwhile, another one is made at once; if it has another material, by tend().
void Comparison::take() {
    std::unique_ptr<SecondSimulation> made;
    try {
        made = making_.get();
    } catch (const std::invalid_argument& error) {
        if (compareInstead()) return drop();
        player_.session.warn("Can't compare: " + firstLine(error.what()));
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        player_.session.warn(std::string("Can't compare: ") + error.what());
    }
    if (!made || !player_.session.beside()) {
        player_.session.beside().reset();
        return drop();
    }
    if (!made->document().hasRoomOf(player_.document)) return make(*asked_, made->document().settings());
    const std::optional<BesideShape> asked = asked_;
    drop();
    asked_ = asked; // another one may be wanted by now: that is made then
    beside_ = std::move(made);
    const bool isExpected = std::exchange(isInstead_, false); // fewer substeps are softer
    for (const std::string& warning : beside_->warnings())
        if (!isExpected) player_.session.warn("beside: " + warning);
    for (const std::string& note : beside_->notes()) player_.session.note("beside: " + note);
    layerLoader_.rehearse([this](VkCommandBuffer commands) {
        beside_->recordReset(commands);
        beside_->recordStep(commands, player_.document, {}, 0, false);
        beside_->recordTakeOver(commands, player_.document);
    });
    isBehind_ = false;
    player_.redraw();
}

void Comparison::drop() {
    isBehind_ = true; // results of it are not wanted any more
    player_.settleAll();
    beside_.reset();
    asked_.reset();
    player_.redraw();
}

void Comparison::recordReset(VkCommandBuffer commands) noexcept {
    if (beside_) beside_->recordReset(commands);
    isBehind_ = false;
}

void Comparison::recordStep(const Presenter::Frame& frame, const StepHands& hands, bool isTimed) noexcept {
    if (beside_ && !isBehind_)
        beside_->recordStep(frame.commands, player_.document, hands, frame.slot, isTimed);
}

void Comparison::recordPicture(const Presenter::Frame& frame, bool isMeasured) noexcept {
    if (beside_) beside_->recordPicture(frame.commands, frame.slot, isMeasured);
}

void Comparison::settle(std::uint32_t slot, const StateProbe* first) {
    if (!beside_) return;
    const auto trouble = beside_->settle(slot, isBehind_ ? nullptr : first);
    if (!trouble || isBehind_) return;
    player_.session.presenter().waitIdle();
    sim::Settings room = beside_->document().settings();
    beside_.reset();
    if (trouble->room > 0) { // as the first does, but from the state of the first
        room.contactRoom = trouble->room;
        if (!making_.valid()) make(*asked_, room);
        return;
    }
    player_.session.warn("beside: " + trouble->why);
    player_.session.beside().reset();
}

float Comparison::pictureAspect() const {
    const VkExtent2D extent = player_.session.presenter().extent();
    if (extent.height == 0) return 1;
    const auto width = beside_ ? 0.5f * static_cast<float>(halvesWidth()) : static_cast<float>(freeWidth());
    return width / static_cast<float>(extent.height);
}

float Comparison::shift() const {
    const VkExtent2D extent = player_.session.presenter().extent();
    if (beside_ || extent.height == 0) return 0;
    if (heldShift_) return *heldShift_;
    return 0.5f * (static_cast<float>(freeWidth()) - static_cast<float>(extent.width)) /
           static_cast<float>(extent.height);
}

// Panels that leave less than a quarter of the window cover the picture.
std::uint32_t Comparison::freeWidth() const {
    const VkExtent2D extent = player_.session.presenter().extent();
    const std::uint32_t side = player_.session.panels().sideWidth(extent);
    return 4 * side <= 3 * extent.width ? extent.width - side : extent.width;
}

// Both halves stand beside the panels, if those leave room.
std::uint32_t Comparison::halvesWidth() const {
    const VkExtent2D extent = player_.session.presenter().extent();
    const std::uint32_t side = player_.session.panels().sideWidth(extent);
    return 2 * side < extent.width ? extent.width - side : extent.width;
}

void Comparison::fold(Input& input) {
    const VkExtent2D extent = player_.session.presenter().extent();
    const auto foldAt = [&](const Vector2& at) {
        if (!beside_ || extent.height == 0) return shift();
        const auto width = static_cast<float>(halvesWidth()), whole = static_cast<float>(extent.width),
                   height = static_cast<float>(extent.height);
        const bool isRight = at.x() * height + 0.5f * (whole - width) >= 0;
        return ((isRight ? 0.75f : 0.25f) * width - 0.5f * whole) / height;
    };
    if (!isButtonDown_) fold_ = foldAt(input.pointer);
    for (Input::Press& press : input.presses) {
        heldShift_.reset();
        if (press.isDown) fold_ = foldAt(press.pointer);
        if (press.isDown && !beside_) heldShift_ = fold_;
        isButtonDown_ = press.isDown;
        press.pointer.x() -= fold_;
    }
    input.pointer.x() -= fold_;
}

void Comparison::takeOver(const Comparison& before) {
    fold_ = before.fold_;
    heldShift_ = before.heldShift_;
    isButtonDown_ = before.isButtonDown_;
    isOfScene_ = before.isOfScene_; // it is the same scene
}

void Comparison::drawHalves(const Presenter::Frame& frame, const Overlay& overlay, View& view) {
    Presenter& presenter = player_.session.presenter();
    const std::uint32_t width = halvesWidth();
    if (view.halves && view.halves->width != width) {
        presenter.waitIdle(); // the other frame may use them; this one is not submitted yet
        view.halves.reset();
    }
    if (!view.halves)
        view.halves.emplace(view.renderer.makeHalves(presenter.extent(), presenter.views(), width));
    const std::uint32_t other = frame.slot + 3 * Presenter::framesInFlight;
    const Camera& camera = player_.controller.camera;
    for (Canvas& canvas : view.halves->canvases) view.renderer.prepareCanvas(overlay.layers, canvas);
    view.renderer.record(frame.commands, frame.slot, view.halves->canvases[0], 0, camera,
                         player_.document.simulation(), overlay);
    view.renderer.record(frame.commands, other, view.halves->canvases[1], 0, camera, beside_->simulation(),
                         overlayBeside(overlay));
    view.renderer.recordHalves(frame.commands, {frame.slot, other}, *view.halves, frame.image);
}

BesideFacts Comparison::facts() const {
    BesideFacts facts{.isOn = player_.session.beside().has_value(), .isMaking = making_.valid()};
    facts.knobs = knobsOf(player_.session.beside().value_or(defaultShape()));
    if (!beside_) return facts;
    const sim::Settings& first = player_.document.settings();
    const Facts measured = beside_->facts();
    facts.names = {toText({first.solver, first.substeps}), toText(beside_->shape())};
    facts.phases = measured.phases;
    facts.strainRms = measured.strainRms;
    facts.strainMax = measured.strainMax;
    if (!isBehind_) facts.apart = beside_->apart();
    return facts;
}

} // namespace sinew::viewer
