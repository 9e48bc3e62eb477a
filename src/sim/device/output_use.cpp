// Checks queue families against those of the device; validate() has checked usages.
#include "sim/device/output_use.hpp"

#include "sinew/ranges.hpp"
#include "sinew/vk/check.hpp"
#include "sinew/vk/functions.hpp"

#include <bit>
#include <string>

namespace sinew::sim {

static_assert(ranges::outputUsages ==
              (VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
               VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT |
               VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
               VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
               VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR));

OutputUse outputUseOf(const vk::Device& device, const Settings& settings) {
    OutputUse use{.usage = settings.outputUsage};
    const std::uint32_t own = device.queueFamily();
    const std::uint32_t others = own < 32 ? settings.outputFamilies & ~(1u << own) : settings.outputFamilies;
    if (others == 0) return use;
    std::uint32_t count = 0;
    device.instanceFunctions().vkGetPhysicalDeviceQueueFamilyProperties(device.physical(), &count, nullptr);
    use.families.push_back(own);
    for (std::uint32_t family = 0; family < 32; ++family)
        if ((others >> family & 1) != 0) use.families.push_back(family);
    if (use.families.back() >= count)
        throw vk::Error(vk::Failure::misuse,
                        "settings.outputFamilies: bit " + std::to_string(use.families.back()) +
                            " is set, the device has " + std::to_string(count) + " queue families");
    return use;
}

} // namespace sinew::sim
