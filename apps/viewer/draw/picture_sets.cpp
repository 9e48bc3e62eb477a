// Written once.
#include "viewer/draw/picture_sets.hpp"

#include <array>
#include <cstring>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t bindingCount = 5; // frame.glsl, light.glsl, floor.frag

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

std::array<VkDescriptorSetLayoutBinding, bindingCount> bindings() {
    std::array<VkDescriptorSetLayoutBinding, bindingCount> bindings{};
    for (std::uint32_t binding = 0; binding < bindingCount; ++binding)
        bindings[binding] = {.binding = binding,
                             .descriptorType = binding == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                            : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                             .descriptorCount = 1,
                             .stageFlags = drawingStages};
    return bindings;
}

} // namespace

PictureSets::PictureSets(const vk::Device& device, const LightMaps& maps, std::uint32_t slots)
    : device_(device), sets_(device, "picture", bindings(), sizeof(layout::SkinPush), slots),
      params_(makeParams(device, slots)) {
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
                           .dstSet = sets_.set(slot),
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

} // namespace sinew::viewer
