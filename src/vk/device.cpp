// Creation and borrowing of devices. Parts that others point at are in the heap-allocated State, so that a
// Device can be moved.
#include "sinew/vk/device.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "vk/allocator.hpp"
#include "vk/choice.hpp"
#include "vk/instance.hpp"
#include "vk/pipeline_cache.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace sinew::vk {

struct Device::State {
    std::optional<VkAllocationCallbacks> callbacks; ///< functions.allocation points at it
    std::unique_ptr<Instance> ownInstance;          ///< null if borrowed; destroyed last
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    VkQueueFlags queueFlags = 0;
    InstanceFunctions instanceFunctions;
    DeviceFunctions functions;
    Limits limits;
    DeviceDescription description;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    std::unique_ptr<Allocator> allocator;
    KernelStore kernels;
    std::unique_ptr<Device> anchored; ///< does not own this State

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        allocator.reset();
        if (pipelineCache != VK_NULL_HANDLE)
            functions.vkDestroyPipelineCache(device, pipelineCache, functions.allocation);
        if (ownInstance && device != VK_NULL_HANDLE) // looked up again: the table may be what failed to load
            reinterpret_cast<PFN_vkDestroyDevice>(instanceFunctions.vkGetDeviceProcAddr(
                device, "vkDestroyDevice"))(device, callbacks ? &*callbacks : nullptr);
    }
};

