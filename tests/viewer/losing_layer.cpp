// A Vulkan layer for tests of lost devices and failing calls, controlled by environment variables.
// Devices are lost while the file SINEW_LOSE_DEVICES exists: they accept no work, and waits fail. If the file
// holds a number, that many devices made afterwards are lost at once; later ones are lost when the file's
// contents change.
// SINEW_FAIL_CALL=N lets the Nth fallible call return SINEW_FAIL_RESULT (a number, by default
// VK_ERROR_OUT_OF_DEVICE_MEMORY) without effect. SINEW_FAIL_TIMES is the number of consecutive failing calls
// (default one). If SINEW_FAIL_FROM is given, calls count only once this file exists. The file
// SINEW_FAIL_REPORT receives the names of failed calls, one a line.
// SINEW_BLOCK_CALL names a call that never returns once the file SINEW_BLOCK_FROM exists; the layer then
// makes the file SINEW_BLOCK_REPORT.
#include <vulkan/vk_layer.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace {

struct Next {
    PFN_vkGetInstanceProcAddr instance = nullptr;
    PFN_vkGetDeviceProcAddr device = nullptr;
    VkInstance handle = VK_NULL_HANDLE;  // for instances
    VkDevice owner = VK_NULL_HANDLE;     // for devices
    std::optional<std::string> sparedBy; // for devices: contents of the file under which it was made
};

// Key of a dispatchable handle: each begins with a pointer to its instance's or device's table.
template <typename Handle> void* keyOf(Handle handle) {
    return *reinterpret_cast<void**>(handle);
}

std::mutex mutex;
std::map<void*, Next> instances, devices;
std::map<std::string, int> madeUnder; // number of devices by contents of the file

Next nextOf(const std::map<void*, Next>& all, void* key) {
    const std::lock_guard lock(mutex);
    const auto found = all.find(key);
    return found == all.end() ? Next{} : found->second;
}

const char* lossFile() {
    return std::getenv("SINEW_LOSE_DEVICES");
}

