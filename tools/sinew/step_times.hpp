// Times of steps, from the moments at which the host sees them finished.
#pragma once

#include <cstdint>

namespace sinew::tools {

/// Several steps are in flight, and a host that wakes late sees some of them finish together. Such steps
/// share the time since the last one in equal parts, so that sums and medians are those of the device. Steps
/// are counted from 0 and taken in order. One thread.
class StepTimes {
public:
    /// Call before the first submission after a pause; `step` is the next one. `now` [ms] of any clock.
    void start(std::uint64_t step, double now) {
        seen_ = step;
        end_ = now;
    }
    /// True if the end of `step` was not seen together with that of an earlier step: call see() then.
    bool awaits(std::uint64_t step) const { return step >= seen_; }
    /// At `now` [ms], `step` and all others before `next` are finished.
    void see(std::uint64_t step, std::uint64_t next, double now) {
        share_ = (now - end_) / static_cast<double>(next - step);
        seen_ = next;
    }
    /// The duration [ms] of the next step, which see() has covered.
    double take() {
        end_ += share_;
        return share_;
    }
    /// Steps from `step` on are undone and come again; the step that succeeds gets their time as well.
    void undo(std::uint64_t step) { seen_ = step; }

private:
    std::uint64_t seen_ = 0; // steps before it are known to be finished
    double end_ = 0,
           share_ = 0; // [ms]: the end of the last step that was taken, the part of each in its group
};

} // namespace sinew::tools
