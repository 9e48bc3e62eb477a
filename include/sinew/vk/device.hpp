// A Vulkan device for compute: borrowed from a host engine, or created for our own programs.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/functions.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace sinew::vk {

class Allocator;
class KernelStore;

/// Memory for a buffer. `device`: fastest for kernels. `upload`: the host writes, kernels or copies read.
/// `readback`: kernels or copies write, the host reads. The last two are mapped for their whole life.
enum class MemoryKind { device, upload, readback };

/// A buffer with its memory range, as returned by the allocator.
struct SINEW_API BufferAllocation {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::byte* mapped = nullptr; ///< null for MemoryKind::device unless the memory happens to be host visible
    std::uint64_t token = 0;     ///< for the allocator's own use
    /// Null if `mapped` is null or host coherent. Else the memory behind `mapped`, which Sinew flushes and
    /// invalidates: all of it is mapped, the buffer begins at `memoryOffset`, a multiple of
    /// nonCoherentAtomSize, and no other buffer shares its last atom.
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize memoryOffset = 0, memorySize = 0; ///< [B]
};

/// The two functions that a host may replace. `create` gets a complete VkBufferCreateInfo and a kind and
/// returns a bound buffer, or throws vk::Error. Both are called at set-up and tear-down only, from the
/// calling thread, one call at a time. Mapped memory that is not host coherent must be named
/// (BufferAllocation::memory): else neither side sees what the other writes.
struct SINEW_API BufferHook {
    std::function<BufferAllocation(const VkBufferCreateInfo&, MemoryKind, const char* name)> create{};
    std::function<void(const BufferAllocation&)> destroy{};
};

/// Handles created by a host engine. They must outlive the Device; Sinew destroys none of them.
struct SINEW_API HostDevice {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t apiVersion = VK_API_VERSION_1_2; ///< that the host requested, not the driver's maximum
    std::uint32_t queueFamily = 0; ///< family to which recorded steps are submitted; needs compute
    std::span<const char* const>
        enabledInstanceExtensions{}; ///< must contain VK_EXT_debug_utils for names and labels
    BufferHook buffers{};            ///< both empty = Sinew's block allocator
    /// Pipelines of an earlier run (Device::pipelineCacheData()); empty = none. Read during borrow() only.
    /// Bytes of another device or driver, or damaged ones, are ignored.
    std::span<const std::byte> pipelineCache{};
    /// Host memory of the driver for every Vulkan object that Sinew makes: each vkCreate, vkAllocate,
    /// vkDestroy and vkFree gets a copy of it. Null = the driver's own. The functions are called
    /// from several threads at once, must not call Sinew, and outlive the device. Sinew's own objects come
    /// from operator new.
    const VkAllocationCallbacks* allocation = nullptr;
};

/// Device request of a program without an engine.
struct SINEW_API DeviceRequest {
    std::string device{};       ///< index as printed by `sinew devices`, or part of a name; empty = best
    bool hasValidation = false; ///< VK_LAYER_KHRONOS_validation: core, synchronisation, queue submit
    std::vector<std::string> instanceExtensions{},
        deviceExtensions{}; ///< required (for a window); missing = Error(noDevice)
    /// True if a queue family of a device is suitable beyond graphics + compute (a window requires present
    /// support).
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t family)> canUseFamily{};
    /// Receives each validation message at once, including those of the device's destruction (leaks). Called
    /// from within Vulkan calls, in their thread; must not throw or call Vulkan.
    std::function<void(const std::string&)> onValidationMessage{};
    std::span<const std::byte> pipelineCache{}; ///< as HostDevice::pipelineCache, read during create() only
    const VkAllocationCallbacks* allocation =
        nullptr; ///< as HostDevice::allocation; of instance and device too
};

/// Largest number of storage buffers that a kernel binds. Vulkan guarantees only 4: a device with fewer than
/// these rejects scenes whose kernels need more (vk::Kernel).
inline constexpr std::uint32_t mostStorageBuffers = 16;

/// Description of a physical device, for `sinew devices`.
struct SINEW_API DeviceDescription {
    std::uint32_t index = 0;
    std::string name{}, driver{},
        type{}; ///< type: "discrete GPU", "integrated GPU", "virtual GPU", "software"
    std::uint32_t apiVersion = 0;
    std::vector<std::string> missing{}; ///< sentences about what it lacks; empty = usable
    std::uint32_t storageBuffers = 0;   ///< that a kernel may bind; the core needs up to mostStorageBuffers
    bool isChosen = false;              ///< `create` would choose it for this request
    /// Identity of the device and its driver's version and build: while it stays the same, pipelines and
    /// measured times of an earlier run apply. Hexadecimal digits.
    std::string identity{};
};

