// Names of VkResult values and their mapping to Failure.
#include "sinew/vk/check.hpp"

namespace sinew::vk {

const char* resultName(VkResult result) noexcept {
#define SINEW_RESULT(name)                                                                                   \
    case name:                                                                                               \
        return #name;
    switch (result) {
        SINEW_RESULT(VK_SUCCESS)
        SINEW_RESULT(VK_NOT_READY)
        SINEW_RESULT(VK_TIMEOUT)
        SINEW_RESULT(VK_INCOMPLETE)
        SINEW_RESULT(VK_SUBOPTIMAL_KHR)
        SINEW_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY)
        SINEW_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        SINEW_RESULT(VK_ERROR_INITIALIZATION_FAILED)
        SINEW_RESULT(VK_ERROR_DEVICE_LOST)
        SINEW_RESULT(VK_ERROR_MEMORY_MAP_FAILED)
        SINEW_RESULT(VK_ERROR_LAYER_NOT_PRESENT)
        SINEW_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT)
        SINEW_RESULT(VK_ERROR_FEATURE_NOT_PRESENT)
        SINEW_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER)
        SINEW_RESULT(VK_ERROR_TOO_MANY_OBJECTS)
        SINEW_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED)
        SINEW_RESULT(VK_ERROR_FRAGMENTED_POOL)
        SINEW_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY)
        SINEW_RESULT(VK_ERROR_FRAGMENTATION)
        SINEW_RESULT(VK_ERROR_SURFACE_LOST_KHR)
        SINEW_RESULT(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
        SINEW_RESULT(VK_ERROR_OUT_OF_DATE_KHR)
        SINEW_RESULT(VK_ERROR_VALIDATION_FAILED_EXT)
    default:
        return "an unnamed VkResult";
    }
#undef SINEW_RESULT
}

namespace {

Failure failureOf(VkResult result) noexcept {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_FRAGMENTATION:
    case VK_ERROR_MEMORY_MAP_FAILED:
    case VK_ERROR_TOO_MANY_OBJECTS:
        return Failure::outOfMemory;
    case VK_ERROR_DEVICE_LOST:
        return Failure::deviceLost;
    case VK_ERROR_INITIALIZATION_FAILED:
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
    case VK_ERROR_SURFACE_LOST_KHR:
        return Failure::noDevice;
    default:
        return Failure::misuse;
    }
}

} // namespace

void check(VkResult result, const char* call, const std::string& object) {
    if (result < 0)
        throw Error(failureOf(result), std::string(call) + " of " + object + ": " + resultName(result));
}

} // namespace sinew::vk
