// Uses of the buffers of public views by a host, besides drawing and computing with them.
#pragma once

#include "sinew/scene.hpp"
#include "sinew/vk/device.hpp"

#include <vector>

namespace sinew::sim {

struct OutputUse {
    VkBufferUsageFlags usage = 0; ///< in addition to Sinew's own
    /// Those that share them, the device's own included; empty = that one alone.
    std::vector<std::uint32_t> families{};
};

/// Use by Settings::outputUsage and outputFamilies. Throws vk::Error(misuse) on a family that the device
/// lacks.
OutputUse outputUseOf(const vk::Device& device, const Settings& settings);

} // namespace sinew::sim
