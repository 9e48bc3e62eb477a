// Saved states for undo and redo: one from before every cut, with its time; or one from before every step.
#pragma once

#include "sinew/vk/buffer.hpp"
#include "sinew/vk/queue.hpp"
#include "viewer/document/document.hpp"

#include <deque>

namespace sinew::viewer {

/// Holds states of the simulation of one document, which is passed to every call, until bring(). Must not
/// outlive its Device, which must not move.
class History {
public:
    /// Limit of device memory; one state is always kept.
    static constexpr std::uint64_t mostBytes = 256u << 20;
    static constexpr std::size_t mostCuts = 32, mostSteps = 120;

    /// Keeps at most `mostStates`.
    History(const vk::Device& device, std::size_t mostStates) : device_(device), mostStates_(mostStates) {}

    /// Number of states that fit, at least one.
    std::size_t room(const Document& document) const { return room(document.simulation()); }

    /// Records a copy of the present state, to return to, and drops the states to redo. Keeps `more` states
    /// than fit: the newest of them may be dropped (forgetFrom) without loss of older ones. Throws vk::Error
    /// if there is no memory.
    void recordBefore(VkCommandBuffer commands, const Document& document, std::size_t more = 0);
    /// Records the return to the newest saved state, or forwards again; false if there is none.
    bool recordUndo(VkCommandBuffer commands, Document& document);
    bool recordRedo(VkCommandBuffer commands, Document& document);
    /// Like recordUndo(), but the present state cannot be redone.
    bool recordBack(VkCommandBuffer commands, Document& document);
    /// Drops the newest states to undo whose time is not before `played`, at most `most`.
    void forgetFrom(std::uint64_t played, std::size_t most = mostSteps);
    /// Replaces its own states by those of `other`, which may be this: states of `from` become states of `to`
    /// (see Simulation::recordTakeOver). Drops the oldest if fewer fit; meanwhile both exist. Waits. Throws
    /// vk::Error; its own states are then unchanged.
    void bring(const History& other, const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
               vk::Queue& taking);

    /// Drops the oldest states to undo until `states` are left.
    void limit(std::size_t states);

    std::size_t undos() const { return before_.size(); }
    std::size_t redos() const { return after_.size(); }
    /// Times of the states (see Document::played()): those to undo, oldest first, then those to redo, nearest
    /// first.
    std::vector<std::uint64_t> times() const;
    /// Drops all states; keeps the buffers for reuse.
    void recycle();
    /// Frees the buffers too. The device must not use them.
    void clear();

private:
    struct State {
        vk::Buffer buffer;
        sim::SavedState host;
        std::uint64_t played = 0; ///< see Document::played()
    };
    using States = std::deque<State>;
    struct Ferry;
    State record(VkCommandBuffer commands, const sim::Simulation& simulation, std::uint64_t played);
    std::size_t room(const sim::Simulation& simulation) const;
    void load(VkCommandBuffer commands, Document& document, States& from);
    bool recordSwap(VkCommandBuffer commands, Document& document, States& from, States& to);

    const vk::Device& device_;
    std::size_t mostStates_;
    States before_, after_;
    std::vector<vk::Buffer> spare_; // the device may still read them; later commands wait for that
};

} // namespace sinew::viewer
