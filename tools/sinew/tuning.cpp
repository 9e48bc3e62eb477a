// Times trial steps by the host's clock, submission included: what a user waits for.
#include "sinew/tuning.hpp"

#include "sim/gpu_tune.hpp"

#include <chrono>

namespace sinew::tools {

sim::Settings tuned(Session& session, const sim::Scene& scene, sim::Settings settings) {
    const auto submit = [&](const std::function<void(VkCommandBuffer)>& record) {
        const VkCommandBuffer commands = session.queue.begin();
        record(commands);
        const auto start = std::chrono::steady_clock::now();
        session.queue.wait(session.queue.submit(commands));
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    };
    settings.forms = sim::tune(session.device, scene, settings, submit).fastest;
    return settings;
}

} // namespace sinew::tools
