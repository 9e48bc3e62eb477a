// Results of the newest steps for the host to read: one slot for each step that may be in flight.
#pragma once

#include "layout.h"
#include "sim/scene.hpp"
#include "vk/buffer.hpp"
#include "vk/commands.hpp"

#include <optional>
#include <vector>

namespace sinew::sim {

/// A step in its slot, as the host recorded it.
struct RecordedStep {
    bool isRecorded = false;
    std::uint64_t frame = 0;
    float lostTime = 0; ///< [s]
    bool hasBlade = false;
    bool isCalm = false;          ///< Recording::isCalm
    bool repeats = false;         ///< Step::repeats
    bool isRead = false;          ///< its status was taken into account
    std::uint32_t generation = 0; ///< of steps: the next one begins where a state comes from elsewhere
};

class StepRing {
public:
    /// Makes a ring for `slots` steps. With `hasCounts` it also keeps the counts of cuts, and so many sums of
    /// forces.
    StepRing(const vk::Device& device, std::uint32_t slots, bool hasCounts, std::size_t forces);

    std::uint32_t slots() const noexcept { return static_cast<std::uint32_t>(steps_.size()); }
    std::uint32_t slotOf(std::uint64_t frame) const noexcept {
        return static_cast<std::uint32_t>(frame % steps_.size());
    }
    /// The step that has the slot of `frame`: another one, where that was not recorded or is too old.
    const RecordedStep& step(std::uint64_t frame) const noexcept { return steps_[slotOf(frame)]; }
    /// Gives the slot of a step, which then has not finished, to `step`. Never allocates.
    void open(const RecordedStep& step) noexcept;
    /// Records the copies into the slot of `frame`.
    void record(vk::Commands& commands, std::uint64_t frame, const vk::BufferView& status,
                const vk::BufferView& counts, const vk::BufferView& forces) const noexcept;
    /// Records the copy after which `frame` has finished. Between the two stands a barrier that makes the
    /// copies of record() visible to the host (vk::Commands::endStepForHost).
    void recordEnd(vk::Commands& commands, std::uint64_t frame, const vk::BufferView& status) const noexcept;

    /// Words and counts of the step that has the slot of `frame`.
    layout::StatusWords words(std::uint64_t frame) const noexcept;
    layout::CutCounts counts(std::uint64_t frame) const noexcept;
    /// Sums of forces of that step; empty without.
    std::vector<layout::ForceSum> forces(std::uint64_t frame) const;
    /// Whether `frame` was recorded, has its slot still and came back from the device.
    bool isFinished(std::uint64_t frame) const noexcept;
    /// That step, for its reader to mark.
    RecordedStep& step(std::uint64_t frame) noexcept { return steps_[slotOf(frame)]; }
    /// True where that step has finished and was undone.
    bool isUndone(std::uint64_t frame) const noexcept;
    /// Steps that were undone until `frame` came back.
    std::uint64_t undoneUntil(std::uint64_t frame) const noexcept;
    /// The oldest step that was recorded and has not come back.
    std::optional<std::uint64_t> oldestUnfinished() const noexcept;
    /// The oldest step of `generation` in a slot that was undone for lack of room, and how many particles
    /// need it. Steps from `end` on do not count: they go on from the state of a step that lacked lists.
    struct Lack {
        std::uint64_t frame = 0;
        std::uint32_t needed = 0;
    };
    std::optional<Lack> lackOfRoom(std::uint32_t generation, std::uint64_t end) const noexcept;

private:
    static vk::BufferView slotIn(const vk::Buffer& ring, std::uint32_t slot, std::size_t size) noexcept;

    vk::Buffer status_, ends_; // slots are whole atoms: host and device write beside each other
    std::optional<vk::Buffer> counts_, forces_; // likewise
    std::size_t forceCount_ = 0;
    std::vector<RecordedStep> steps_;
    std::uint64_t undone_ = 0; // of steps that have a slot no longer
};

} // namespace sinew::sim
