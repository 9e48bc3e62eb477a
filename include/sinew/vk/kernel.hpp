// A compute pipeline with the interface read from its SPIR-V, and the descriptor sets that bind buffers to
// it.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/buffer.hpp"
#include "sinew/vk/spirv.hpp"

#pragma push_macro("interface") // windows.h defines it
#undef interface

namespace sinew::vk {

/// Creates its pipeline at construction. Movable. Must not outlive its Device, which may be moved meanwhile.
class SINEW_API Kernel {
public:
    /// Throws Error(noDevice) if the device's limits are below the kernel's needs (bindings, group size, push
    /// constants, shared memory), with both figures; Error(misuse) on a specialisation id that the kernel
    /// lacks; std::runtime_error as readInterface does.
    Kernel(const Device& device, const ShaderCode& code, std::span<const SpecialisationConstant> constants);
    Kernel(Kernel&& other) noexcept;
    Kernel& operator=(Kernel&& other) noexcept;
    ~Kernel();

    /// The group size is that with the given constants.
    const KernelInterface& interface() const noexcept { return interface_; }
    VkPipeline pipeline() const noexcept { return pipeline_; }
    VkPipelineLayout layout() const noexcept { return layout_; }
    VkDescriptorSetLayout setLayout() const noexcept { return setLayout_; }
    const std::string& name() const noexcept { return name_; }

private:
    void create(const Device& device, const ShaderCode& code,
                std::span<const SpecialisationConstant> constants);
    void release() noexcept;
    VkDevice device_ = VK_NULL_HANDLE;
    const DeviceFunctions* functions_ = nullptr;
    KernelInterface interface_;
    std::string name_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// The buffers of one dispatch, in binding order.
struct SINEW_API BindingRequest {
    const Kernel* kernel = nullptr;
    std::vector<BufferView> buffers{};
};

/// A descriptor pool made once for a known list of requests; sets are written at construction and never
/// again.
class SINEW_API BindingSets {
public:
    /// Throws Error(misuse) with kernel and binding if a count, a stride or an offset's alignment disagrees,
    /// Error(outOfMemory) if a range exceeds maxStorageBufferRange or maxTexelBufferElements.
    BindingSets(const Device& device, std::span<const BindingRequest> requests);
    BindingSets(BindingSets&& other) noexcept;
    BindingSets& operator=(BindingSets&& other) noexcept;
    ~BindingSets();

    VkDescriptorSet operator[](std::size_t request) const noexcept { return sets_[request]; }

private:
    void write(const Device& device, VkDescriptorSet set, const BindingRequest& request);
    VkBufferView createTexels(const BufferView& view, const KernelBinding& binding, const Device& device);
    void release() noexcept;
    VkDevice device_ = VK_NULL_HANDLE;
    const DeviceFunctions* functions_ = nullptr;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> sets_;
    std::vector<VkBufferView> texels_; ///< views of all texel bindings
};

} // namespace sinew::vk

#pragma pop_macro("interface")
