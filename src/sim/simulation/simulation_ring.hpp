// Results of the newest steps for the host to read: a ring with one slot for each step that may be in flight.
#pragma once

#include "common/layout.h"
#include "events/events.h"
#include "sinew/scene.hpp"
#include "sinew/vk/buffer.hpp"
#include "sinew/vk/commands.hpp"

#include <optional>
#include <vector>

namespace sinew::sim {

/// A recorded step in its slot.
struct RecordedStep {
    bool isRecorded = false;
    std::uint64_t frame = 0;
    float lostTime = 0; ///< [s]
    bool hasBlade = false;
    bool isCalm = false;          ///< Recording::isCalm
    bool repeats = false;         ///< Step::repeats
    bool isRead = false;          ///< the host has evaluated its status
    std::uint32_t generation = 0; ///< of steps: a new one begins when a state comes from elsewhere
};

/// Numbers of results of a step beside its status.
struct ResultSizes {
    bool hasCounts = false; ///< of cuts
    std::size_t forces = 0; ///< sums
    std::size_t events = 0; ///< entries of the list, its head included
};

/// Results of a step on the device; views of those that the ring does not hold are empty.
struct ResultViews {
    vk::BufferView status, counts, forces, events;
};

class StepRing {
public:
    /// Makes a ring for `slots` steps.
    StepRing(const vk::Device& device, std::uint32_t slots, const ResultSizes& sizes);

    std::uint32_t slots() const noexcept { return static_cast<std::uint32_t>(steps_.size()); }
    std::uint32_t slotOf(std::uint64_t frame) const noexcept {
        return static_cast<std::uint32_t>(frame % steps_.size());
    }
    /// The step in the slot of `frame`; another step if `frame` was not recorded or is too old.
    const RecordedStep& step(std::uint64_t frame) const noexcept { return steps_[slotOf(frame)]; }
    /// Gives the slot of `step` to it; the step then counts as unfinished. Never allocates.
    void open(const RecordedStep& step) noexcept;
    /// Records the copies of results into the slot of `frame`.
    void record(vk::Commands& commands, std::uint64_t frame, const ResultViews& views) const noexcept;
    /// Records the copy that marks `frame` as finished. The caller puts a barrier between the two that makes
    /// the copies of record() visible to the host (vk::Commands::endStepForHost).
    void recordEnd(vk::Commands& commands, std::uint64_t frame, const vk::BufferView& status) const noexcept;

    /// Status words and counts of the step in the slot of `frame`.
    layout::StatusWords words(std::uint64_t frame) const noexcept;
    layout::CutCounts counts(std::uint64_t frame) const noexcept;
    /// Sums of forces of that step; empty if none are kept.
    std::vector<layout::ForceSum> forces(std::uint64_t frame) const;
    /// Entries of the list of events of that step, and the number of those that had no room.
    struct Listed {
        std::vector<layout::EventEntry> entries;
        std::uint32_t lost = 0;
    };
    Listed events(std::uint64_t frame) const;
    /// Whether `frame` was recorded, still has its slot and has finished on the device.
    bool isFinished(std::uint64_t frame) const noexcept;
    /// The step of `frame`, for its reader to mark.
    RecordedStep& step(std::uint64_t frame) noexcept { return steps_[slotOf(frame)]; }
    /// Whether that step has finished and was undone.
    bool isUndone(std::uint64_t frame) const noexcept;
    /// Number of undone steps up to `frame`, once that has finished.
    std::uint64_t undoneUntil(std::uint64_t frame) const noexcept;
    /// The oldest recorded step that has not finished.
    std::optional<std::uint64_t> oldestUnfinished() const noexcept;
    /// The oldest undone step of `generation` in a slot that lacked room, and the room that it needs. Steps
    /// from `end` on do not count: they follow the state of a step that lacked lists.
    struct Lack {
        std::uint64_t frame = 0;
        std::uint32_t needed = 0;
    };
    std::optional<Lack> lackOfRoom(std::uint32_t generation, std::uint64_t end) const noexcept;

private:
    static vk::BufferView slotIn(const vk::Buffer& ring, std::uint32_t slot, std::size_t size) noexcept;

    vk::Buffer status_, ends_; // slots are whole atoms, since host and device write side by side
    std::optional<vk::Buffer> counts_, forces_, events_; // in whole atoms too
    ResultSizes sizes_;
    std::vector<RecordedStep> steps_;
    std::uint64_t undone_ = 0; // undone steps whose slots were reused
};

} // namespace sinew::sim
