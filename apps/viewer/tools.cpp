// One pointer, three tools: the left button belongs to the one that is out.
#include "viewer/tools.hpp"

#include "viewer/hands/controller.hpp"
#include "viewer/opening.hpp"
#include "vk/check.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace sinew::viewer {

Tools::Tools(const vk::Device& device, const Opening& opening)
    : blade_(opening.light.bounds), poke_(opening.light.radius(), opening.loaded.scene.planes),
      history_(device, History::mostCuts), steps_(device, History::mostSteps),
      pinReach_(0.04f * opening.light.radius()),
      canCut_(std::ranges::any_of(opening.loaded.scene.grids, &sim::Grid::isCuttable)) {}

void recordStep(VkCommandBuffer commands, Stage& stage, const StepHands& hands,
                vk::Timestamps* timestamps) noexcept {
    sim::Blade blade;
    if (hands.sweep)
        blade = {.from = hands.sweep->from, .to = hands.sweep->to, .isCarried = hands.sweep->isCarried};
    const std::span<const sim::Poke> pokes =
        hands.poke ? std::span(&*hands.poke, 1) : std::span<const sim::Poke>();
    stage.recordStep(commands, timestamps, hands.grabs, blade, pokes);
}

void Tools::handle(const Input& input, Controller& controller) {
    look(controller.camera);
    for (const Input::Press& one : input.presses)
        if (one.action == Action::grab) press(controller.camera, one.isDown, one.pointer);
    for (const Input::Drag& drag : input.drags) {
        if (drag.action != Action::grab)
            controller.drag(drag.action, drag.heights);
        else if (const Vector2 turn = hand_.drag(drag.heights);
                 !blade_.isOn() && !poke_.isOn() && !turn.isZero())
            controller.drag(Action::orbit, turn);
    }
    look(controller.camera);
    if (input.growth != 0 && poke_.isOn()) {
        poke_.grow(input.growth);
        log_.size(poke_.radius());
    }
    move(controller.camera, input.pointer);
}

void Tools::move(const Camera& camera, const Vector2& pointer) {
    if (hand_.isHolding() || blade_.isOn() || poke_.isDown() || wantsPin_) log_.point(pointer);
    hand_.move(camera, pointer);
    blade_.move(camera, pointer);
    poke_.move(camera, pointer);
    if (std::exchange(wantsPin_, false)) pinAt(rayThrough(camera, pointer));
}

// What is held goes from hand to pin.
void Tools::pinAt(const Ray& ray) {
    if (const std::optional<Hand> held = hand_.hand()) {
        pin(*held, hand_.radius());
        return hand_.release();
    }
    if (!pins_.takeOut(ray, pinReach_)) pinned_ = ray;
}

void Tools::pin(const Hand& hand, float radius) {
    if (!pins_.add(hand, radius)) note_ = "there are no more than " + std::to_string(Pins::most) + " pins";
}

const char* Tools::name() const {
    return hand_.isHolding() ? " - holding"
           : isPinArmed_     ? " - pin"
           : blade_.isOn()   ? " - blade"
           : poke_.isOn()    ? " - poke"
                             : "";
}

std::optional<Question> Tools::question() const {
    if (hand_.question()) return Question{Question::Asker::hand, *hand_.question()};
    if (poke_.question()) return Question{Question::Asker::poke, *poke_.question()};
    if (pinned_) return Question{Question::Asker::pin, *pinned_};
    return std::nullopt;
}

void Tools::answer(const Question& question, const std::optional<Pick>& pick, float radius) {
    if (question != this->question()) return;
    log_.answer({question.asker, pick, radius});
    if (question.asker == Question::Asker::hand) return hand_.answer(pick, radius);
    if (question.asker == Question::Asker::poke) return poke_.answer(pick);
    pinned_.reset();
    if (pick)
        pin({pick->particle, pick->offset, pick->point}, radius);
    else
        note_ = "there is nothing to pin under the pointer";
}

void Tools::press(const Camera& camera, bool isDown, const Vector2& at) {
    if (isDown && std::exchange(isPinArmed_, false)) {
        act(Action::pin);
        return;
    }
    log_.press(isDown, at);
    if (blade_.isOn()) {
        if (isDown) return blade_.press(camera, at);
        blade_.move(camera, at);
        return blade_.release();
    }
    if (poke_.isOn()) return isDown ? poke_.press(camera, at) : poke_.release();
    if (isDown)
        hand_.press(camera, at);
    else
        hand_.release();
}

void Tools::pull(Stage& stage, float gravity) {
    gravity_ = gravity;
    log_.pull(gravity);
    stage.setGravity(gravity);
}

void Tools::turn(Stage& stage, const sim::Material& material) {
    stage.turnNow(material);
    turned(material);
}

void Tools::turned(const sim::Material& material) {
    material_ = material;
    log_.turn(material);
}

void Tools::shape(Stage& stage, const Shaped& shaped) {
    stage.wantShape(shaped.solver, shaped.substeps);
    log_.shape(shaped);
}

void Tools::forgetStates() {
    history_.clear();
    steps_.clear();
}

void Tools::goOn(const Tools& before, const Stage& stage) {
    hand_ = before.hand_;
    pins_ = before.pins_;
    blade_ = before.blade_;
    poke_ = before.poke_;
    pinned_ = before.pinned_;
    wantsPin_ = before.wantsPin_;
    isPinArmed_ = before.isPinArmed_;
    gravity_ = before.gravity_;
    log_ = before.log_;
    turned(stage.material());
    log_.shape({stage.settings().solver, stage.settings().substeps});
    if (before.history_.undos() + before.history_.redos() > 0)
        note_ = "another simulation goes on: earlier cuts can no longer be undone";
}

