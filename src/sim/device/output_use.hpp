// What a host does with the buffers of public views besides drawing and computing with them.
#pragma once

#include "sinew/scene.hpp"
#include "sinew/vk/device.hpp"

#include <vector>

namespace sinew::sim {

struct OutputUse {
    VkBufferUsageFlags usage = 0; ///< in addition to Sinew's own
    std::vector<std::uint32_t>
        families{}; ///< that share them, the device's own included; empty = that one alone
};

/// Use by Settings::outputUsage and outputFamilies. Throws vk::Error(misuse) on a family that the device
/// lacks.
OutputUse outputUseOf(const vk::Device& device, const Settings& settings);

} // namespace sinew::sim
