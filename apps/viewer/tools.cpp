// Three tools for one pointer: the left button belongs to the active one.
#include "viewer/tools.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/vk/check.hpp"
#include "viewer/hands/controller.hpp"
#include "viewer/opened_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr const char* lost = "warning: earlier cuts can no longer be undone: their states could not be moved";

} // namespace

Tools::Tools(const vk::Device& device, const OpenedScene& opening)
    : blade_(opening.light.bounds), poke_(opening.light.radius(), opening.loaded.scene.planes),
      history_(device, History::mostCuts), steps_(device, History::mostSteps), holds_(opening.loaded.holds),
      pinReach_(0.04f * opening.light.radius()),
      canCut_(std::ranges::any_of(opening.loaded.scene.grids, &sim::Grid::isCuttable)) {
    setDepth(opening.bladeDepth);
    for (const float inverseMass : sim::inverseMasses(opening.loaded.scene))
        isFixed_.push_back(inverseMass == 0);
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
    if (input.growth != 0) turnWheel(input.growth);
    move(controller.camera, input.pointer);
}

void Tools::turnWheel(float notches) {
    if (poke_.isOn()) {
        poke_.grow(notches);
        log_.size(poke_.radius());
    }
    if (!blade_.isOn()) return;
    blade_.deepen(notches);
    log_.deepen(blade_.depth());
    note_ = "the blade goes " + depthText(blade_.depth());
}

void Tools::move(const Camera& camera, const Vector2& pointer) {
    if (hand_.isHolding() || blade_.isOn() || poke_.isDown() || wantsPin_) log_.point(pointer);
    hand_.move(camera, pointer);
    blade_.move(camera, pointer);
    poke_.move(camera, pointer);
    if (std::exchange(wantsPin_, false)) pinAt(rayThrough(camera, pointer));
}

// Pins the held point, or asks for the point under the pointer.
void Tools::pinAt(const Ray& ray) {
    if (const std::optional<Hand> held = hand_.hand()) {
        pin(*held, hand_.radius());
        return hand_.release();
    }
    if (!pins_.takeOut(ray, pinReach_)) pinned_ = ray;
}

void Tools::pin(const Hand& hand, float radius) {
    if (!pins_.add(hand, radius)) note_ = "at most " + std::to_string(Pins::most) + " pins are possible";
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
    if (blade_.question()) return Question{Question::Asker::blade, *blade_.question()};
    if (blade_.preview()) return Question{Question::Asker::preview, *blade_.preview()};
    return std::nullopt;
}

void Tools::answer(const Question& question, const std::optional<Pick>& pick, float radius) {
    if (question != this->question()) return;
    if (question.asker == Question::Asker::preview) return blade_.answerPreview(pick);
    log_.answer({question.asker, pick, radius});
    if (question.asker == Question::Asker::blade) return blade_.answer(pick);
    if (question.asker == Question::Asker::hand) return hand_.answer(pick, radius);
    if (question.asker == Question::Asker::poke) return poke_.answer(pick);
    pinned_.reset();
    if (pick && isFixed_[pick->particle])
        sayHeld(pick->particle);
    else if (pick)
        pin({pick->particle, pick->offset, pick->point}, radius);
    else
        note_ = "no body to pin under the pointer";
}

