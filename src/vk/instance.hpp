// The VkInstance of a device that we create ourselves, with validation and the messenger that collects its
// messages. Private to src/vk.
#pragma once

#include "sinew/vk/device.hpp"

#include <mutex>
#include <optional>

namespace sinew::vk {

/// Validation messages, filled by the messenger from any thread that calls Vulkan.
class Messages {
public:
    explicit Messages(std::function<void(const std::string&)> callback) : callback_(std::move(callback)) {}
    void add(const std::string& message);
    std::vector<std::string> all() const;

private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    std::function<void(const std::string&)> callback_;
};

class Instance {
public:
    /// Throws Error(noDevice) if loader, layer, extension or driver is missing.
    Instance(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const DeviceRequest& request);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const noexcept { return instance_; }
    const InstanceFunctions& functions() const noexcept { return functions_; }
    bool hasDebugUtils() const noexcept { return hasDebugUtils_; }
    std::vector<std::string> messages() const { return messages_.all(); }

private:
    const VkAllocationCallbacks* allocation() const noexcept { return callbacks_ ? &*callbacks_ : nullptr; }

    Messages messages_; ///< first: the messenger writes to it until the instance is destroyed
    std::optional<VkAllocationCallbacks> callbacks_;
    InstanceFunctions functions_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool hasDebugUtils_ = false;
};

} // namespace sinew::vk
