// A Vulkan device to compute on: borrowed from a host engine, or created for our own programs.
#pragma once

#include "vk/functions.hpp"

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

/// Where a buffer should live. `device`: fastest for kernels. `upload`: host writes, kernels or copies read.
/// `readback`: kernels or copies write, the host reads. The last two are mapped for their whole life.
enum class MemoryKind { device, upload, readback };

/// A buffer with its own memory range, as the allocator hands it out.
struct BufferAllocation {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::byte* mapped = nullptr; ///< null for MemoryKind::device unless the memory happens to be host visible
    std::uint64_t token = 0;     ///< the allocator's own mark
    /// Null where `mapped` is null or host coherent. Else the memory behind `mapped`, which Sinew flushes and
    /// invalidates: the whole of it is mapped, the buffer begins at `memoryOffset`, a multiple of
    /// nonCoherentAtomSize, and no other buffer shares its last atom.
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize memoryOffset = 0, memorySize = 0; ///< [B]
};

/// The two functions a host may replace. `create` gets a complete VkBufferCreateInfo and a kind and returns a
/// bound buffer, or throws vk::Error. Both are called at set-up and tear-down only, from the thread that does
/// so, one call at a time. Mapped memory that is not host coherent must be named
/// (BufferAllocation::memory): else neither side sees what the other writes.
struct BufferHook {
    std::function<BufferAllocation(const VkBufferCreateInfo&, MemoryKind, const char* name)> create{};
    std::function<void(const BufferAllocation&)> destroy{};
};

/// Handles a host engine made. Everything must outlive the Device; nothing here is destroyed by Sinew.
struct HostDevice {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t apiVersion = VK_API_VERSION_1_2; ///< what the host asked for, not the driver's maximum
    std::uint32_t queueFamily = 0; ///< where the recorded steps will be submitted; needs compute
    std::span<const char* const>
        enabledInstanceExtensions; ///< names and labels need VK_EXT_debug_utils in here
    BufferHook buffers{};          ///< both empty = Sinew's block allocator
};

/// What a program without an engine asks of its device.
struct DeviceRequest {
    std::string device{};       ///< index as `sinew devices` prints it, or part of a name; empty = best
    bool hasValidation = false; ///< VK_LAYER_KHRONOS_validation: core, synchronisation, queue submit
    std::vector<std::string> instanceExtensions,
        deviceExtensions; ///< required (a window's); missing = Error(noDevice)
    /// Says whether a queue family of a device will do beyond graphics + compute (a window asks for present
    /// support).
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t family)> canUseFamily{};
    /// Gets each validation message as it comes, those of the device's destruction (leaks) included. Called
    /// from within Vulkan calls, in their thread; must not throw or call Vulkan.
    std::function<void(const std::string&)> onValidationMessage{};
};

/// Storage buffers of the kernel that binds most of them. Vulkan promises 4: with fewer than these, scenes
/// are refused whose kernels need more (vk::Kernel).
inline constexpr std::uint32_t mostStorageBuffers = 16;

/// One physical device in the words of `sinew devices`.
struct DeviceDescription {
    std::uint32_t index = 0;
    std::string name{}, driver{},
        type{}; ///< type: "discrete GPU", "integrated GPU", "virtual GPU", "software"
    std::uint32_t apiVersion = 0;
    std::vector<std::string> missing{}; ///< sentences; empty = usable
    std::uint32_t storageBuffers = 0;   ///< that a kernel may bind; the core's bind up to mostStorageBuffers
    bool isChosen = false;              ///< the one `create` would take for this request
};

/// Limits the core checks against, read once.
struct Limits {
    VkDeviceSize maxStorageBufferRange = 0; ///< [B]
    std::uint32_t maxStorageBuffersPerStage = 0;
    std::uint32_t maxTexels = 0;     ///< elements of a texel buffer
    std::uint32_t maxGroupCount = 0; ///< in x
    std::uint32_t maxGroupInvocations = 0, maxGroupSizeX = 0;
    std::uint32_t maxPushConstants = 0, maxSharedMemory = 0;                                ///< [B]
    VkDeviceSize storageBufferAlignment = 0, texelBufferAlignment = 0, nonCoherentAtom = 0; ///< [B]
    float timestampPeriod = 0; ///< [ns per tick]; 0 = the family writes none
    std::uint32_t timestampBits = 0;
};

/// A handle as VkDebugUtilsObjectNameInfoEXT and Device::name take it.
template <typename Handle> std::uint64_t handleValue(Handle handle) noexcept {
    if constexpr (std::is_pointer_v<Handle>)
        return reinterpret_cast<std::uintptr_t>(handle);
    else
        return handle;
}

/// Owns (create) or borrows a VkDevice, with its function tables, its allocator and its kernels, which any
/// thread may use; all else is not thread safe. Different devices are independent. Movable: whatever of Sinew
/// was made with it, a Simulation and a Queue too, refers to parts that stay where they are (anchored()). All
/// of that must be gone before it is destroyed. A Device that was moved from may only be assigned or
/// destroyed.
class Device {
public:
    /// Makes an instance and a device through the loader's entry point (vk::Loader opens one). Prefers a real
    /// GPU to a software device. Mapped buffers are host coherent. Throws Error(noDevice) with what it lacks.
    static Device create(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const DeviceRequest& request);

    /// Uses handles a host made: creates no device, touches no queue, links no loader, needs no enabled
    /// feature. Throws Error(noDevice) when the device does not do what Sinew needs, Error(misuse) on a null
    /// handle.
    static Device borrow(const HostDevice& host);

    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    VkInstance instance() const noexcept;
    VkPhysicalDevice physical() const noexcept;
    VkDevice handle() const noexcept;
    std::uint32_t queueFamily() const noexcept;
    VkQueueFlags
    queueFlags() const noexcept; ///< of the family: decides which pipeline stages a barrier may name
    PFN_vkGetInstanceProcAddr getInstanceProcAddr() const noexcept;
    const InstanceFunctions& instanceFunctions() const noexcept;
    const DeviceFunctions& functions() const noexcept;
    const Limits& limits() const noexcept;
    const DeviceDescription& description() const noexcept; ///< of a borrowed device the index is 0
    Allocator& allocator() const noexcept;
    KernelStore& kernels() const noexcept;
    VkPipelineCache pipelineCache() const noexcept;
    /// The same device under an address that stays valid when this one moves: for who keeps a reference.
    const Device& anchored() const noexcept;

    /// Names an object for validation messages and captures; does nothing without VK_EXT_debug_utils.
    void name(VkObjectType type, std::uint64_t handle, const std::string& name) const noexcept;

    /// Validation messages (warnings and errors) seen since the device was created; empty without validation.
    std::vector<std::string> validationMessages() const;

private:
    struct State;
    struct Release { // anchored() refers to the state without owning it
        bool isOwner;
        void operator()(State* state) const noexcept;
    };
    using Handle = std::unique_ptr<State, Release>;
    explicit Device(Handle state);
    static Device make();
    void complete(bool hasDebugUtils, const BufferHook& hook);
    Handle state_;
};

/// Every physical device, with what it lacks. Throws Error(noDevice) when there is no loader or driver.
std::vector<DeviceDescription> listDevices(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                           const DeviceRequest& request);

} // namespace sinew::vk