void Tools::sayHeld(std::uint32_t particle) {
    const sim::NamedHold* hold = sim::holdOf(holds_, particle);
    note_ = (hold != nullptr ? "hold \"" + hold->name + "\" of the scene holds this"
                             : std::string("the scene holds this")) +
            ": it needs no pin, and N does not release it";
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

void Tools::pull(Document& document, float gravity) {
    gravity_ = gravity;
    log_.pull(gravity);
    document.setGravity(gravity);
}

void Tools::turn(Document& document, const sim::Material& material) {
    document.turnNow(material);
    turned(material);
}

void Tools::turned(const sim::Material& material) {
    material_ = material;
    log_.turn(material);
}

void Tools::shape(Document& document, const Shaped& shaped) {
    document.wantShape(shaped.solver, shaped.substeps);
    log_.shape(shaped);
}

void Tools::begin(const Document& document) {
    material_ = document.material();
    log_.begin(material_);
}

void Tools::reshaped() {
    steps_.clear();
    if (std::exchange(isLost_, false)) say(lost);
}

app::Bring Tools::bringOf(const Tools& before) {
    return [this, &before](const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
                           vk::Queue& taking) {
        try {
            history_.bring(before.history_, from, giving, to, taking);
        } catch (const vk::Error&) {
            history_.clear();
            isLost_ = true;
        } catch (const std::invalid_argument&) { // cut states, and a solver without cutting
            history_.clear();
            isLost_ = true;
        }
    };
}

void Tools::goOn(const Tools& before, const Document& document) {
    hand_ = before.hand_;
    pins_ = before.pins_;
    blade_ = before.blade_;
    poke_ = before.poke_;
    pinned_ = before.pinned_;
    wantsPin_ = before.wantsPin_;
    isPinArmed_ = before.isPinArmed_;
    isLent_ = before.isLent_;
    wasPokeOn_ = before.wasPokeOn_;
    gravity_ = before.gravity_;
    wantsUndo_ = before.wantsUndo_;
    wantsRedo_ = before.wantsRedo_;
    stepsBack_ = before.stepsBack_;
    log_ = before.log_;
    turned(document.material());
    log_.shape({document.settings().solver, document.settings().substeps});
    const bool isLost = isLost_;
    reshaped();
    if (isLost) log_.forget();
}

void Tools::resize(float radius) {
    poke_.setRadius(radius);
    log_.size(poke_.radius());
}

void Tools::setDepth(const std::optional<float>& depth) {
    blade_.setDepth(depth);
    log_.deepen(blade_.depth());
}

// Turns the blade on or off; one tool is active at a time.
void Tools::takeBlade() {
    if (!canCut_) return say("note: no body of this scene can be cut: cuttable = true allows it");
    if (poke_.isOn()) poke_.toggle();
    blade_.toggle();
}

bool Tools::lendBlade(bool isHeld, bool isUsed) {
    isLent_ = isLent_ && blade_.isOn(); // or the user put it away
    if (isHeld == isLent_) return false;
    if (isHeld) {
        if (!isUsed || !canCut_ || blade_.isOn() || poke_.isDown() || hand_.isDown()) return false;
        wasPokeOn_ = poke_.isOn();
    } else if (blade_.isDown()) {
        return false;
    }
    isLent_ = isHeld;
    act(Action::blade);
    if (!isHeld && std::exchange(wasPokeOn_, false)) act(Action::poke);
    return true;
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
    log_.deepen(blade_.depth());
    if (blade_.isOn()) log_.key(Action::blade);
    if (poke_.isOn()) {
        log_.size(poke_.radius());
        log_.key(Action::poke);
    }
    if (gravity_) log_.pull(*gravity_);
    log_.turn(material_);
}

void Tools::putAway(Document& document) {
    if (blade_.isOn()) blade_.toggle();
    blade_.drop();
    blade_.setDepth(std::nullopt);
    poke_.putAway();
    gravity_.reset();
    document.setGravity(document.scene().gravity);
    if (material_ != sim::Material{}) document.turnNow({});
    material_ = {};
    const sim::Settings &now = document.settings(), &first = document.madeWith();
    if (now.solver != first.solver || now.substeps != first.substeps)
        document.wantShape(first.solver, first.substeps);
    else
        document.keepShape();
}

void Tools::forget() {
    log_.forget();
    history_.recycle();
    steps_.recycle();
}

void Tools::forgetSteps() {
    log_.forget({.areOfSteps = true});
    steps_.recycle();
}

} // namespace sinew::viewer