namespace {

constexpr const char* portabilitySubset = "VK_KHR_portability_subset"; // named in vulkan_beta.h

Limits readLimits(const InstanceFunctions& functions, VkPhysicalDevice physical,
                  const VkQueueFamilyProperties& family) {
    VkPhysicalDeviceProperties properties;
    functions.vkGetPhysicalDeviceProperties(physical, &properties);
    const VkPhysicalDeviceLimits& limits = properties.limits;
    return {.maxStorageBufferRange = limits.maxStorageBufferRange,
            .maxStorageBuffersPerStage =
                std::min(limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers),
            .maxTexels = limits.maxTexelBufferElements,
            .maxGroupCount = limits.maxComputeWorkGroupCount[0],
            .maxGroupInvocations = limits.maxComputeWorkGroupInvocations,
            .maxGroupSizeX = limits.maxComputeWorkGroupSize[0],
            .maxPushConstants = limits.maxPushConstantsSize,
            .maxSharedMemory = limits.maxComputeSharedMemorySize,
            .storageBufferAlignment = limits.minStorageBufferOffsetAlignment,
            .texelBufferAlignment = limits.minTexelBufferOffsetAlignment,
            .nonCoherentAtom = limits.nonCoherentAtomSize,
            .timestampPeriod = family.timestampValidBits == 0 ? 0 : limits.timestampPeriod,
            .timestampBits = family.timestampValidBits};
}

VkQueueFamilyProperties readFamily(const InstanceFunctions& functions, VkPhysicalDevice physical,
                                   std::uint32_t family) {
    std::uint32_t count = 0;
    functions.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    functions.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    if (family >= count || (families[family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
        throw Error(Failure::noDevice, "queue family " + std::to_string(family) +
                                           " of the device cannot compute: give one that can");
    return families[family];
}

// True if the device can draw the edges of triangles (VK_POLYGON_MODE_LINE), which viewers use.
VkBool32 canDrawEdges(const InstanceFunctions& functions, VkPhysicalDevice physical) {
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    functions.vkGetPhysicalDeviceFeatures2(physical, &features);
    return features.features.fillModeNonSolid;
}

VkDevice createDevice(const InstanceFunctions& functions, const Candidate& chosen,
                      const DeviceRequest& request) {
    VkPhysicalDeviceVulkan12Features features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                              .timelineSemaphore =
                                                  VK_TRUE}; // for vk::Queue; the core needs none
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = chosen.queueFamily,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    std::vector<const char*> extensions;
    for (const std::string& extension : request.deviceExtensions) extensions.push_back(extension.c_str());
    if (hasExtension(functions, chosen.physical, portabilitySubset)) // Vulkan requires it if it exists
        extensions.push_back(portabilitySubset);
    const VkPhysicalDeviceFeatures drawn{.fillModeNonSolid = canDrawEdges(functions, chosen.physical)};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data(),
                                  .pEnabledFeatures = &drawn};
    VkDevice device = VK_NULL_HANDLE;
    check(functions.vkCreateDevice(chosen.physical, &info, request.allocation, &device), "vkCreateDevice",
          chosen.description.name);
    return device;
}

void checkHost(const HostDevice& host) {
    if (host.getInstanceProcAddr == nullptr || host.instance == VK_NULL_HANDLE ||
        host.physicalDevice == VK_NULL_HANDLE || host.device == VK_NULL_HANDLE)
        throw Error(Failure::misuse,
                    "a host device needs getInstanceProcAddr, instance, physicalDevice and device");
    if (static_cast<bool>(host.buffers.create) != static_cast<bool>(host.buffers.destroy))
        throw Error(Failure::misuse, "a buffer hook needs both create and destroy");
    if (host.apiVersion < VK_API_VERSION_1_2)
        throw Error(Failure::noDevice,
                    "the host's instance asks for less than Vulkan 1.2, which Sinew needs");
}

void dropDebugUtils(DeviceFunctions& functions) {
    functions.vkSetDebugUtilsObjectNameEXT = nullptr;
    functions.vkCmdBeginDebugUtilsLabelEXT = nullptr;
    functions.vkCmdEndDebugUtilsLabelEXT = nullptr;
}

} // namespace

void Device::Release::operator()(State* state) const noexcept {
    if (isOwner) delete state;
}

Device::Device(Handle state) : state_(std::move(state)) {}

Device Device::make() {
    Device device(Handle(new State, Release{true}));
    State& state = *device.state_;
    state.anchored.reset(new Device(Handle(&state, Release{false})));
    return device;
}

Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

void Device::complete(bool hasDebugUtils, const BufferHook& hook, std::span<const std::byte> pipelines) {
    State& state = *state_;
    const VkQueueFamilyProperties family =
        readFamily(state.instanceFunctions, state.physical, state.queueFamily);
    state.queueFlags = family.queueFlags;
    state.limits = readLimits(state.instanceFunctions, state.physical, family);
    state.functions = loadDeviceFunctions(state.instanceFunctions.vkGetDeviceProcAddr, state.device);
    if (state.callbacks) state.functions.allocation = &*state.callbacks;
    if (!hasDebugUtils) // some loaders provide the functions all the same
        dropDebugUtils(state.functions);
    VkPhysicalDeviceMemoryProperties memory;
    state.instanceFunctions.vkGetPhysicalDeviceMemoryProperties(state.physical, &memory);
    state.allocator =
        hook.create ? makeHookAllocator(hook) : makeBlockAllocator(state.device, state.functions, memory);
    usePipelines(pipelines);
}

void Device::usePipelines(std::span<const std::byte> kept) {
    State& state = *state_;
    const std::span<const std::byte> earlier = unsealed(kept);
    const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                         .initialDataSize = earlier.size(),
                                         .pInitialData = earlier.data()};
    VkPipelineCache cache = VK_NULL_HANDLE;
    check(state.functions.vkCreatePipelineCache(state.device, &info, state.functions.allocation, &cache),
          "vkCreatePipelineCache", state.description.name);
    if (state.pipelineCache != VK_NULL_HANDLE)
        state.functions.vkDestroyPipelineCache(state.device, state.pipelineCache, state.functions.allocation);
    state.pipelineCache = cache;
    name(VK_OBJECT_TYPE_PIPELINE_CACHE, handleValue(cache), "sinew.pipelines");
}

Device Device::create(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const DeviceRequest& request) {
    Device device = make();
    State& state = *device.state_;
    if (request.allocation != nullptr) state.callbacks = *request.allocation;
    state.ownInstance = std::make_unique<Instance>(getInstanceProcAddr, request);
    state.getInstanceProcAddr = getInstanceProcAddr;
    state.instance = state.ownInstance->handle();
    state.instanceFunctions = state.ownInstance->functions();
    const std::vector<Candidate> candidates = findCandidates(*state.ownInstance, request);
    const Candidate& chosen = choose(candidates, request.device);
    state.physical = chosen.physical;
    state.queueFamily = chosen.queueFamily;
    state.description = chosen.description;
    state.description.isChosen = true;
    state.device = createDevice(state.instanceFunctions, chosen, request);
    device.complete(state.ownInstance->hasDebugUtils(), {}, request.pipelineCache);
    return device;
}

