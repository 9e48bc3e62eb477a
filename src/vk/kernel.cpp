// Pipelines and descriptor sets, both checked against the reflected interface.
#include "sinew/vk/kernel.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "vk/exact.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace sinew::vk {

namespace {

void checkLimit(const std::string& kernel, const char* what, std::uint64_t need, std::uint64_t limit) {
    if (need > limit)
        throw Error(Failure::noDevice, "kernel " + kernel + " needs " + std::to_string(need) + " " + what +
                                           ", the device has " + std::to_string(limit));
}

void checkLimits(const KernelInterface& interface, const std::string& name, const Limits& limits) {
    const auto& size = interface.groupSize;
    const auto storage = std::count_if(interface.bindings.begin(), interface.bindings.end(),
                                       [](const auto& b) { return b.kind == BlockKind::storage; });
    checkLimit(name, "storage buffers", static_cast<std::uint64_t>(storage),
               limits.maxStorageBuffersPerStage);
    checkLimit(name, "bytes of push constants", interface.pushConstantSize, limits.maxPushConstants);
    checkLimit(name, "bytes of shared memory", interface.sharedMemory, limits.maxSharedMemory);
    checkLimit(name, "invocations along x in a group", size[0], limits.maxGroupSizeX);
    checkLimit(name, "invocations in a group", std::uint64_t{size[0]} * size[1] * size[2],
               limits.maxGroupInvocations);
}

void checkConstants(const KernelInterface& interface, const std::string& name,
                    std::span<const SpecialisationConstant> constants) {
    const auto& ids = interface.specialisationIds;
    for (const SpecialisationConstant& constant : constants)
        if (!std::binary_search(ids.begin(), ids.end(), constant.id))
            throw Error(Failure::misuse,
                        "kernel " + name + " has no specialisation constant " + std::to_string(constant.id));
}

VkDescriptorType descriptorType(const KernelBinding& binding) {
    switch (binding.kind) {
    case BlockKind::uniform:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BlockKind::texels:
        return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    case BlockKind::storage:
        break;
    }
    return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

/// Formats that every device can fetch from a texel buffer.
VkFormat texelFormat(bool isFloat, std::uint32_t stride) {
    switch (stride) {
    case 4:
        return isFloat ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32_UINT;
    case 8:
        return isFloat ? VK_FORMAT_R32G32_SFLOAT : VK_FORMAT_R32G32_UINT;
    default:
        return isFloat ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32B32A32_UINT;
    }
}

VkDescriptorSetLayout createSetLayout(VkDevice device, const DeviceFunctions& functions,
                                      const KernelInterface& interface, const std::string& name) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const KernelBinding& binding : interface.bindings)
        bindings.push_back({.binding = binding.binding,
                            .descriptorType = descriptorType(binding),
                            .descriptorCount = 1,
                            .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                               .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(functions.vkCreateDescriptorSetLayout(device, &info, functions.allocation, &layout),
          "vkCreateDescriptorSetLayout", name);
    return layout;
}

VkPipelineLayout createLayout(VkDevice device, const DeviceFunctions& functions,
                              VkDescriptorSetLayout setLayout, std::uint32_t pushConstantSize,
                              const std::string& name) {
    const VkPushConstantRange range{.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = pushConstantSize};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &setLayout,
                                          .pushConstantRangeCount = pushConstantSize > 0 ? 1u : 0u,
                                          .pPushConstantRanges = &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(functions.vkCreatePipelineLayout(device, &info, functions.allocation, &layout),
          "vkCreatePipelineLayout", name);
    return layout;
}

VkPipeline createPipeline(const Device& device, const ShaderCode& code, VkPipelineLayout layout,
                          std::span<const SpecialisationConstant> constants) {
    std::vector<VkSpecializationMapEntry> entries;
    for (const SpecialisationConstant& constant : constants)
        entries.push_back({constant.id,
                           static_cast<std::uint32_t>(entries.size() * sizeof(SpecialisationConstant) +
                                                      offsetof(SpecialisationConstant, value)),
                           sizeof(constant.value)});
    const VkSpecializationInfo specialisation{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                              .pMapEntries = entries.data(),
                                              .dataSize = constants.size_bytes(),
                                              .pData = constants.data()};
    const std::vector<std::uint32_t> exact = withoutContraction(code.words);
    const VkShaderModuleCreateInfo moduleInfo{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                              .codeSize = exact.size() * sizeof(std::uint32_t),
                                              .pCode = exact.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(device.functions().vkCreateShaderModule(device.handle(), &moduleInfo, device.functions().allocation,
                                                  &module),
          "vkCreateShaderModule", code.name);
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = &specialisation},
        .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = device.functions().vkCreateComputePipelines(
        device.handle(), device.pipelineCache(), 1, &info, device.functions().allocation, &pipeline);
    device.functions().vkDestroyShaderModule(device.handle(), module, device.functions().allocation);
    check(result, "vkCreateComputePipelines", code.name);
    return pipeline;
}

} // namespace

Kernel::Kernel(const Device& device, const ShaderCode& code,
               std::span<const SpecialisationConstant> constants)
    : device_(device.handle()), functions_(&device.functions()), name_(code.name) {
    const std::vector<std::uint32_t> words = wordsOf(code);
    const ShaderCode unpacked{name_.c_str(), words};
    interface_ = readInterface(unpacked, constants);
    checkConstants(interface_, name_, constants);
    checkLimits(interface_, name_, device.limits());
    try {
        create(device, unpacked, constants);
    } catch (...) {
        release();
        throw;
    }
}

void Kernel::create(const Device& device, const ShaderCode& code,
                    std::span<const SpecialisationConstant> constants) {
    setLayout_ = createSetLayout(device_, *functions_, interface_, name_);
    device.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, handleValue(setLayout_), name_);
    layout_ = createLayout(device_, *functions_, setLayout_, interface_.pushConstantSize, name_);
    device.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, handleValue(layout_), name_);
    pipeline_ = createPipeline(device, code, layout_, constants);
    device.kernels().countPipeline();
    device.name(VK_OBJECT_TYPE_PIPELINE, handleValue(pipeline_), name_);
}

