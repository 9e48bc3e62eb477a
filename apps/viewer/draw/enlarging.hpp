// Pictures that are drawn smaller than they are shown, and enlarged.
#pragma once

#include "viewer/draw/render_pass.hpp"

namespace sinew::viewer {

/// Owns the small image and the framebuffers of the large ones. Movable. Must not outlive its Device; the
/// picture views belong to the caller and must outlive it.
class Enlarging {
public:
    /// `pass` is RenderPass::whole, for pictures of `extent`; `scale` in (0, 1] is that of their sides.
    Enlarging(const vk::Device& device, const RenderPass& pass, VkFormat color, VkExtent2D extent,
              float scale, std::span<const VkImageView> pictures);

    VkExtent2D extent() const noexcept { return extent_; }        ///< of the pictures
    VkExtent2D drawn() const noexcept { return image_.extent(); } ///< of the image
    VkImageView view() const noexcept { return image_.view(); }   ///< of the image
    /// Whether it has pictures of its own; else it is a part of some.
    bool isWhole() const noexcept { return !framebuffers_.empty(); }
    VkFramebuffer framebuffer(std::size_t picture) const noexcept { return framebuffers_[picture].handle(); }

private:
    VkExtent2D extent_;
    Image image_;
    std::vector<Framebuffer> framebuffers_;
};

} // namespace sinew::viewer
