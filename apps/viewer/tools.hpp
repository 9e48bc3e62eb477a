// What the pointer holds, the hand or the blade, and what of their work can be undone.
#pragma once

#include "viewer/cut_tool.hpp"
#include "viewer/grab_tool.hpp"
#include "viewer/history.hpp"
#include "viewer/stage.hpp"
#include "viewer/window.hpp"

#include <utility>

namespace sinew::viewer {

class Controller;
struct Opening;

/// Must not outlive its Device, which must not move.
class Tools {
public:
    Tools(const vk::Device& device, const Opening& opening);

    /// Presses and moves. Drags that no tool wants turn the camera.
    void handle(const Input& input, Controller& controller);
    /// False for an action that is none of theirs.
    bool act(Action action);
    /// Lets go of everything: what was held or to be cut is where nobody expects it.
    void drop();

    /// Whether something is to be recorded even where no step is.
    bool isWaiting() const { return hand_.question() || wantsUndo_ || wantsRedo_; }
    /// The way back or forwards, where it was asked for; whether there was one.
    bool recordHistory(VkCommandBuffer commands, Stage& stage);
    /// A step with what the tools do in it; what the blade cut is added to `sweeps`.
    void recordStep(VkCommandBuffer commands, Stage& stage, vk::Timestamps* timestamps,
                    std::vector<Sweep>& sweeps);
    /// After the stage has another simulation. `undone`, in their order, are cut again.
    void restart(std::span<const Sweep> undone);

    GrabTool& hand() { return hand_; }
    bool isHolding() const { return hand_.isHolding(); }
    bool isBladeOn() const { return blade_.isOn(); }
    const History& history() const { return history_; }
    Overlay overlay() const { return {hand_.hand(), blade_.path()}; }
    /// What they said last, once: also a line on stderr.
    std::string takeNote() { return std::exchange(note_, {}); }
    /// For the title: " - holding".
    const char* name() const { return hand_.isHolding() ? " - holding" : blade_.isOn() ? " - blade" : ""; }

private:
    void press(const Input::Press& press, const Camera& camera);
    void say(const std::string& note);

    GrabTool hand_;
    CutTool blade_;
    History history_;
    std::string note_;
    void remember(VkCommandBuffer commands, Stage& stage);

    bool canCut_ = false, isForgetful_ = false, wantsUndo_ = false, wantsRedo_ = false;
};

} // namespace sinew::viewer
