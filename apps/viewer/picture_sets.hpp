// What the picture's shaders bind: the numbers of the frame and the light maps, once per picture in flight.
#pragma once

#include "viewer/frame.h"
#include "viewer/light_maps.hpp"
#include "vk/buffer.hpp"

namespace sinew::viewer {

/// Owns descriptor sets, the pipeline layout they fit and the buffers of their parameters. Must not outlive
/// its Device, which must not move, nor the maps.
class PictureSets {
public:
    PictureSets(const vk::Device& device, const LightMaps& maps, std::uint32_t slots);
    PictureSets(const PictureSets&) = delete;
    PictureSets& operator=(const PictureSets&) = delete;
    ~PictureSets();

    /// Of every picture pipeline: this set, and layout::SkinPush for fragment shaders.
    VkPipelineLayout layout() const noexcept { return layout_; }

    /// The picture that last used the slot must be finished.
    void write(std::uint32_t slot, const layout::FrameParams& params) const noexcept;
    void bind(VkCommandBuffer commands, std::uint32_t slot) const noexcept;

private:
    void createLayouts();
    void createSets(const LightMaps& maps);
    void writeSet(std::uint32_t slot, const LightMaps& maps) const;
    void release() noexcept;

    const vk::Device& device_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> sets_;
    std::vector<vk::Buffer> params_;
};

} // namespace sinew::viewer
