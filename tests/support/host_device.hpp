// Instance and device as another engine makes them: without optional features, with one queue or two, its own
// messenger and, if a test requests it, replaced Vulkan functions.
#pragma once

#include "sinew/vk/device.hpp"
#include "sinew/vk/loader.hpp"

#include <chrono>
#include <map>

namespace sinew::test {

struct HostRequest {
    bool hasGpuAssistedValidation = false; ///< instead of synchronisation validation
    bool hasDebugUtils = true;             ///< whether Sinew gets it; the host always has a messenger
    std::uint32_t queues = 1;              ///< fewer if the family has fewer
};

/// One object at a time. The destructor destroys device and instance, upon which the layer reports leaks.
class HostDevice {
public:
    explicit HostDevice(const HostRequest& request = {});
    ~HostDevice();
    HostDevice(const HostDevice&) = delete;
    HostDevice& operator=(const HostDevice&) = delete;

    /// The handles that an engine would pass. The spans in it live as long as this object.
    vk::HostDevice handles() const;
    const vk::InstanceFunctions& instanceFunctions() const noexcept { return instanceFunctions_; }
    const vk::DeviceFunctions& functions() const noexcept { return functions_; }

    std::uint32_t queueFamily() const noexcept { return family_; }
    /// One of the device's queues, of one family; the last one if there are fewer.
    VkQueue queue(std::uint32_t index) const;
    std::uint32_t queueCount() const noexcept { return queueCount_; }

    /// Gives Sinew `replacement` instead of the instance or device function `name`.
    void replace(const std::string& name, PFN_vkVoidFunction replacement);
    /// The loader's function of this name, for a replacement that forwards calls.
    PFN_vkVoidFunction original(const std::string& name) const;
    /// Runs one recording on the host's queue and waits with a fence. Ends the program with a message if the
    /// device does not finish within `longestSubmission`, because no object that it uses can then be
    /// destroyed.
    void submit(const std::function<void(VkCommandBuffer)>& record);
    static constexpr std::chrono::seconds longestSubmission{10};
    /// Destroys the device and returns all validation messages so far, including leaks.
    std::vector<std::string> finish();

private:
    void makeInstance(const HostRequest& request);
    void makeDevice(std::uint32_t queues);

    vk::Loader loader_;
    std::vector<std::string> messages_;
    std::vector<const char*> extensions_;
    vk::InstanceFunctions instanceFunctions_;
    vk::DeviceFunctions functions_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0, queueCount_ = 1;
};

} // namespace sinew::test
