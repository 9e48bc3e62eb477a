// The render targets of pictures of one size: multisampled colour and depth images, and a framebuffer per
// picture, or one for all if pictures are enlarged.
#pragma once

#include "viewer/render/backdrop.hpp"
#include "viewer/render/enlarging.hpp"
#include "viewer/render/render_pass.hpp"

#include <array>

namespace sinew::viewer {

struct CanvasFormat {
    VkFormat color = VK_FORMAT_UNDEFINED, depth = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
};

constexpr VkFormat countsFormat = VK_FORMAT_R16G16B16A16_SFLOAT; // every device can blend into it

/// Images of the surfaces that are seen (shown.glsl): normal and distance, and material.
inline constexpr std::array surfaceFormats{VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT};

/// Movable. Must not outlive its Device; the picture views belong to the caller and must outlive the canvas.
class Canvas {
public:
    Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format, VkExtent2D extent,
           std::span<const VkImageView> pictures);
    /// Draws into the small image of `enlarging`; `pass` leaves that image readable.
    Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format, Enlarging enlarging);

    /// Adds the image into which a section counts surfaces (see RenderPass::colorMap) if it is missing.
    /// Throws vk::Error.
    void addCounts(const vk::Device& device, const RenderPass& pass, VkSampleCountFlagBits samples);
    bool hasCounts() const noexcept { return !counts_.empty(); }
    VkImageView counts() const noexcept { return counts_[0].view(); } ///< only if hasCounts()
    VkFramebuffer countsFramebuffer() const noexcept { return countsFramebuffer_[0].handle(); } ///< the same

    /// Adds an image for sky and far floor; `pass` is compatible with the pictures' pass and leaves the image
    /// readable. Throws vk::Error.
    void addBackdrop(const vk::Device& device, const RenderPass& pass, VkFormat color);
    bool hasBackdrop() const noexcept { return backdrop_.has_value(); }
    Backdrop& backdrop() noexcept { return *backdrop_; }             ///< only if hasBackdrop()
    const Backdrop& backdrop() const noexcept { return *backdrop_; } ///< only if hasBackdrop()

    /// Adds the images of surfaces that are seen, drawn by `pass` (RenderPass::surfaces) with the depth of
    /// the pictures. One sample. Throws vk::Error.
    void addSurfaces(const vk::Device& device, const RenderPass& pass);
    bool hasSurfaces() const noexcept { return !surfaces_.empty(); }
    VkImageView normals() const noexcept { return surfaces_[0].view(); }   ///< only if hasSurfaces()
    VkImageView materials() const noexcept { return surfaces_[1].view(); } ///< the same
    VkFramebuffer surfacesFramebuffer() const noexcept {                   ///< the same
        return surfacesFramebuffer_[0].handle();
    }

    /// Present if pictures are drawn smaller than they are shown.
    const std::optional<Enlarging>& enlarging() const noexcept { return enlarging_; }

    /// Pictures of this canvas are copied, not shown.
    void setCopied() noexcept { isCopied_ = true; }
    bool isCopied() const noexcept { return isCopied_; }

    VkExtent2D extent() const noexcept { return extent_; } ///< of the drawn image
    float aspect() const noexcept {                        ///< width / height of the pictures
        const VkExtent2D shown = enlarging_ ? enlarging_->extent() : extent_;
        return static_cast<float>(shown.width) / static_cast<float>(shown.height);
    }
    VkFramebuffer framebuffer(std::size_t picture) const noexcept {
        return framebuffers_[enlarging_ ? 0 : picture].handle();
    }

private:
    std::vector<VkImageView> views(VkImageView picture) const; // in the order of RenderPass::picture

    VkExtent2D extent_;
    std::vector<Image> images_; ///< depth; then colour if there is more than one sample
    std::vector<Framebuffer> framebuffers_;
    std::vector<Image> counts_; ///< none or one element
    std::vector<Framebuffer> countsFramebuffer_;
    std::vector<Image> surfaces_; ///< none, or in the order of surfaceFormats
    std::vector<Framebuffer> surfacesFramebuffer_;
    std::optional<Backdrop> backdrop_;
    std::optional<Enlarging> enlarging_;
    bool isCopied_ = false;
};

} // namespace sinew::viewer
