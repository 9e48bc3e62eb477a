// Sky and floor far from all bodies, kept while they are seen from the same place.
#pragma once

#include "viewer/draw/image.hpp"
#include "viewer/draw/render_pass.hpp"
#include "viewer/frame.h"

#include <optional>

namespace sinew::viewer {

/// Owns the image, not the pass. Movable. Must not outlive its Device.
class Backdrop {
public:
    /// `behind` are the views that a picture of `pass` is drawn with, in order; an empty one is this image.
    Backdrop(const vk::Device& device, const RenderPass& pass, VkFormat color, VkExtent2D extent,
             std::span<const VkImageView> behind);

    enum class Use {
        direct, ///< sky and floor are drawn as ever: they were seen from elsewhere in the last picture
        made,   ///< they are drawn into this image now
        kept    ///< they are there
    };
    /// For the next picture to be recorded, with these numbers.
    Use next(const layout::FrameParams& params) noexcept;

    VkImageView view() const noexcept { return image_.view(); }
    VkFramebuffer framebuffer() const noexcept { return framebuffer_.handle(); }

private:
    Image image_;
    Framebuffer framebuffer_;
    std::optional<layout::FrameParams> last_;
    bool isMade_ = false; // of last_
};

} // namespace sinew::viewer
