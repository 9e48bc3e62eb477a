// Chooses between equal forms of a step by measuring them on the device, at start-up. No choice changes a bit
// of the result, so that a host may also skip this, or keep what it measured last time.
#pragma once

#include "sim/simulation.hpp"

#include <functional>

namespace sinew::sim {

/// Submits what `record` records and returns when it is done, with the time that took [ms]: of the device, or
/// of the host's clock.
using TimedSubmit = std::function<double(const std::function<void(VkCommandBuffer)>& record)>;

/// One form and the shortest time of a trial step [ms].
struct Trial {
    Forms forms;
    double ms = 0;
};

/// The trials in the order they were made; the first is the form of the settings given. Empty where the scene
/// has nothing to choose.
struct Tuning {
    std::vector<Trial> trials;
    Forms fastest;
};

/// Tries forms one change after another, each against the best so far, in trial steps of at most 8 substeps
/// on a simulation of its own; takes another form only where it is at least 3 % faster. Creates pipelines:
/// those of the given form, and the few in which another one differs; while vk::KeptKernels are there, a
/// simulation that follows has no others to make. Throws what Simulation throws.
Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings,
            const TimedSubmit& submit);

/// Tries the forms that suit a device of that kind.
Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings, const TimedSubmit& submit,
            DeviceKind kind);

/// The time [ms] of what `record` records into `commands`: on a GPU by its timestamps, where the queue has
/// them; else by the host's clock, submission included, since timestamps cost a software device a flush.
/// `submitAndWait` returns when `commands` have finished.
double timed(const vk::Device& device, VkCommandBuffer commands,
             const std::function<void(VkCommandBuffer)>& record, const std::function<void()>& submitAndWait);

/// `settings` with the forms that ran fastest just now, as timed() sees it.
/// `queue` has begin(), submit() and wait() as vk::Queue; nothing may be in flight on it.
template <typename Queue>
Settings tuned(const vk::Device& device, Queue& queue, const Scene& scene, Settings settings) {
    const auto submit = [&](const std::function<void(VkCommandBuffer)>& record) {
        const VkCommandBuffer commands = queue.begin();
        return timed(device, commands, record, [&] { queue.wait(queue.submit(commands)); });
    };
    settings.forms = tune(device, scene, settings, submit).fastest;
    return settings;
}

} // namespace sinew::sim
