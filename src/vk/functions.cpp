// Fills the private function tables.
#include "sinew/vk/functions.hpp"

#include "sinew/vk/check.hpp"

#include <string_view>

namespace sinew::vk {

namespace {

// Functions of extensions may be missing; those of the core may not.
template <typename Function> Function required(PFN_vkVoidFunction function, std::string_view name) {
    if (function == nullptr && !name.ends_with("EXT"))
        throw Error(Failure::noDevice, "the Vulkan driver lacks " + std::string(name) +
                                           ", which Vulkan 1.2 requires: update the driver");
    return reinterpret_cast<Function>(function);
}

} // namespace

InstanceFunctions loadInstanceFunctions(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance) {
    InstanceFunctions functions;
#define SINEW_VK(name) functions.name = required<PFN_##name>(getInstanceProcAddr(instance, #name), #name);
#define SINEW_VK_DEVICE(name)
#define SINEW_VK_DRAWING(name)
#include "sinew/vk/functions.inc"
    return functions;
}

DeviceFunctions loadDeviceFunctions(PFN_vkGetDeviceProcAddr getDeviceProcAddr, VkDevice device) {
    DeviceFunctions functions;
#define SINEW_VK(name)
#define SINEW_VK_DEVICE(name) functions.name = required<PFN_##name>(getDeviceProcAddr(device, #name), #name);
#define SINEW_VK_DRAWING(name)                                                                               \
    functions.name = reinterpret_cast<PFN_##name>(getDeviceProcAddr(device, #name));
#include "sinew/vk/functions.inc"
    return functions;
}

} // namespace sinew::vk
