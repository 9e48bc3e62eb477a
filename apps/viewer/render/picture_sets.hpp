// Descriptor sets of the picture's shaders: frame parameters and light maps, one set per picture in flight.
#pragma once

#include "sinew/vk/buffer.hpp"
#include "viewer/frame.h"
#include "viewer/render/light_maps.hpp"
#include "viewer/render/set_layout.hpp"

namespace sinew::viewer {

/// Owns descriptor sets, the pipeline layout they fit and the buffers of their parameters. Must not outlive
/// its Device, which must not move, nor the maps and `insides` (Insides of inside.glsl).
class PictureSets {
public:
    PictureSets(const vk::Device& device, const LightMaps& maps, const vk::BufferView& insides,
                std::uint32_t slots);

    /// Layout of every picture pipeline: this set, and layout::SkinPush for fragment shaders.
    VkPipelineLayout layout() const noexcept { return sets_.handle(); }

    /// The slot's previous picture must be finished, here and in the functions below.
    void write(std::uint32_t slot, const layout::FrameParams& params) const noexcept;
    /// Binds the image of a section's counts for pipelines that read it.
    void writeCounts(std::uint32_t slot, VkImageView counts, VkSampler sampler) const noexcept;
    /// Binds the image of sky and far floor.
    void writeBackdrop(std::uint32_t slot, VkImageView backdrop, VkSampler sampler) const noexcept;
    /// Binds the small image of an enlarged picture.
    void writeEnlarged(std::uint32_t slot, VkImageView drawn, VkSampler sampler) const noexcept;
    /// Binds the images of surfaces that are seen.
    void writeSurfaces(std::uint32_t slot, VkImageView normals, VkImageView materials,
                       VkSampler sampler) const noexcept;
    void bind(VkCommandBuffer commands, std::uint32_t slot) const noexcept { sets_.bind(commands, slot); }

private:
    void writeImage(std::uint32_t slot, std::uint32_t binding, VkImageView view,
                    VkSampler sampler) const noexcept;
    void writeSet(std::uint32_t slot, const LightMaps& maps) const;
    void writeInsides(std::uint32_t slot, const vk::BufferView& insides) const;

    const vk::Device& device_;
    SetLayout sets_;
    std::vector<vk::Buffer> params_;
};

} // namespace sinew::viewer
