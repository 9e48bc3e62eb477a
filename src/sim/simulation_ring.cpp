// A step has finished when the device has put its frame over what the host put there as it recorded it.
#include "sim/simulation_ring.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace sinew::sim {

namespace {

vk::Buffer ringOf(const vk::Device& device, const char* name, std::uint32_t slots, std::size_t size) {
    const VkDeviceSize atom = std::max<VkDeviceSize>(device.limits().nonCoherentAtom, 4);
    vk::Buffer ring(device, {.name = name,
                             .count = slots,
                             .stride = static_cast<std::uint32_t>((size + atom - 1) / atom * atom),
                             .kind = vk::MemoryKind::readback});
    std::memset(ring.mapped(), 0, ring.view().size);
    ring.flush();
    return ring;
}

template <typename Words> Words read(const vk::Buffer& ring, std::uint32_t slot) noexcept {
    const std::size_t offset = std::size_t{slot} * ring.stride();
    ring.invalidate(offset, ring.stride());
    Words words;
    std::memcpy(&words, ring.mapped() + offset, sizeof(words));
    return words;
}

} // namespace

StepRing::StepRing(const vk::Device& device, std::uint32_t slots, bool hasCounts)
    : status_(ringOf(device, "status.ring", slots, sizeof(layout::StatusWords))), steps_(slots) {
    if (hasCounts) counts_.emplace(ringOf(device, "cut.counts.ring", slots, sizeof(layout::CutCounts)));
}

void StepRing::open(const RecordedStep& step) noexcept {
    const std::uint32_t slot = slotOf(step.frame);
    if (steps_[slot].isRecorded && isUndone(steps_[slot].frame)) ++undone_;
    const std::uint32_t unfinished = ~static_cast<std::uint32_t>(step.frame);
    const std::size_t offset = std::size_t{slot} * status_.stride();
    std::memcpy(status_.mapped() + offset + offsetof(layout::StatusWords, frame), &unfinished,
                sizeof(unfinished));
    status_.flush(offset, status_.stride());
    steps_[slot] = step;
}

vk::BufferView StepRing::slotIn(const vk::Buffer& ring, std::uint64_t frame,
                                std::size_t size) const noexcept {
    vk::BufferView slot = ring.view();
    slot.offset += VkDeviceSize{slot.stride} * slotOf(frame);
    slot.size = size;
    return slot;
}

void StepRing::record(vk::Commands& commands, std::uint64_t frame, const vk::BufferView& status,
                      const vk::BufferView& counts) const noexcept {
    commands.copy(status, slotIn(status_, frame, status.size));
    if (counts_) commands.copy(counts, slotIn(*counts_, frame, counts.size));
}

layout::StatusWords StepRing::words(std::uint64_t frame) const noexcept {
    return read<layout::StatusWords>(status_, slotOf(frame));
}

layout::CutCounts StepRing::counts(std::uint64_t frame) const noexcept {
    return counts_ ? read<layout::CutCounts>(*counts_, slotOf(frame)) : layout::CutCounts{};
}

bool StepRing::isFinished(std::uint64_t frame) const noexcept {
    const RecordedStep& recorded = step(frame);
    return recorded.isRecorded && recorded.frame == frame &&
           words(frame).frame == static_cast<std::uint32_t>(frame);
}

bool StepRing::isUndone(std::uint64_t frame) const noexcept {
    if (!isFinished(frame)) return false;
    const layout::StatusWords found = words(frame);
    return found.nonFinite > 0 || found.candidates > 0;
}

std::uint64_t StepRing::undoneUntil(std::uint64_t frame) const noexcept {
    std::uint64_t undone = undone_;
    for (const RecordedStep& one : steps_)
        if (one.isRecorded && one.frame <= frame && isUndone(one.frame)) ++undone;
    return undone;
}

std::optional<std::uint64_t> StepRing::oldestUnfinished() const noexcept {
    std::optional<std::uint64_t> oldest;
    for (const RecordedStep& one : steps_)
        if (one.isRecorded && !isFinished(one.frame) && (!oldest || one.frame < *oldest)) oldest = one.frame;
    return oldest;
}

std::optional<StepRing::Lack> StepRing::lackOfRoom() const noexcept {
    std::optional<Lack> oldest;
    for (const RecordedStep& one : steps_) {
        if (!one.isRecorded || !isFinished(one.frame)) continue;
        const std::uint32_t needed = words(one.frame).candidates;
        if (needed > 0 && (!oldest || one.frame < oldest->frame)) oldest = Lack{one.frame, needed};
    }
    return oldest;
}

} // namespace sinew::sim