void Tools::resize(float radius) {
    poke_.setRadius(radius);
    log_.size(poke_.radius());
}

// One tool is out at a time.
void Tools::takeBlade() {
    if (!canCut_) return say("note: no body of this scene can be cut: cuttable = true makes it so");
    if (poke_.isOn()) poke_.toggle();
    blade_.toggle();
}

void Tools::takePoke() {
    if (blade_.isOn()) blade_.toggle();
    poke_.toggle();
    if (poke_.isOn()) log_.size(poke_.radius());
}

bool Tools::act(Action action) {
    switch (action) {
    case Action::blade:
        hand_.release();
        takeBlade();
        break;
    case Action::poke:
        hand_.release();
        takePoke();
        break;
    case Action::drop:
        drop();
        break;
    case Action::pin:
        wantsPin_ = true;
        break;
    case Action::undo:
        wantsUndo_ = true;
        break;
    case Action::redo:
        wantsRedo_ = true;
        break;
    case Action::stepBack:
        ++stepsBack_;
        break;
    default:
        return false;
    }
    log_.key(action);
    return true;
}

void Tools::say(const std::string& note) {
    std::fprintf(stderr, "%s\n", note.c_str());
    note_ = note;
}

void Tools::drop() {
    isPinArmed_ = false;
    hand_.release();
    blade_.drop();
    poke_.release();
}

void Tools::clear() {
    drop();
    pins_.clear();
    pinned_.reset();
}

void Tools::reset() {
    clear();
    history_.recycle();
    steps_.recycle();
    wantsUndo_ = wantsRedo_ = false;
    stepsBack_ = 0;
    log_.restart();
    if (blade_.isOn()) log_.key(Action::blade);
    if (poke_.isOn()) {
        log_.size(poke_.radius());
        log_.key(Action::poke);
    }
    if (gravity_) log_.pull(*gravity_);
    log_.turn(material_);
}

void Tools::putAway(Stage& stage) {
    if (blade_.isOn()) blade_.toggle();
    poke_.putAway();
    gravity_.reset();
    stage.setGravity(stage.scene().gravity);
    if (material_ != sim::Material{}) stage.turnNow({});
    material_ = {};
    const sim::Settings &now = stage.settings(), &first = stage.madeWith();
    if (now.solver != first.solver || now.substeps != first.substeps)
        stage.wantShape(first.solver, first.substeps);
}

void Tools::forget() {
    log_.forget();
    history_.recycle();
    steps_.recycle();
}

// What hands hold stays behind, as after an undo. A cut that has not been yet cannot be undone.
bool Tools::goBack(VkCommandBuffer commands, Stage& stage) {
    const std::uint32_t wanted = std::exchange(stepsBack_, 0);
    if (steps_.undos() == 0) {
        note_ = "there is no earlier step to go back to";
        return false;
    }
    log_.goBack();
    clear();
    for (std::uint32_t step = 0; step < wanted && steps_.recordBack(commands, stage); ++step) {
    }
    history_.forgetFrom(stage.played());
    return true;
}

bool Tools::recordHistory(VkCommandBuffer commands, Stage& stage) {
    if (stepsBack_ > 0) return goBack(commands, stage);
    const bool isUndo = std::exchange(wantsUndo_, false), isRedo = std::exchange(wantsRedo_, false);
    if (!isUndo && !isRedo) return false;
    if ((isUndo ? history_.undos() : history_.redos()) == 0) return false; // hands and pins stay
    log_.goBack();
    clear();
    steps_.recycle(); // they lead elsewhere
    return isUndo ? history_.recordUndo(commands, stage) : history_.recordRedo(commands, stage);
}

// Without memory for a way back there is a cut all the same.
void Tools::remember(VkCommandBuffer commands, const Stage& stage) {
    try {
        history_.recordBefore(commands, stage);
    } catch (const vk::Error& error) {
        if (!std::exchange(isForgetful_, true))
            say(std::string("warning: this cut cannot be undone: ") + error.what());
    }
}

// A state so large that few would have room is not copied in every step.
void Tools::rememberStep(VkCommandBuffer commands, const Stage& stage) {
    constexpr std::size_t worthIt = 8;
    if (isForgetfulOfSteps_ || steps_.room(stage) < worthIt) return;
    try {
        steps_.recordBefore(commands, stage);
    } catch (const vk::Error&) { // no memory: those that there are stay
        isForgetfulOfSteps_ = true;
    }
}

StepHands Tools::takeStep(VkCommandBuffer commands, const Stage& stage) {
    log_.step();
    rememberStep(commands, stage);
    if (blade_.beginsStroke()) remember(commands, stage);
    StepHands hands{.sweep = blade_.next(), .poke = poke_.poke()};
    hands.grabs[0] = hand_.isHolding() ? hand_.grabs()[0] : emptyHand();
    std::ranges::copy(pins_.grabs(), hands.grabs.begin() + 1);
    return hands;
}

void Tools::restart(std::span<const Sweep> undone, std::uint64_t steps) {
    if (history_.undos() + history_.redos() > 0)
        say("note: more room was made: earlier cuts can no longer be undone");
    log_.takeBack(steps);
    log_.forget();
    history_.clear(); // its states are of a simulation that is no more
    steps_.clear();
    blade_.putBack(undone);
}

} // namespace sinew::viewer
