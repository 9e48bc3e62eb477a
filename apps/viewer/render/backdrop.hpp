// Cached image of the sky and the floor far from all bodies, valid while the view stays the same.
#pragma once

#include "viewer/frame.h"
#include "viewer/render/image.hpp"
#include "viewer/render/render_pass.hpp"

#include <optional>

namespace sinew::viewer {

/// Owns the image, not the pass. Movable. Must not outlive its Device.
class Backdrop {
public:
    /// `behind` are the views that a picture of `pass` is drawn with, in order; an empty one stands for this
    /// image.
    Backdrop(const vk::Device& device, const RenderPass& pass, VkFormat color, VkExtent2D extent,
             std::span<const VkImageView> behind);

    enum class Use {
        direct, ///< sky and floor are drawn into the picture: the view has changed since the last one
        made,   ///< sky and floor are drawn into this image now
        kept    ///< the image is valid
    };
    /// Decides the use for the next picture, which has these parameters.
    Use next(const layout::FrameParams& params) noexcept;

    VkImageView view() const noexcept { return image_.view(); }
    VkFramebuffer framebuffer() const noexcept { return framebuffer_.handle(); }

private:
    Image image_;
    Framebuffer framebuffer_;
    std::optional<layout::FrameParams> last_;
    bool isMade_ = false; // for last_
};

} // namespace sinew::viewer
