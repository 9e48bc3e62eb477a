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
    : blade_(opening.light.bounds), history_(device),
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
}

void Tools::press(const Input::Press& press, const Camera& camera) {
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
    hand_.release();
    blade_.drop();
}

bool Tools::recordHistory(VkCommandBuffer commands, Stage& stage) {
    const bool isUndo = std::exchange(wantsUndo_, false), isRedo = std::exchange(wantsRedo_, false);
    if (!isUndo && !isRedo) return false;
    drop();
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
    stage.recordStep(commands, timestamps, hand_.grabs(), blade);
}

void Tools::restart(std::span<const Sweep> undone) {
    if (history_.undos() + history_.redos() > 0)
        say("note: more room was made: earlier cuts can no longer be undone");
    history_.clear(); // its states are of a simulation that is no more
    blade_.putBack(undone);
}

} // namespace sinew::viewer
