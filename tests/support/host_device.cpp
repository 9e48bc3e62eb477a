// Uses raw Vulkan, so that Device::borrow is tested without help from Device::create.
#include "support/host_device.hpp"

#include "support/full.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace sinew::test {

namespace {

// Global state of the replaced Vulkan functions, which have no user pointer.
struct Replacements {
    PFN_vkGetInstanceProcAddr real = nullptr;
    PFN_vkGetDeviceProcAddr realDevice = nullptr;
    std::map<std::string, PFN_vkVoidFunction, std::less<>> functions;
};
Replacements replacements;

PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name) {
    const auto found = replacements.functions.find(std::string_view(name));
    return found != replacements.functions.end() ? found->second : replacements.realDevice(device, name);
}

PFN_vkVoidFunction VKAPI_CALL instanceProcAddr(VkInstance instance, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&deviceProcAddr);
    const auto found = replacements.functions.find(std::string_view(name));
    return found != replacements.functions.end() ? found->second : replacements.real(instance, name);
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* message, void* messages) {
    static_cast<std::vector<std::string>*>(messages)->push_back(message->pMessage);
    return VK_FALSE;
}

// Ends without destructors, because these wait for the device.
[[noreturn]] void endProgram() {
    std::fprintf(
        stderr,
        "the device has not come back after %lld s: a kernel does not end: look for a buffer that was "
        "never written or never flushed\n",
        static_cast<long long>(HostDevice::longestSubmission.count()));
    std::fflush(nullptr);
    std::_Exit(EXIT_FAILURE);
}

} // namespace

HostDevice::HostDevice(const HostRequest& request) {
    makeInstance(request);
    makeDevice(request.queues);
    replacements = {loader_.getInstanceProcAddr(), instanceFunctions_.vkGetDeviceProcAddr, {}};
    if (request.hasDebugUtils) extensions_.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
}

HostDevice::~HostDevice() {
    finish();
    instanceFunctions_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    instanceFunctions_.vkDestroyInstance(instance_, nullptr);
}

void HostDevice::makeInstance(const HostRequest& request) {
    const VkValidationFeatureEnableEXT enable =
        request.hasGpuAssistedValidation ? VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT
                                         : VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &enable};
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .apiVersion = VK_API_VERSION_1_2};
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = isUnvalidated() ? nullptr : &features,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = isUnvalidated() ? 0u : 1u,
                                    .ppEnabledLayerNames = &layer,
                                    .enabledExtensionCount = isUnvalidated() ? 1u : 2u,
                                    .ppEnabledExtensionNames = extensions};
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(loader_.getInstanceProcAddr()(nullptr, "vkCreateInstance"));
    vk::check(create(&info, nullptr, &instance_), "vkCreateInstance", "the host");
    instanceFunctions_ = vk::loadInstanceFunctions(loader_.getInstanceProcAddr(), instance_);
    const VkDebugUtilsMessengerCreateInfoEXT messenger{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = collect,
        .pUserData = &messages_};
    vk::check(instanceFunctions_.vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
              "vkCreateDebugUtilsMessengerEXT", "the host");
}

void HostDevice::makeDevice(std::uint32_t queues) {
    std::uint32_t count = 1;
    if (instanceFunctions_.vkEnumeratePhysicalDevices(instance_, &count, &physical_) < 0 || count == 0)
        throw vk::Error(vk::Failure::noDevice, "the host finds no device");
    instanceFunctions_.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instanceFunctions_.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
    const auto computes =
        std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties& family) {
            return (family.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0;
        });
    family_ = static_cast<std::uint32_t>(computes - families.begin());
    queueCount_ = std::min(queues, families.at(family_).queueCount);
    const std::vector<float> priorities(queueCount_, 1.0f);
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = family_,
                                        .queueCount = queueCount_,
                                        .pQueuePriorities = priorities.data()};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue};
    vk::check(instanceFunctions_.vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice",
              "the host");
    functions_ = vk::loadDeviceFunctions(instanceFunctions_.vkGetDeviceProcAddr, device_);
}

vk::HostDevice HostDevice::handles() const {
    return {.getInstanceProcAddr = instanceProcAddr,
            .instance = instance_,
            .physicalDevice = physical_,
            .device = device_,
            .queueFamily = family_,
            .enabledInstanceExtensions = extensions_};
}

VkQueue HostDevice::queue(std::uint32_t index) const {
    VkQueue queue = VK_NULL_HANDLE;
    functions_.vkGetDeviceQueue(device_, family_, std::min(index, queueCount_ - 1), &queue);
    return queue;
}

void HostDevice::replace(const std::string& name, PFN_vkVoidFunction replacement) {
    replacements.functions[name] = replacement;
}

PFN_vkVoidFunction HostDevice::original(const std::string& name) const {
    const PFN_vkVoidFunction function = loader_.getInstanceProcAddr()(instance_, name.c_str());
    return function != nullptr ? function : loader_.getInstanceProcAddr()(nullptr, name.c_str());
}

void HostDevice::submit(const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .queueFamilyIndex = family_};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk::check(functions_.vkCreateCommandPool(device_, &poolInfo, nullptr, &pool), "vkCreateCommandPool",
              "the host");
    const VkCommandBufferAllocateInfo allocateInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                   .commandPool = pool,
                                                   .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vk::check(functions_.vkAllocateCommandBuffers(device_, &allocateInfo, &commands),
              "vkAllocateCommandBuffers", "the host");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    vk::check(functions_.vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer", "the host");
    record(commands);
    vk::check(functions_.vkEndCommandBuffer(commands), "vkEndCommandBuffer", "the host");
    const VkFenceCreateInfo fenceInfo{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence = VK_NULL_HANDLE;
    vk::check(functions_.vkCreateFence(device_, &fenceInfo, nullptr, &fence), "vkCreateFence", "the host");
    const VkSubmitInfo submitInfo{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    vk::check(functions_.vkQueueSubmit(queue(0), 1, &submitInfo, fence), "vkQueueSubmit", "the host");
    const std::chrono::nanoseconds longest = longestSubmission;
    const VkResult result =
        functions_.vkWaitForFences(device_, 1, &fence, VK_TRUE, static_cast<std::uint64_t>(longest.count()));
    if (result == VK_TIMEOUT) endProgram();
    vk::check(result, "vkWaitForFences", "the host");
    functions_.vkDestroyFence(device_, fence, nullptr);
    functions_.vkDestroyCommandPool(device_, pool, nullptr);
}

std::vector<std::string> HostDevice::finish() {
    if (device_ != VK_NULL_HANDLE)
        functions_.vkDestroyDevice(std::exchange(device_, VK_NULL_HANDLE), nullptr);
    return messages_;
}

} // namespace sinew::test