/// Limits of the device that the core checks, read once.
struct SINEW_API Limits {
    VkDeviceSize maxStorageBufferRange = 0; ///< [B]
    std::uint32_t maxStorageBuffersPerStage = 0;
    std::uint32_t maxTexels = 0;     ///< elements of a texel buffer
    std::uint32_t maxGroupCount = 0; ///< in x
    std::uint32_t maxGroupInvocations = 0, maxGroupSizeX = 0;
    std::uint32_t maxPushConstants = 0, maxSharedMemory = 0;                                ///< [B]
    VkDeviceSize storageBufferAlignment = 0, texelBufferAlignment = 0, nonCoherentAtom = 0; ///< [B]
    float timestampPeriod = 0; ///< [ns per tick]; 0 = the family has no timestamps
    std::uint32_t timestampBits = 0;
};

/// A handle in the form for VkDebugUtilsObjectNameInfoEXT and Device::name.
template <typename Handle> std::uint64_t handleValue(Handle handle) noexcept {
    if constexpr (std::is_pointer_v<Handle>)
        return reinterpret_cast<std::uintptr_t>(handle);
    else
        return handle;
}

/// Owns (create) or borrows a VkDevice, with its function tables, its allocator and its kernels. Any thread
/// may use allocator and kernels; the rest is not thread safe. Different devices are independent. Movable:
/// objects made with it, including a Simulation and a Queue, refer to parts with a fixed address
/// (anchored()), and must be destroyed before it. A Device that was moved from may only be assigned or
/// destroyed.
class SINEW_API Device {
public:
    /// Makes an instance and a device through the loader's entry point (vk::Loader opens one). Prefers a GPU
    /// to a software device. Mapped buffers are host coherent. Throws Error(noDevice) with what is missing.
    static Device create(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const DeviceRequest& request);

    /// Uses handles of a host: creates no device, uses no queue, links no loader, needs no enabled feature.
    /// Throws Error(noDevice) if the device lacks what Sinew needs, Error(misuse) on a null handle.
    static Device borrow(const HostDevice& host);

    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    VkInstance instance() const noexcept;
    VkPhysicalDevice physical() const noexcept;
    VkDevice handle() const noexcept;
    std::uint32_t queueFamily() const noexcept;
    VkQueueFlags
    queueFlags() const noexcept; ///< family flags: determine the pipeline stages that a barrier may name
    PFN_vkGetInstanceProcAddr getInstanceProcAddr() const noexcept;
    const InstanceFunctions& instanceFunctions() const noexcept;
    const DeviceFunctions& functions() const noexcept;
    const Limits& limits() const noexcept;
    const DeviceDescription& description() const noexcept; ///< the index is 0 for a borrowed device
    Allocator& allocator() const noexcept;
    KernelStore& kernels() const noexcept;
    VkPipelineCache pipelineCache() const noexcept;
    /// The pipelines made so far, for HostDevice::pipelineCache of a later run on the same device and driver.
    /// Any thread. Throws Error.
    std::vector<std::byte> pipelineCacheData() const;
    /// Begins anew with the pipelines of an earlier run, as DeviceRequest::pipelineCache does, for programs
    /// that find these by description(). Before any pipeline is made. Throws Error.
    void usePipelines(std::span<const std::byte> kept);
    /// The same device at an address that stays valid when this one is moved: for objects that keep a
    /// reference.
    const Device& anchored() const noexcept;

    /// Names an object for validation messages and captures; does nothing without VK_EXT_debug_utils.
    void name(VkObjectType type, std::uint64_t handle, const std::string& name) const noexcept;

    /// Validation messages (warnings and errors) seen since the device was created; empty without validation.
    std::vector<std::string> validationMessages() const;

private:
    struct SINEW_LOCAL State;
    struct SINEW_LOCAL Release { // anchored() refers to the state without owning it
        bool isOwner;
        void operator()(State* state) const noexcept;
    };
    using Handle = std::unique_ptr<State, Release>;
    explicit Device(Handle state);
    static Device make();
    void complete(bool hasDebugUtils, const BufferHook& hook, std::span<const std::byte> pipelines);
    Handle state_;
};

/// Describes every physical device, with what it lacks. Throws Error(noDevice) if there is no loader or
/// driver.
SINEW_API std::vector<DeviceDescription> listDevices(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                                     const DeviceRequest& request);

} // namespace sinew::vk
