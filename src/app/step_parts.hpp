// How many submissions a step takes: drivers reset a device whose work takes some seconds, and other programs
// that share it wait meanwhile.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace sinew::app {

/// Parts for the next step, by how long the steps before it took on the device.
class StepParts {
public:
    static constexpr std::uint32_t most = 32;
    static constexpr double longestMs = 50; ///< wanted of a part

    /// Variable with a number that each step takes instead, on any device.
    static constexpr const char* variable = "SINEW_STEP_PARTS";

    /// A software device has no such limit, so its steps stay whole.
    explicit StepParts(bool isSoftware, const char* asked = std::getenv(variable)) {
        const long number = asked != nullptr ? std::strtol(asked, nullptr, 10) : 0;
        isFixed_ = isSoftware || number > 0;
        if (isFixed_) count_ = static_cast<std::uint32_t>(std::clamp(number, 1l, long{most}));
    }

    std::uint32_t count() const { return count_; }

    /// Tells how long a step took on the device [ms]. More parts are taken at once; fewer, one by one.
    void measured(double ms) {
        if (isFixed_ || !std::isfinite(ms)) return;
        const double needed = std::clamp(std::ceil(ms / longestMs), 1.0, double{most});
        count_ = std::max(static_cast<std::uint32_t>(needed), count_ - 1);
    }

    /// Records a step and submits its parts; returns the timeline value of the last. Throws what the queue
    /// throws.
    std::uint64_t submit(vk::Queue& queue, sim::Simulation& simulation, const sim::Step& step,
                         vk::Timestamps* timestamps = nullptr) const {
        std::array<VkCommandBuffer, most> buffers{};
        const auto parts = std::span(buffers).first(count_);
        for (VkCommandBuffer& commands : parts) commands = queue.begin();
        simulation.record(parts, step, timestamps);
        std::uint64_t value = 0;
        for (const VkCommandBuffer commands : parts) value = queue.submit(commands);
        return value;
    }

private:
    static constexpr std::uint32_t ofUnknown = 8; // until a step was measured
    std::uint32_t count_ = ofUnknown;
    bool isFixed_ = false;
};

} // namespace sinew::app
