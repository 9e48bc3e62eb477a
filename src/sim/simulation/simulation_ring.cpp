// The device marks a step as finished by writing its frame number over the mark that the host set when it
// recorded the step. This copy is the last one, after a barrier: all results of the step are then visible to
// the host.
#include "sim/simulation/simulation_ring.hpp"

#include <algorithm>
#include <atomic>
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

StepRing::StepRing(const vk::Device& device, std::uint32_t slots, const ResultSizes& sizes)
    : status_(ringOf(device, "status.ring", slots, sizeof(layout::StatusWords))),
      ends_(ringOf(device, "status.ends", slots, sizeof(std::uint32_t))), sizes_(sizes), steps_(slots) {
    if (sizes.hasCounts) counts_.emplace(ringOf(device, "cut.counts.ring", slots, sizeof(layout::CutCounts)));
    if (sizes.forces > 0)
        forces_.emplace(ringOf(device, "forces.ring", slots, sizes.forces * sizeof(layout::ForceSum)));
    if (sizes.events > 0)
        events_.emplace(ringOf(device, "events.ring", slots, sizes.events * sizeof(layout::EventEntry)));
}

void StepRing::open(const RecordedStep& step) noexcept {
    const std::uint32_t slot = slotOf(step.frame);
    if (steps_[slot].isRecorded && isUndone(steps_[slot].frame)) ++undone_;
    const std::uint32_t unfinished = ~static_cast<std::uint32_t>(step.frame);
    const std::size_t offset = std::size_t{slot} * ends_.stride();
    std::memcpy(ends_.mapped() + offset, &unfinished, sizeof(unfinished));
    ends_.flush(offset, ends_.stride());
    steps_[slot] = step;
}

vk::BufferView StepRing::slotIn(const vk::Buffer& ring, std::uint32_t slot, std::size_t size) noexcept {
    vk::BufferView view = ring.view();
    view.offset += VkDeviceSize{view.stride} * slot;
    view.size = size;
    return view;
}

void StepRing::record(vk::Commands& commands, std::uint64_t frame, const ResultViews& views) const noexcept {
    const auto keep = [&](const vk::BufferView& view, const vk::Buffer& ring) {
        commands.copy(view, slotIn(ring, slotOf(frame), view.size));
    };
    keep(views.status, status_);
    if (counts_) keep(views.counts, *counts_);
    if (forces_) keep(views.forces, *forces_);
    if (events_) keep(views.events, *events_);
}

void StepRing::recordEnd(vk::Commands& commands, std::uint64_t frame,
                         const vk::BufferView& status) const noexcept {
    vk::BufferView word = status;
    word.offset += offsetof(layout::StatusWords, frame);
    word.size = sizeof(std::uint32_t);
    commands.copy(word, slotIn(ends_, slotOf(frame), word.size));
}

layout::StatusWords StepRing::words(std::uint64_t frame) const noexcept {
    return read<layout::StatusWords>(status_, slotOf(frame));
}

layout::CutCounts StepRing::counts(std::uint64_t frame) const noexcept {
    return counts_ ? read<layout::CutCounts>(*counts_, slotOf(frame)) : layout::CutCounts{};
}

std::vector<layout::ForceSum> StepRing::forces(std::uint64_t frame) const {
    std::vector<layout::ForceSum> sums(sizes_.forces);
    if (!forces_) return sums;
    const std::size_t offset = std::size_t{slotOf(frame)} * forces_->stride();
    forces_->invalidate(offset, forces_->stride());
    std::memcpy(sums.data(), forces_->mapped() + offset, sums.size() * sizeof(layout::ForceSum));
    return sums;
}

StepRing::Listed StepRing::events(std::uint64_t frame) const {
    if (!events_) return {};
    const std::size_t offset = std::size_t{slotOf(frame)} * events_->stride();
    events_->invalidate(offset, events_->stride());
    layout::EventEntry head;
    std::memcpy(&head, events_->mapped() + offset, sizeof head);
    const auto kept = std::min<std::size_t>(head.kind, sizes_.events - 1);
    Listed listed{std::vector<layout::EventEntry>(kept), head.kind - static_cast<std::uint32_t>(kept)};
    if (kept > 0)
        std::memcpy(listed.entries.data(), events_->mapped() + offset + sizeof head,
                    kept * sizeof(layout::EventEntry));
    return listed;
}

bool StepRing::isFinished(std::uint64_t frame) const noexcept {
    const RecordedStep& recorded = step(frame);
    if (!recorded.isRecorded || recorded.frame != frame) return false;
    const bool hasEnded = read<std::uint32_t>(ends_, slotOf(frame)) == static_cast<std::uint32_t>(frame);
    std::atomic_thread_fence(std::memory_order_acquire); // before any other result is read
    return hasEnded;
}

bool StepRing::isUndone(std::uint64_t frame) const noexcept {
    if (!isFinished(frame)) return false;
    const layout::StatusWords found = words(frame);
    return found.nonFinite > 0 || found.candidates > 0 || found.lacksLists > 0;
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

std::optional<StepRing::Lack> StepRing::lackOfRoom(std::uint32_t generation,
                                                   std::uint64_t end) const noexcept {
    std::optional<Lack> oldest;
    for (const RecordedStep& one : steps_) {
        const bool isOwn = one.generation == generation && one.frame < end;
        if (!isOwn || !one.isRecorded || !isFinished(one.frame)) continue;
        const std::uint32_t needed = words(one.frame).candidates;
        if (needed > 0 && (!oldest || one.frame < oldest->frame)) oldest = Lack{one.frame, needed};
    }
    return oldest;
}

} // namespace sinew::sim