Device Device::borrow(const HostDevice& host) {
    checkHost(host);
    Device device = make();
    State& state = *device.state_;
    if (host.allocation != nullptr) state.callbacks = *host.allocation;
    state.getInstanceProcAddr = host.getInstanceProcAddr;
    state.instance = host.instance;
    state.physical = host.physicalDevice;
    state.device = host.device;
    state.queueFamily = host.queueFamily;
    state.instanceFunctions = loadInstanceFunctions(host.getInstanceProcAddr, host.instance);
    state.description = describeDevice(state.instanceFunctions, host.physicalDevice);
    if (state.description.apiVersion < VK_API_VERSION_1_2)
        throw Error(Failure::noDevice, state.description.name + " lacks Vulkan 1.2, which Sinew needs");
    state.description.isChosen = true;
    const auto& enabled = host.enabledInstanceExtensions;
    device.complete(std::find(enabled.begin(), enabled.end(),
                              std::string_view(VK_EXT_DEBUG_UTILS_EXTENSION_NAME)) != enabled.end(),
                    host.buffers, host.pipelineCache);
    return device;
}

VkInstance Device::instance() const noexcept {
    return state_->instance;
}
VkPhysicalDevice Device::physical() const noexcept {
    return state_->physical;
}
VkDevice Device::handle() const noexcept {
    return state_->device;
}
std::uint32_t Device::queueFamily() const noexcept {
    return state_->queueFamily;
}
VkQueueFlags Device::queueFlags() const noexcept {
    return state_->queueFlags;
}
PFN_vkGetInstanceProcAddr Device::getInstanceProcAddr() const noexcept {
    return state_->getInstanceProcAddr;
}
const InstanceFunctions& Device::instanceFunctions() const noexcept {
    return state_->instanceFunctions;
}
const DeviceFunctions& Device::functions() const noexcept {
    return state_->functions;
}
const Limits& Device::limits() const noexcept {
    return state_->limits;
}
const DeviceDescription& Device::description() const noexcept {
    return state_->description;
}
const Device& Device::anchored() const noexcept {
    return *state_->anchored;
}
KernelStore& Device::kernels() const noexcept {
    return state_->kernels;
}

Allocator& Device::allocator() const noexcept {
    return *state_->allocator;
}
VkPipelineCache Device::pipelineCache() const noexcept {
    return state_->pipelineCache;
}

std::vector<std::byte> Device::pipelineCacheData() const {
    std::vector<std::byte> data;
    VkResult result = VK_INCOMPLETE; // another thread may add pipelines between the two calls
    while (result == VK_INCOMPLETE) {
        std::size_t size = 0;
        check(state_->functions.vkGetPipelineCacheData(state_->device, state_->pipelineCache, &size, nullptr),
              "vkGetPipelineCacheData", "sinew.pipelines");
        data.resize(size);
        result = state_->functions.vkGetPipelineCacheData(state_->device, state_->pipelineCache, &size,
                                                          data.data());
        check(result, "vkGetPipelineCacheData", "sinew.pipelines");
        data.resize(size);
    }
    return sealed(std::move(data));
}

void Device::name(VkObjectType type, std::uint64_t handle, const std::string& name) const noexcept {
    if (state_->functions.vkSetDebugUtilsObjectNameEXT == nullptr) return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = handle,
                                             .pObjectName = name.c_str()};
    state_->functions.vkSetDebugUtilsObjectNameEXT(state_->device,
                                                   &info); // failure is harmless
}

std::vector<std::string> Device::validationMessages() const {
    return state_->ownInstance ? state_->ownInstance->messages() : std::vector<std::string>{};
}

std::vector<DeviceDescription> listDevices(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                           const DeviceRequest& request) {
    const Instance instance(getInstanceProcAddr, request);
    const std::vector<Candidate> candidates = findCandidates(instance, request);
    const Candidate* chosen = findBest(candidates, request.device);
    std::vector<DeviceDescription> descriptions;
    for (const Candidate& candidate : candidates) {
        descriptions.push_back(candidate.description);
        descriptions.back().isChosen = &candidate == chosen;
    }
    return descriptions;
}

} // namespace sinew::vk
