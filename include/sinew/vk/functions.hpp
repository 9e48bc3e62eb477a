// The private function tables. Every Vulkan call of the core goes through them, so that the core links no
// loader and does not interfere with the globals of a host's volk. The lists in functions.inc are the only
// place that names functions.
#pragma once

#include "sinew/export.hpp"

#include <vulkan/vulkan_core.h>

namespace sinew::vk {

struct SINEW_API InstanceFunctions {
#define SINEW_VK(name) PFN_##name name = nullptr;
#define SINEW_VK_DEVICE(name)
#define SINEW_VK_DRAWING(name)
#include "sinew/vk/functions.inc"
};

struct SINEW_API DeviceFunctions {
#define SINEW_VK(name)
#define SINEW_VK_DEVICE(name) PFN_##name name = nullptr;
#define SINEW_VK_DRAWING(name) PFN_##name name = nullptr;
#include "sinew/vk/functions.inc"
    /// For every object that is made with these functions (HostDevice::allocation); null = the driver's own.
    const VkAllocationCallbacks* allocation = nullptr;
};

/// Fills the table through the host's or the loader's `vkGetInstanceProcAddr`. A missing function of an
/// extension, or one that only drawing uses (SINEW_VK_DRAWING), stays null; any other missing function throws
/// Error(noDevice) with its name.
SINEW_API InstanceFunctions loadInstanceFunctions(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                                  VkInstance instance);
SINEW_API DeviceFunctions loadDeviceFunctions(PFN_vkGetDeviceProcAddr getDeviceProcAddr, VkDevice device);

} // namespace sinew::vk
