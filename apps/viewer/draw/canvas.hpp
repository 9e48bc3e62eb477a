// The multisampled colour and depth images behind one or more pictures of a size, and a framebuffer per
// picture.
#pragma once

#include "viewer/draw/render_pass.hpp"

namespace sinew::viewer {

struct CanvasFormat {
    VkFormat color = VK_FORMAT_UNDEFINED, depth = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
};

/// Movable. Must not outlive its Device; the picture views belong to the caller and must outlive it.
class Canvas {
public:
    Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format, VkExtent2D extent,
           std::span<const VkImageView> pictures);

    VkExtent2D extent() const noexcept { return extent_; }
    float aspect() const noexcept {
        return static_cast<float>(extent_.width) / static_cast<float>(extent_.height);
    }
    VkFramebuffer framebuffer(std::size_t picture) const noexcept { return framebuffers_[picture].handle(); }

private:
    VkExtent2D extent_;
    std::vector<Image> images_; ///< depth, then colour where there is more than one sample
    std::vector<Framebuffer> framebuffers_;
};

} // namespace sinew::viewer
