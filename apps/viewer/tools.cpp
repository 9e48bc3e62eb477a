// One pointer, two tools: the left button belongs to the one that is out.
#include "viewer/tools.hpp"

#include "viewer/controller.hpp"
#include "viewer/opening.hpp"
#include "vk/check.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace sinew::viewer {

Tools::Tools(const vk::Device& device, const Opening& opening)
    : blade_(opening.light.bounds), history_(device), pinReach_(0.04f * opening.light.radius()),
      canCut_(std::ranges::any_of(opening.loaded.scene.grids, &sim::Grid::isCuttable)) {}

void Tools::handle(const Input& input, Controller& controller) {
    for (const Input::Press& one : input.presses)
        if (one.action == Action::grab) press(one, controller.camera);
    for (const Input::Drag& drag : input.drags) {
        if (drag.action != Action::grab)
            controller.drag(drag.action, drag.heights);
        else if (const Vector2 turn = hand_.drag(drag.heights); !blade_.isOn() && !turn.isZero())
            controller.drag(Action::orbit, turn);
    }
    hand_.move(controller.camera, input.pointer);
    blade_.move(controller.camera, input.pointer);
    if (std::exchange(wantsPin_, false)) pinAt(rayThrough(controller.camera, input.pointer));
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
    return hand_.isHolding() ? " - holding" : isPinArmed_ ? " - pin" : blade_.isOn() ? " - blade" : "";
}

std::optional<Question> Tools::question() const {
    if (hand_.question()) return Question{Question::Asker::hand, *hand_.question()};
    if (pinned_) return Question{Question::Asker::pin, *pinned_};
    return std::nullopt;
}

void Tools::answer(const Question& question, const std::optional<Pick>& pick, float radius) {
    if (question != this->question()) return;
    if (question.asker == Question::Asker::hand) return hand_.answer(pick, radius);
    pinned_.reset();
    if (pick)
        pin({pick->particle, pick->offset, pick->point}, radius);
    else
        note_ = "there is nothing to pin under the pointer";
}

void Tools::press(const Input::Press& press, const Camera& camera) {
    if (press.isDown && std::exchange(isPinArmed_, false)) {
        wantsPin_ = true;
        return;
    }
    if (blade_.isOn()) {
        if (press.isDown) return blade_.press(camera, press.pointer);
        blade_.move(camera, press.pointer);
        return blade_.release();
    }
    if (press.isDown)
        hand_.press(camera, press.pointer);
    else
        hand_.release();
}

bool Tools::act(Action action) {
    switch (action) {
    case Action::blade:
        hand_.release();
        if (canCut_)
            blade_.toggle();
        else
            say("note: no body of this scene can be cut: cuttable = true makes it so");
        return true;
    case Action::drop:
        drop();
        return true;
    case Action::pin:
        return wantsPin_ = true;
    case Action::undo:
        return wantsUndo_ = true;
    case Action::redo:
        return wantsRedo_ = true;
    default:
        return false;
    }
}

void Tools::say(const std::string& note) {
    std::fprintf(stderr, "%s\n", note.c_str());
    note_ = note;
}

void Tools::drop() {
    isPinArmed_ = false;
    hand_.release();
    blade_.drop();
}

void Tools::clear() {
    drop();
    pins_.clear();
    pinned_.reset();
}

bool Tools::recordHistory(VkCommandBuffer commands, Stage& stage) {
    const bool isUndo = std::exchange(wantsUndo_, false), isRedo = std::exchange(wantsRedo_, false);
    if (!isUndo && !isRedo) return false;
    clear();
    return isUndo ? history_.recordUndo(commands, stage) : history_.recordRedo(commands, stage);
}

// Without memory for a way back there is a cut all the same.
void Tools::remember(VkCommandBuffer commands, Stage& stage) {
    try {
        history_.recordBefore(commands, stage);
    } catch (const vk::Error& error) {
        if (!std::exchange(isForgetful_, true))
            say(std::string("warning: this cut cannot be undone: ") + error.what());
    }
}

void Tools::recordStep(VkCommandBuffer commands, Stage& stage, vk::Timestamps* timestamps,
                       std::vector<Sweep>& sweeps) {
    if (blade_.beginsStroke()) remember(commands, stage);
    const std::optional<Sweep> sweep = blade_.next();
    sim::Blade blade;
    if (sweep) {
        sweeps.push_back(*sweep);
        blade = {.from = sweep->from, .to = sweep->to, .isCarried = sweep->isCarried};
    }
    grabs_[0] = hand_.isHolding() ? hand_.grabs()[0] : emptyHand();
    std::ranges::copy(pins_.grabs(), grabs_.begin() + 1);
    stage.recordStep(commands, timestamps, grabs_, blade);
}

void Tools::restart(std::span<const Sweep> undone) {
    if (history_.undos() + history_.redos() > 0)
        say("note: more room was made: earlier cuts can no longer be undone");
    history_.clear(); // its states are of a simulation that is no more
    blade_.putBack(undone);
}

} // namespace sinew::viewer
