// States to go back to: one from before every cut, with its time, and what was undone; or one from before
// every step.
#pragma once

#include "viewer/draw/stage.hpp"
#include "vk/buffer.hpp"

#include <deque>

namespace sinew::viewer {

/// Of the simulation of one stage, which is given to every call. Must not outlive its Device, which must not
/// move.
class History {
public:
    static constexpr std::uint64_t mostBytes = 256u << 20; ///< of device memory, but one state always
    static constexpr std::size_t mostCuts = 32, mostSteps = 120;

    /// Of `mostStates` at most.
    History(const vk::Device& device, std::size_t mostStates) : device_(device), mostStates_(mostStates) {}

    /// How many states there is room for, one at least.
    std::size_t room(const Stage& stage) const;

    /// Records a copy of the state as it is, to come back to. What was undone is forgotten. Throws vk::Error
    /// where there is no memory for it.
    void recordBefore(VkCommandBuffer commands, const Stage& stage);
    /// Records the way back to the newest of those states, or forwards again; false where there is none.
    bool recordUndo(VkCommandBuffer commands, Stage& stage);
    bool recordRedo(VkCommandBuffer commands, Stage& stage);
    /// The same way back for good: the state as it is cannot be gone forwards to.
    bool recordBack(VkCommandBuffer commands, Stage& stage);
    /// Forgets those to go back to that are not before `played`.
    void forgetFrom(std::uint64_t played);

    std::size_t undos() const { return before_.size(); }
    std::size_t redos() const { return after_.size(); }
    /// When the states are of, as Stage::played(): those to go back to from the oldest on, then those to go
    /// forwards to from the nearest on.
    std::vector<std::uint64_t> times() const;
    /// Forgets all; the buffers serve again.
    void recycle();
    /// Frees them, too. Nothing of it may be in use on the device.
    void clear();

private:
    struct State {
        vk::Buffer buffer;
        sim::SavedState host;
        std::uint64_t played = 0; ///< Stage::played()
    };
    using States = std::deque<State>;
    State record(VkCommandBuffer commands, const Stage& stage);
    void load(VkCommandBuffer commands, Stage& stage, States& from);
    bool recordSwap(VkCommandBuffer commands, Stage& stage, States& from, States& to);

    const vk::Device& device_;
    std::size_t mostStates_;
    States before_, after_;
    std::vector<vk::Buffer> spare_; // the device may still read them: commands that follow wait for that
};

} // namespace sinew::viewer