Kernel::Kernel(Kernel&& other) noexcept
    : device_(other.device_), functions_(other.functions_), interface_(std::move(other.interface_)),
      name_(std::move(other.name_)), setLayout_(std::exchange(other.setLayout_, VK_NULL_HANDLE)),
      layout_(std::exchange(other.layout_, VK_NULL_HANDLE)),
      pipeline_(std::exchange(other.pipeline_, VK_NULL_HANDLE)) {}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(functions_, other.functions_);
    std::swap(interface_, other.interface_);
    std::swap(name_, other.name_);
    std::swap(setLayout_, other.setLayout_);
    std::swap(layout_, other.layout_);
    std::swap(pipeline_, other.pipeline_);
    return *this;
}

Kernel::~Kernel() {
    release();
}

void Kernel::release() noexcept {
    functions_->vkDestroyPipeline(device_, pipeline_, functions_->allocation);
    functions_->vkDestroyPipelineLayout(device_, layout_, functions_->allocation);
    functions_->vkDestroyDescriptorSetLayout(device_, setLayout_, functions_->allocation);
}

namespace {

void checkView(const Kernel& kernel, const KernelBinding& binding, const BufferView& view,
               const Limits& limits) {
    const std::string where = "kernel " + kernel.name() + ": binding " + std::to_string(binding.binding) +
                              " (" + binding.name + ")";
    if (view.buffer == VK_NULL_HANDLE || view.size == 0)
        throw Error(Failure::misuse, where + ": no buffer is bound");
    const bool isTexels = binding.kind == BlockKind::texels;
    if (view.stride != BufferView::anyStride && !binding.takes(view.stride))
        throw Error(
            Failure::misuse,
            where + ": the buffer's stride is " + std::to_string(view.stride) + " bytes, the kernel's is " +
                (isTexels ? std::string("4, 8 or a multiple of 16") : std::to_string(binding.stride)));
    const VkDeviceSize alignment = isTexels ? limits.texelBufferAlignment : limits.storageBufferAlignment;
    if (view.offset % alignment != 0)
        throw Error(Failure::misuse, where + ": the offset " + std::to_string(view.offset) +
                                         " is no multiple of the device's " + std::to_string(alignment) +
                                         " bytes");
    const std::uint64_t texels = isTexels && view.stride != BufferView::anyStride
                                     ? KernelBinding::texelsIn(view.size, view.stride)
                                     : 0;
    if (texels > limits.maxTexels)
        throw Error(Failure::outOfMemory, where + ": " + std::to_string(texels) +
                                              " elements exceed the device's maxTexelBufferElements of " +
                                              std::to_string(limits.maxTexels));
    if (view.size > limits.maxStorageBufferRange)
        throw Error(Failure::outOfMemory, where + ": " + std::to_string(view.size) +
                                              " bytes exceed the device's maxStorageBufferRange of " +
                                              std::to_string(limits.maxStorageBufferRange) + " bytes");
}

void checkRequests(std::span<const BindingRequest> requests, const Limits& limits) {
    for (const BindingRequest& request : requests) {
        const auto& bindings = request.kernel->interface().bindings;
        if (request.buffers.size() != bindings.size())
            throw Error(Failure::misuse, "kernel " + request.kernel->name() + " has " +
                                             std::to_string(bindings.size()) + " bindings, but gets " +
                                             std::to_string(request.buffers.size()) + " buffers");
        for (std::size_t i = 0; i < bindings.size(); ++i)
            checkView(*request.kernel, bindings[i], request.buffers[i], limits);
    }
}

VkDescriptorPool createPool(const Device& device, std::span<const BindingRequest> requests) {
    std::map<VkDescriptorType, std::uint32_t> counts;
    for (const BindingRequest& request : requests)
        for (const KernelBinding& binding : request.kernel->interface().bindings)
            ++counts[descriptorType(binding)];
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) sizes.push_back({type, count});
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = static_cast<std::uint32_t>(requests.size()),
                                          .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                          .pPoolSizes = sizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device.functions().vkCreateDescriptorPool(device.handle(), &info, device.functions().allocation,
                                                    &pool),
          "vkCreateDescriptorPool", "the binding sets");
    return pool;
}

} // namespace

