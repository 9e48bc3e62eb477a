// The private function tables. Every Vulkan call of the core goes through them, so that the core links no
// loader and never meets the globals of a host's volk. The lists in functions.inc are the only place a
// function is named.
#pragma once

#include <vulkan/vulkan_core.h>

namespace sinew::vk {

struct InstanceFunctions {
#define SINEW_VK(name) PFN_##name name = nullptr;
#define SINEW_VK_DEVICE(name)
#define SINEW_VK_DRAWING(name)
#include "vk/functions.inc"
};

struct DeviceFunctions {
#define SINEW_VK(name)
#define SINEW_VK_DEVICE(name) PFN_##name name = nullptr;
#define SINEW_VK_DRAWING(name) PFN_##name name = nullptr;
#include "vk/functions.inc"
};

/// Fills the table from the host's or the loader's `vkGetInstanceProcAddr`. A missing entry of an extension
/// stays null, and so does what only drawing calls (SINEW_VK_DRAWING); another one that is missing throws
/// Error(noDevice) with its name.
InstanceFunctions loadInstanceFunctions(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance);
DeviceFunctions loadDeviceFunctions(PFN_vkGetDeviceProcAddr getDeviceProcAddr, VkDevice device);

} // namespace sinew::vk
