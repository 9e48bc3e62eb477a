// The image of pictures that are drawn smaller than they are shown, and their enlargement.
#pragma once

#include "viewer/render/render_pass.hpp"

namespace sinew::viewer {

/// Owns the small image and the framebuffers of the full-size pictures. Movable. Must not outlive its Device;
/// the picture views belong to the caller and must outlive it.
class Enlarging {
public:
    /// `pass` is RenderPass::whole, for pictures of `extent`; `scale` in (0, 1] is the ratio of sides.
    Enlarging(const vk::Device& device, const RenderPass& pass, VkFormat color, VkExtent2D extent,
              float scale, std::span<const VkImageView> pictures);

    VkExtent2D extent() const noexcept { return extent_; }        ///< of the pictures
    VkExtent2D drawn() const noexcept { return image_.extent(); } ///< size of the small image
    VkImageView view() const noexcept { return image_.view(); }   ///< the small image
    /// Whether it has full-size pictures of its own; otherwise it fills a part of a picture.
    bool isWhole() const noexcept { return !framebuffers_.empty(); }
    VkFramebuffer framebuffer(std::size_t picture) const noexcept { return framebuffers_[picture].handle(); }

private:
    VkExtent2D extent_;
    Image image_;
    std::vector<Framebuffer> framebuffers_;
};

} // namespace sinew::viewer