// Contents of the file; empty without a file.
std::optional<std::string> loss() {
    std::ifstream file(lossFile() != nullptr ? lossFile() : "");
    if (!file) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

// Whether a device, or the device of a queue, is lost.
template <typename Handle> bool isLost(Handle handle) {
    const std::optional<std::string> said = loss();
    return said && (said->empty() || nextOf(devices, keyOf(handle)).sparedBy != said);
}

template <typename Function, typename Handle> Function down(Handle handle, const char* name) {
    const Next next = nextOf(devices, keyOf(handle));
    return reinterpret_cast<Function>(next.device(next.owner, name));
}

template <typename Info, typename Create> Info* linkIn(const Create* create, VkStructureType type) {
    auto* info = reinterpret_cast<Info*>(const_cast<void*>(create->pNext));
    while (info != nullptr && !(info->sType == type && info->function == VK_LAYER_LINK_INFO))
        info = reinterpret_cast<Info*>(const_cast<void*>(info->pNext));
    return info;
}

// Value of an environment variable; `otherwise` if it is not set.
long number(const char* variable, long otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::atol(text) : otherwise;
}

bool doCallsCount() {
    const char* from = std::getenv("SINEW_FAIL_FROM");
    return from == nullptr || std::ifstream(from);
}

void blockWhereAsked(const char* name) {
    static const char *const call = std::getenv("SINEW_BLOCK_CALL"),
                             *const from = std::getenv("SINEW_BLOCK_FROM"),
                             *const report = std::getenv("SINEW_BLOCK_REPORT");
    if (call == nullptr || from == nullptr || std::strcmp(call, name) != 0 || !std::ifstream(from)) return;
    if (report != nullptr) std::ofstream(report) << name << '\n';
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

// Whether this call must fail.
bool isStruck(const char* name) {
    blockWhereAsked(name);
    static const long first = number("SINEW_FAIL_CALL", 0), times = number("SINEW_FAIL_TIMES", 1);
    static long calls = 0;
    if (first == 0 || !doCallsCount()) return false;
    const std::lock_guard lock(mutex);
    ++calls;
    if (calls < first || calls - first >= times) return false;
    const char* report = std::getenv("SINEW_FAIL_REPORT");
    if (report != nullptr) std::ofstream(report, std::ios::app) << name << '\n';
    return true;
}

VkResult strike() {
    return static_cast<VkResult>(number("SINEW_FAIL_RESULT", VK_ERROR_OUT_OF_DEVICE_MEMORY));
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* create,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
    auto* link = linkIn<VkLayerInstanceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    Next next{.instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr};
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto call =
        reinterpret_cast<PFN_vkCreateInstance>(next.instance(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = call(create, allocator, instance);
    if (result != VK_SUCCESS) return result;
    next.handle = *instance;
    const std::lock_guard lock(mutex);
    instances[keyOf(*instance)] = next;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* create,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link = linkIn<VkLayerDeviceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    Next next{.instance = instance, .device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr};
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const Next above = nextOf(instances, keyOf(physical));
    const auto call = reinterpret_cast<PFN_vkCreateDevice>(instance(above.handle, "vkCreateDevice"));
    const VkResult result = call(physical, create, allocator, device);
    if (result != VK_SUCCESS) return result;
    next.owner = *device;
    const std::optional<std::string> said = loss();
    const std::lock_guard lock(mutex);
    if (said && !said->empty() && ++madeUnder[*said] > std::atoi(said->c_str())) next.sparedBy = said;
    devices[keyOf(*device)] = next;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                      VkFence fence) {
    if (isStruck("vkQueueSubmit")) return strike();
    if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
    return down<PFN_vkQueueSubmit>(queue, "vkQueueSubmit")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitIdle(VkQueue queue) {
    if (isStruck("vkQueueWaitIdle")) return strike();
    const VkResult result = down<PFN_vkQueueWaitIdle>(queue, "vkQueueWaitIdle")(queue);
    return isLost(queue) ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, std::uint32_t count, const VkFence* fences,
                                             VkBool32 all, std::uint64_t timeout) {
    if (isStruck("vkWaitForFences")) return strike();
    if (isLost(device)) return VK_ERROR_DEVICE_LOST;
    return down<PFN_vkWaitForFences>(device, "vkWaitForFences")(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL waitSemaphores(VkDevice device, const VkSemaphoreWaitInfo* info,
                                              std::uint64_t timeout) {
    if (isStruck("vkWaitSemaphores")) return strike();
    if (isLost(device)) return VK_ERROR_DEVICE_LOST;
    return down<PFN_vkWaitSemaphores>(device, "vkWaitSemaphores")(device, info, timeout);
}

// The wrapper of a device function, identified by its number.
template <int Number, typename Function> struct Fallible;
template <int Number, typename Handle, typename... Rest>
struct Fallible<Number, VkResult(VKAPI_PTR*)(Handle, Rest...)> {
    static inline const char* name = nullptr;
    static VkResult VKAPI_CALL call(Handle handle, Rest... rest) {
        if (isStruck(name)) return strike();
        return down<VkResult(VKAPI_PTR*)(Handle, Rest...)>(handle, name)(handle, rest...);
    }
    static PFN_vkVoidFunction named(const char* known) {
        name = known;
        return reinterpret_cast<PFN_vkVoidFunction>(call);
    }
};

#define FALLIBLE(name)                                                                                       \
    { #name, Fallible < __COUNTER__, PFN_##name> ::named(#name) }
const std::map<std::string, PFN_vkVoidFunction> fallible{
    FALLIBLE(vkAcquireNextImageKHR),
    FALLIBLE(vkAllocateCommandBuffers),
    FALLIBLE(vkAllocateDescriptorSets),
    FALLIBLE(vkAllocateMemory),
    FALLIBLE(vkBeginCommandBuffer),
    FALLIBLE(vkBindBufferMemory),
    FALLIBLE(vkBindImageMemory),
    FALLIBLE(vkCreateBuffer),
    FALLIBLE(vkCreateBufferView),
    FALLIBLE(vkCreateCommandPool),
    FALLIBLE(vkCreateComputePipelines),
    FALLIBLE(vkCreateDescriptorPool),
    FALLIBLE(vkCreateDescriptorSetLayout),
    FALLIBLE(vkCreateFence),
    FALLIBLE(vkCreateFramebuffer),
    FALLIBLE(vkCreateGraphicsPipelines),
    FALLIBLE(vkCreateImage),
    FALLIBLE(vkCreateImageView),
    FALLIBLE(vkCreatePipelineCache),
    FALLIBLE(vkCreatePipelineLayout),
    FALLIBLE(vkCreateQueryPool),
    FALLIBLE(vkCreateRenderPass),
    FALLIBLE(vkCreateSampler),
    FALLIBLE(vkCreateSemaphore),
    FALLIBLE(vkCreateShaderModule),
    FALLIBLE(vkCreateSwapchainKHR),
    FALLIBLE(vkEndCommandBuffer),
    FALLIBLE(vkFlushMappedMemoryRanges),
    FALLIBLE(vkGetFenceStatus),
    FALLIBLE(vkGetSemaphoreCounterValue),
    FALLIBLE(vkGetSwapchainImagesKHR),
    FALLIBLE(vkInvalidateMappedMemoryRanges),
    FALLIBLE(vkMapMemory),
    FALLIBLE(vkQueuePresentKHR),
    FALLIBLE(vkResetFences),
};

PFN_vkVoidFunction own(const char* name) {
    const auto is = [name](const char* other) { return std::strcmp(name, other) == 0; };
    if (is("vkCreateInstance")) return reinterpret_cast<PFN_vkVoidFunction>(createInstance);
    if (is("vkCreateDevice")) return reinterpret_cast<PFN_vkVoidFunction>(createDevice);
    if (is("vkQueueSubmit")) return reinterpret_cast<PFN_vkVoidFunction>(submit);
    if (is("vkQueueWaitIdle")) return reinterpret_cast<PFN_vkVoidFunction>(waitIdle);
    if (is("vkWaitForFences")) return reinterpret_cast<PFN_vkVoidFunction>(waitForFences);
    if (is("vkWaitSemaphores")) return reinterpret_cast<PFN_vkVoidFunction>(waitSemaphores);
    const auto found = fallible.find(name);
    return found == fallible.end() ? nullptr : found->second;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    if (const PFN_vkVoidFunction function = own(name)) return function;
    return nextOf(devices, keyOf(device)).device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
    if (const PFN_vkVoidFunction function = own(name)) return function;
    return instance == VK_NULL_HANDLE ? nullptr : nextOf(instances, keyOf(instance)).instance(instance, name);
}

} // namespace

extern "C" VK_LAYER_EXPORT VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
    versions->loaderLayerInterfaceVersion = 2;
    versions->pfnGetInstanceProcAddr = getInstanceProcAddr;
    versions->pfnGetDeviceProcAddr = getDeviceProcAddr;
    versions->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