VkBufferView BindingSets::createTexels(const BufferView& view, const KernelBinding& binding,
                                       const Device& device) {
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = view.buffer,
                                      .format = texelFormat(binding.isFloat, view.stride),
                                      .offset = view.offset,
                                      .range = view.size};
    VkBufferView texels = VK_NULL_HANDLE;
    check(functions_->vkCreateBufferView(device_, &info, functions_->allocation, &texels),
          "vkCreateBufferView", binding.name);
    texels_.push_back(texels);
    device.name(VK_OBJECT_TYPE_BUFFER_VIEW, handleValue(texels), binding.name);
    return texels;
}

void BindingSets::write(const Device& device, VkDescriptorSet set, const BindingRequest& request) {
    const auto& bindings = request.kernel->interface().bindings;
    std::vector<VkDescriptorBufferInfo> infos;
    std::vector<VkBufferView> texels(bindings.size(), VK_NULL_HANDLE);
    for (const BufferView& view : request.buffers) infos.push_back({view.buffer, view.offset, view.size});
    std::vector<VkWriteDescriptorSet> writes;
    for (std::size_t b = 0; b < bindings.size(); ++b) {
        const KernelBinding& binding = bindings[b];
        const bool isTexels = binding.kind == BlockKind::texels;
        if (isTexels) texels[b] = createTexels(request.buffers[b], binding, device);
        writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                          .dstSet = set,
                          .dstBinding = binding.binding,
                          .descriptorCount = 1,
                          .descriptorType = descriptorType(binding),
                          .pBufferInfo = isTexels ? nullptr : &infos[b],
                          .pTexelBufferView = isTexels ? &texels[b] : nullptr});
    }
    functions_->vkUpdateDescriptorSets(device_, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                       nullptr);
}

BindingSets::BindingSets(const Device& device, std::span<const BindingRequest> requests)
    : device_(device.handle()), functions_(&device.functions()), sets_(requests.size(), VK_NULL_HANDLE) {
    checkRequests(requests, device.limits());
    if (requests.empty()) return;
    std::vector<VkDescriptorSetLayout> layouts;
    for (const BindingRequest& request : requests) layouts.push_back(request.kernel->setLayout());
    pool_ = createPool(device, requests);
    device.name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, handleValue(pool_), "sinew.bindings");
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = static_cast<std::uint32_t>(layouts.size()),
                                           .pSetLayouts = layouts.data()};
    const VkResult result = functions_->vkAllocateDescriptorSets(device_, &info, sets_.data());
    if (result < 0) release();
    check(result, "vkAllocateDescriptorSets", "the binding sets");
    try {
        for (std::size_t i = 0; i < requests.size(); ++i) {
            device.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleValue(sets_[i]), requests[i].kernel->name());
            write(device, sets_[i], requests[i]);
        }
    } catch (...) {
        release();
        throw;
    }
}

BindingSets::BindingSets(BindingSets&& other) noexcept
    : device_(other.device_), functions_(other.functions_), pool_(std::exchange(other.pool_, VK_NULL_HANDLE)),
      sets_(std::move(other.sets_)), texels_(std::exchange(other.texels_, {})) {}

BindingSets& BindingSets::operator=(BindingSets&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(functions_, other.functions_);
    std::swap(pool_, other.pool_);
    std::swap(sets_, other.sets_);
    std::swap(texels_, other.texels_);
    return *this;
}

BindingSets::~BindingSets() {
    release();
}

void BindingSets::release() noexcept {
    for (const VkBufferView texels : texels_)
        functions_->vkDestroyBufferView(device_, texels, functions_->allocation);
    functions_->vkDestroyDescriptorPool(device_, pool_, functions_->allocation);
}

} // namespace sinew::vk
