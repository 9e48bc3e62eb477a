// Failures of the machine at set-up: one exception type with the call, its result and the object's name.
#pragma once

#include "sinew/export.hpp"

#include <vulkan/vulkan_core.h>

#include <stdexcept>
#include <string>

namespace sinew::vk {

/// Kind of a failure, by what a caller can do about it; programs map it to their exit codes.
enum class Failure {
    noDevice,    ///< no loader, driver or device that can run Sinew (exit code 4)
    outOfMemory, ///< host or device memory, or a limit of the device (exit code 5)
    deviceLost,  ///< VK_ERROR_DEVICE_LOST (exit code 5)
    misuse,      ///< a call that the specification forbids: a bug in Sinew (exit code 70)
};

class SINEW_API Error : public std::runtime_error {
public:
    Error(Failure failure, const std::string& message) : std::runtime_error(message), failure_(failure) {}
    Failure failure() const noexcept { return failure_; }

private:
    Failure failure_;
};

/// The specification's name of a result, such as "VK_ERROR_DEVICE_LOST".
SINEW_API const char* resultName(VkResult result) noexcept;

/// Throws Error("<call> of <object>: <result name>") unless `result` is a success code (>= 0).
SINEW_API void check(VkResult result, const char* call, const std::string& object);

} // namespace sinew::vk
