// Choice between equivalent forms of a step by measuring them on the device at start-up. The results have the
// same bits, so that a host may also skip this, or reuse earlier measurements.
#pragma once

#include "sinew/export.hpp"
#include "sinew/simulation.hpp"

#include <functional>

namespace sinew::sim {

/// Submits what `record` records, waits for it, and returns its duration [ms], by the device's or the host's
/// clock.
using TimedSubmit = std::function<double(const std::function<void(VkCommandBuffer)>& record)>;

/// A form and the shortest time of a trial step [ms].
struct SINEW_API Trial {
    Forms forms;
    double ms = 0;
};

/// Trials in the order in which they were made; the first has the form of the given settings. Empty if the
/// scene has no choice of forms.
struct SINEW_API Tuning {
    std::vector<Trial> trials;
    Forms fastest;
};

/// Changes one part of the forms after another, each time against the best so far, in trial steps of at most
/// 8 substeps on a simulation of its own; prefers another form only if it is at least 3 % faster. Creates the
/// pipelines of the given form, and the few that other forms add; while vk::KeptKernels exists, a later
/// simulation reuses them all. Throws what Simulation throws.
SINEW_API Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings,
                      const TimedSubmit& submit);

/// Tries the forms that suit the given kind of device.
SINEW_API Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings,
                      const TimedSubmit& submit, DeviceKind kind);

/// The duration [ms] of what `record` records into `commands`: by timestamps on a GPU whose queue has them;
/// else by the host's clock, submission included, since timestamps cost a software device a flush.
/// `submitAndWait` returns when `commands` have finished.
SINEW_API double timed(const vk::Device& device, VkCommandBuffer commands,
                       const std::function<void(VkCommandBuffer)>& record,
                       const std::function<void()>& submitAndWait);

/// Returns `settings` with the forms that timed() measured as fastest. `queue` has begin(), submit() and
/// wait() as vk::Queue; nothing may be in flight on it.
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
