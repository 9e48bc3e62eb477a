// What the picture's shaders bind: the numbers of the frame and the light maps, once per picture in flight.
#pragma once

#include "viewer/draw/light_maps.hpp"
#include "viewer/draw/set_layout.hpp"
#include "viewer/frame.h"
#include "vk/buffer.hpp"

namespace sinew::viewer {

/// Owns descriptor sets, the pipeline layout they fit and the buffers of their parameters. Must not outlive
/// its Device, which must not move, nor the maps.
class PictureSets {
public:
    PictureSets(const vk::Device& device, const LightMaps& maps, std::uint32_t slots);

    /// Of every picture pipeline: this set, and layout::SkinPush for fragment shaders.
    VkPipelineLayout layout() const noexcept { return sets_.handle(); }

    /// The picture that last used the slot must be finished.
    void write(std::uint32_t slot, const layout::FrameParams& params) const noexcept;
    /// What a section has counted, where pipelines read it. Likewise.
    void writeCounts(std::uint32_t slot, VkImageView counts, VkSampler sampler) const noexcept;
    /// What stands behind all bodies, likewise.
    void writeBackdrop(std::uint32_t slot, VkImageView backdrop, VkSampler sampler) const noexcept;
    /// A picture that is enlarged, likewise.
    void writeEnlarged(std::uint32_t slot, VkImageView drawn, VkSampler sampler) const noexcept;
    void bind(VkCommandBuffer commands, std::uint32_t slot) const noexcept { sets_.bind(commands, slot); }

private:
    void writeImage(std::uint32_t slot, std::uint32_t binding, VkImageView view,
                    VkSampler sampler) const noexcept;
    void writeSet(std::uint32_t slot, const LightMaps& maps) const;

    const vk::Device& device_;
    SetLayout sets_;
    std::vector<vk::Buffer> params_;
};

} // namespace sinew::viewer
