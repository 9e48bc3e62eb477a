// States to go back to: one from before every cut, with its time, and what was undone; or one from before
// every step.
#pragma once

#include "viewer/draw/stage.hpp"
#include "vk/buffer.hpp"
#include "vk/queue.hpp"

#include <deque>

namespace sinew::viewer {

/// Of the simulation of one stage, which is given to every call, until bring(). Must not outlive its Device,
/// which must not move.
class History {
public:
    /// Of device memory, but one state always.
    static constexpr std::uint64_t mostBytes = 256u << 20;
    static constexpr std::size_t mostCuts = 32, mostSteps = 120;

    /// Of `mostStates` at most.
    History(const vk::Device& device, std::size_t mostStates) : device_(device), mostStates_(mostStates) {}

    /// How many states there is room for, one at least.
    std::size_t room(const Stage& stage) const { return room(stage.simulation()); }

    /// Records a copy of the state as it is, to come back to. What was undone is forgotten. Throws vk::Error
    /// where there is no memory for it. Keeps so many `more` than there is room for: the newest of them may
    /// be forgotten (forgetFrom) without loss of older ones.
    void recordBefore(VkCommandBuffer commands, const Stage& stage, std::size_t more = 0);
    /// Records the way back to the newest of those states, or forwards again; false where there is none.
    bool recordUndo(VkCommandBuffer commands, Stage& stage);
    bool recordRedo(VkCommandBuffer commands, Stage& stage);
    /// The same way back for good: the state as it is cannot be gone forwards to.
    bool recordBack(VkCommandBuffer commands, Stage& stage);
    /// Forgets those to go back to that are not before `played`, or so many of them.
    void forgetFrom(std::uint64_t played, std::size_t most = mostSteps);
    /// Instead of its own, the states of `other`, which may be this: those of `from` become states of `to`,
    /// as Simulation::recordTakeOver makes them. Where there is less room for them, the oldest are forgotten;
    /// while it lasts both are there. Waits. Throws vk::Error, and its own are then as they were.
    void bring(const History& other, const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
               vk::Queue& taking);

    /// Forgets the oldest to go back to, but for so many.
    void limit(std::size_t states);

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
    struct Ferry;
    State record(VkCommandBuffer commands, const sim::Simulation& simulation, std::uint64_t played);
    std::size_t room(const sim::Simulation& simulation) const;
    void load(VkCommandBuffer commands, Stage& stage, States& from);
    bool recordSwap(VkCommandBuffer commands, Stage& stage, States& from, States& to);

    const vk::Device& device_;
    std::size_t mostStates_;
    States before_, after_;
    std::vector<vk::Buffer> spare_; // the device may still read them: commands that follow wait for that
};

} // namespace sinew::viewer
