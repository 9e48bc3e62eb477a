// The queue of a device for one call, and steps on it, for programs without an engine.
#pragma once

#include "capi/objects.hpp"

namespace sinew::capi {

/// The queue of a device, for one thread. What is submitted and not waited for has finished at the end, also
/// if an exception leaves the scope: the objects that it uses may then be destroyed.
class Submitting {
public:
    explicit Submitting(DeviceObject& device)
        : queue_(queueOf(device)), lock_(device.queueMutex), drain_(queue_) {}
    vk::Queue* operator->() const noexcept { return &queue_; }

    /// Submits what `record` records, and waits.
    template <typename Record> void run(const vk::Device& device, Record&& record) {
        const VkCommandBuffer commands = queue_.begin();
        record(commands);
        vk::Commands(device, commands).hostBarrier();
        queue_.wait(queue_.submit(commands));
    }

private:
    vk::Queue& queue_;
    std::lock_guard<std::mutex> lock_;
    vk::Drain drain_;
};

/// Records the reset before the first step.
inline void resetOnce(SimulationObject& object, Submitting& queue) {
    if (object.isReset) return;
    const VkCommandBuffer commands = queue->begin();
    object.simulation->recordReset(commands);
    queue->submit(commands);
    object.isReset = true;
}

/// Takes steps as far as several may be in flight, and repeats those that must be.
class Stepper {
public:
    Stepper(SimulationObject& object, Submitting& queue, const sim::Step& step)
        : object_(object), queue_(queue), step_(step), values_(object.settings.framesInFlight) {
        step_.repeats = true;
        first_ = object.nextFrame;
        motions_ = step.motions;
        object.stepEvents = {};
    }
    virtual ~Stepper() = default;
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;

    void take(std::uint32_t count) {
        const std::uint64_t end = object_.nextFrame + count;
        std::uint64_t waiting = object_.nextFrame;
        while (waiting < end) {
            if (object_.nextFrame < end && object_.nextFrame - waiting < values_.size())
                submit();
            else if (finish(waiting))
                ++waiting;
            else
                object_.nextFrame = waiting;
        }
        growSurface(last_);
    }

protected:
    /// Continues in a simulation with more room, or throws. All steps have finished.
    virtual void growContacts(const sim::StepStatus& status) = 0;
    /// The same, if there is more room to be had. `status` is that of the last step, or none.
    virtual void growSurface(const sim::StepStatus& status) = 0;

    SimulationObject& object_;
    Submitting& queue_;

private:
    void submit() {
        step_.frame = object_.nextFrame;
        step_.motions = step_.frame == first_ ? motions_ : std::span<const sim::Motion>{};
        const VkCommandBuffer commands = queue_->begin();
        object_.simulation->record(commands, step_);
        vk::Commands(object_.device.device, commands).hostBarrier();
        values_[step_.frame % values_.size()] = queue_->submit(commands);
        ++object_.nextFrame;
    }

    /// False if the step and those behind it must be repeated.
    bool finish(std::uint64_t frame) {
        queue_->wait(values_[frame % values_.size()]);
        const sim::StepStatus status = object_.simulation->status(frame);
        if (!status.isFinished)
            throw std::logic_error("the status of step " + std::to_string(frame) + " is not there");
        if (status.contactRoom > 0 || status.lacksLists || status.nonFinite > 0) queue_->waitIdle();
        if (status.contactRoom > 0) {
            keepEvents(frame); // that it lacks room; the repeated step will not
            growContacts(status);
        }
        if (status.contactRoom > 0 || status.lacksLists) return false;
        if (status.nonFinite > 0)
            throw Failed{SINEW_ERROR_DIVERGED, "step " + std::to_string(frame) + ": the state of " +
                                                   std::to_string(status.nonFinite) +
                                                   " particles is not finite, the first one is particle " +
                                                   std::to_string(status.firstBadParticle) +
                                                   ": take more substeps"};
        keepEvents(frame);
        ++object_.stepsDone;
        last_ = status;
        return true;
    }

    void keepEvents(std::uint64_t frame) {
        if (object_.settings.events == 0) return;
        const sim::Events events = object_.simulation->events(frame);
        for (const sim::Event& event : events.list) object_.stepEvents.list.emplace_back(frame, event);
        object_.stepEvents.lost += events.lost;
    }

    sim::Step step_;
    std::uint64_t first_ = 0;              // frame of the first step
    std::span<const sim::Motion> motions_; // of that step
    std::vector<std::uint64_t> values_;    // of the timeline, of steps in flight
    sim::StepStatus last_;
};

} // namespace sinew::capi
