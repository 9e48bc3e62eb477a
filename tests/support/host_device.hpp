// Instance and device as a foreign engine makes them: by hand, no optional feature, one queue, its own
// messenger and, where a test wants it, its own idea of what some Vulkan functions do.
#pragma once

#include "vk/device.hpp"
#include "vk/loader.hpp"

#include <chrono>
#include <map>

namespace sinew::test {

struct HostRequest {
    bool hasGpuAssistedValidation = false; ///< instead of synchronisation validation
    bool hasDebugUtils = true;             ///< passed on to Sinew; the host itself always has a messenger
};

/// One at a time. Destroys device and instance, which is when the layer reports what leaked.
class HostDevice {
public:
    explicit HostDevice(const HostRequest& request = {});
    ~HostDevice();
    HostDevice(const HostDevice&) = delete;
    HostDevice& operator=(const HostDevice&) = delete;

    /// What an engine would pass on. The spans in it live as long as this object.
    vk::HostDevice handles() const;
    const vk::InstanceFunctions& instanceFunctions() const noexcept { return instanceFunctions_; }
    const vk::DeviceFunctions& functions() const noexcept { return functions_; }

    /// Sinew gets `replacement` instead of the function `name`, of instance or device.
    void replace(const std::string& name, PFN_vkVoidFunction replacement);
    /// What the loader has under this name, for a replacement that passes calls on.
    PFN_vkVoidFunction original(const std::string& name) const;
    /// Runs one recording on the host's queue and waits with a fence. Ends the program with a sentence where
    /// the device has not come back after `longestSubmission`: nothing that it uses can be destroyed then.
    void submit(const std::function<void(VkCommandBuffer)>& record);
    static constexpr std::chrono::seconds longestSubmission{10};
    /// Destroys the device and returns all validation messages so far, leaks included.
    std::vector<std::string> finish();

private:
    void makeInstance(const HostRequest& request);
    void makeDevice();

    vk::Loader loader_;
    std::vector<std::string> messages_;
    std::vector<const char*> extensions_;
    vk::InstanceFunctions instanceFunctions_;
    vk::DeviceFunctions functions_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
};

} // namespace sinew::test
