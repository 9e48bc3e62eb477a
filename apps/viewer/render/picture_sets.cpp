// Writes the fixed descriptors once, at construction.
#include "viewer/render/picture_sets.hpp"

#include <array>
#include <cstring>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t mapCount = 4;                          // light.glsl, floor.frag
constexpr std::uint32_t countsBinding = 1 + mapCount;          // section_cap.frag; frame.glsl has the first
constexpr std::uint32_t backdropBinding = countsBinding + 1;   // backdrop.frag
constexpr std::uint32_t enlargedBinding = backdropBinding + 1; // enlarge.frag
constexpr std::uint32_t normalsBinding = enlargedBinding + 1;  // surfaces.frag
constexpr std::uint32_t materialsBinding = normalsBinding + 1; // the same
constexpr std::uint32_t insidesBinding = materialsBinding + 1; // inside.glsl
constexpr std::uint32_t bindingCount = insidesBinding + 1;

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
                                               : binding == insidesBinding
                                                   ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                                   : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                             .descriptorCount = 1,
                             .stageFlags = drawingStages};
    bindings[insidesBinding].stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    return bindings;
}

} // namespace

PictureSets::PictureSets(const vk::Device& device, const LightMaps& maps, const vk::BufferView& insides,
                         std::uint32_t slots)
    : device_(device), sets_(device, "picture", bindings(), sizeof(layout::SkinPush), slots),
      params_(makeParams(device, slots)) {
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
        writeSet(slot, maps);
        writeInsides(slot, insides);
    }
}

void PictureSets::writeSet(std::uint32_t slot, const LightMaps& maps) const {
    constexpr VkImageLayout readable = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkDescriptorBufferInfo params{params_[slot].view().buffer, params_[slot].view().offset,
                                        sizeof(layout::FrameParams)};
    const std::array<VkDescriptorImageInfo, mapCount> images{
        VkDescriptorImageInfo{maps.comparing(), maps.shadow.image.view(), readable},
        VkDescriptorImageInfo{maps.nearest(), maps.shadow.image.view(), readable},
        VkDescriptorImageInfo{maps.nearest(), maps.plan.image.view(), readable},
        VkDescriptorImageInfo{maps.smooth(), maps.floor.image.view(), readable}};
    std::array<VkWriteDescriptorSet, 1 + mapCount> writes{};
    for (std::uint32_t binding = 0; binding < writes.size(); ++binding)
        writes[binding] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                           .dstSet = sets_.set(slot),
                           .dstBinding = binding,
                           .descriptorCount = 1,
                           .descriptorType = binding == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                          : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           .pImageInfo = binding == 0 ? nullptr : &images[binding - 1],
                           .pBufferInfo = binding == 0 ? &params : nullptr};
    device_.functions().vkUpdateDescriptorSets(device_.handle(), writes.size(), writes.data(), 0, nullptr);
}

void PictureSets::writeInsides(std::uint32_t slot, const vk::BufferView& insides) const {
    const VkDescriptorBufferInfo info{insides.buffer, insides.offset, insides.size};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = sets_.set(slot),
                                     .dstBinding = insidesBinding,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                     .pBufferInfo = &info};
    device_.functions().vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void PictureSets::writeCounts(std::uint32_t slot, VkImageView counts, VkSampler sampler) const noexcept {
    writeImage(slot, countsBinding, counts, sampler);
}

void PictureSets::writeBackdrop(std::uint32_t slot, VkImageView backdrop, VkSampler sampler) const noexcept {
    writeImage(slot, backdropBinding, backdrop, sampler);
}

void PictureSets::writeEnlarged(std::uint32_t slot, VkImageView drawn, VkSampler sampler) const noexcept {
    writeImage(slot, enlargedBinding, drawn, sampler);
}

void PictureSets::writeSurfaces(std::uint32_t slot, VkImageView normals, VkImageView materials,
                                VkSampler sampler) const noexcept {
    writeImage(slot, normalsBinding, normals, sampler);
    writeImage(slot, materialsBinding, materials, sampler);
}

void PictureSets::writeImage(std::uint32_t slot, std::uint32_t binding, VkImageView view,
                             VkSampler sampler) const noexcept {
    const VkDescriptorImageInfo image{sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = sets_.set(slot),
                                     .dstBinding = binding,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                     .pImageInfo = &image};
    device_.functions().vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void PictureSets::write(std::uint32_t slot, const layout::FrameParams& params) const noexcept {
    std::memcpy(params_[slot].mapped(), &params, sizeof(params));
}

} // namespace sinew::viewer
