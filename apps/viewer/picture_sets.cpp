// Descriptor sets, written once.
#include "viewer/picture_sets.hpp"

#include "vk/check.hpp"

#include <cstring>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t bindingCount = 5; // frame.glsl, light.glsl, floor.frag
constexpr VkShaderStageFlags drawingStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

std::vector<vk::Buffer> makeParams(const vk::Device& device, std::uint32_t slots) {
    std::vector<vk::Buffer> params;
    for (std::uint32_t slot = 0; slot < slots; ++slot)
        params.emplace_back(device, vk::BufferRequest{.name = "picture.params",
                                                      .count = 1,
                                                      .stride = sizeof(layout::FrameParams),
                                                      .kind = vk::MemoryKind::upload,
                                                      .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT});
    return params;
}

} // namespace

PictureSets::PictureSets(const vk::Device& device, const LightMaps& maps, std::uint32_t slots)
    : device_(device), sets_(slots), params_(makeParams(device, slots)) {
    try {
        createLayouts();
        createSets(maps);
    } catch (...) {
        release();
        throw;
    }
}

PictureSets::~PictureSets() {
    release();
}

void PictureSets::release() noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    functions.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    functions.vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void PictureSets::createLayouts() {
    std::array<VkDescriptorSetLayoutBinding, bindingCount> bindings{};
    for (std::uint32_t binding = 0; binding < bindingCount; ++binding)
        bindings[binding] = {.binding = binding,
                             .descriptorType = binding == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                            : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                             .descriptorCount = 1,
                             .stageFlags = drawingStages};
    const VkDescriptorSetLayoutCreateInfo setInfo{.sType =
                                                      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .bindingCount = bindingCount,
                                                  .pBindings = bindings.data()};
    vk::check(
        device_.functions().vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout", "picture");
    const VkPushConstantRange push{drawingStages, 0, sizeof(layout::SkinPush)};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &setLayout_,
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &push};
    vk::check(device_.functions().vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout_),
              "vkCreatePipelineLayout", "picture");
}

void PictureSets::createSets(const LightMaps& maps) {
    const auto slots = static_cast<std::uint32_t>(sets_.size());
    const std::array sizes{
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, slots},
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, (bindingCount - 1) * slots}};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = slots,
                                          .poolSizeCount = sizes.size(),
                                          .pPoolSizes = sizes.data()};
    vk::check(device_.functions().vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool_),
              "vkCreateDescriptorPool", "picture");
    const std::vector layouts(slots, setLayout_);
    const VkDescriptorSetAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                 .descriptorPool = pool_,
                                                 .descriptorSetCount = slots,
                                                 .pSetLayouts = layouts.data()};
    vk::check(device_.functions().vkAllocateDescriptorSets(device_.handle(), &allocation, sets_.data()),
              "vkAllocateDescriptorSets", "picture");
    for (std::uint32_t slot = 0; slot < slots; ++slot) writeSet(slot, maps);
}

void PictureSets::writeSet(std::uint32_t slot, const LightMaps& maps) const {
    constexpr VkImageLayout readable = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkDescriptorBufferInfo params{params_[slot].view().buffer, params_[slot].view().offset,
                                        sizeof(layout::FrameParams)};
    const std::array<VkDescriptorImageInfo, bindingCount - 1> images{
        VkDescriptorImageInfo{maps.comparing(), maps.shadow.image.view(), readable},
        VkDescriptorImageInfo{maps.nearest(), maps.shadow.image.view(), readable},
        VkDescriptorImageInfo{maps.nearest(), maps.plan.image.view(), readable},
        VkDescriptorImageInfo{maps.smooth(), maps.floor.image.view(), readable}};
    std::array<VkWriteDescriptorSet, bindingCount> writes{};
    for (std::uint32_t binding = 0; binding < bindingCount; ++binding)
        writes[binding] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                           .dstSet = sets_[slot],
                           .dstBinding = binding,
                           .descriptorCount = 1,
                           .descriptorType = binding == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                          : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           .pImageInfo = binding == 0 ? nullptr : &images[binding - 1],
                           .pBufferInfo = binding == 0 ? &params : nullptr};
    device_.functions().vkUpdateDescriptorSets(device_.handle(), bindingCount, writes.data(), 0, nullptr);
}

void PictureSets::write(std::uint32_t slot, const layout::FrameParams& params) const noexcept {
    std::memcpy(params_[slot].mapped(), &params, sizeof(params));
}

void PictureSets::bind(VkCommandBuffer commands, std::uint32_t slot) const noexcept {
    device_.functions().vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1,
                                                &sets_[slot], 0, nullptr);
}

} // namespace sinew::viewer
