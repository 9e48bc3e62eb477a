// The multisampled colour and depth images behind one or more pictures of a size, and a framebuffer per
// picture; or one for all, where they are enlarged.
#pragma once

#include "viewer/draw/backdrop.hpp"
#include "viewer/draw/enlarging.hpp"
#include "viewer/draw/render_pass.hpp"

namespace sinew::viewer {

struct CanvasFormat {
    VkFormat color = VK_FORMAT_UNDEFINED, depth = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
};

constexpr VkFormat countsFormat = VK_FORMAT_R16G16B16A16_SFLOAT; // every device adds up in it

/// Movable. Must not outlive its Device; the picture views belong to the caller and must outlive it.
class Canvas {
public:
    Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format, VkExtent2D extent,
           std::span<const VkImageView> pictures);
    /// For the image that is enlarged; `pass` leaves it to be read.
    Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format, Enlarging enlarging);

    /// Adds the image in which a section counts surfaces, as RenderPass::colorMap, if it is not there yet.
    /// Throws vk::Error.
    void addCounts(const vk::Device& device, const RenderPass& pass, VkSampleCountFlagBits samples);
    bool hasCounts() const noexcept { return !counts_.empty(); }
    VkImageView counts() const noexcept { return counts_[0].view(); } ///< where it hasCounts()
    VkFramebuffer countsFramebuffer() const noexcept { return countsFramebuffer_[0].handle(); } ///< likewise

    /// Adds an image for what stands behind all bodies; `pass` is compatible with that of the pictures and
    /// leaves it to be read. Throws vk::Error.
    void addBackdrop(const vk::Device& device, const RenderPass& pass, VkFormat color);
    bool hasBackdrop() const noexcept { return backdrop_.has_value(); }
    Backdrop& backdrop() noexcept { return *backdrop_; }             ///< where it hasBackdrop()
    const Backdrop& backdrop() const noexcept { return *backdrop_; } ///< likewise

    /// Where pictures are drawn smaller than they are.
    const std::optional<Enlarging>& enlarging() const noexcept { return enlarging_; }

    /// Its pictures are copied, not shown.
    void setCopied() noexcept { isCopied_ = true; }
    bool isCopied() const noexcept { return isCopied_; }

    VkExtent2D extent() const noexcept { return extent_; } ///< that is drawn
    float aspect() const noexcept {                        ///< of the pictures
        const VkExtent2D shown = enlarging_ ? enlarging_->extent() : extent_;
        return static_cast<float>(shown.width) / static_cast<float>(shown.height);
    }
    VkFramebuffer framebuffer(std::size_t picture) const noexcept {
        return framebuffers_[enlarging_ ? 0 : picture].handle();
    }

private:
    std::vector<VkImageView> views(VkImageView picture) const; // as RenderPass::picture wants them

    VkExtent2D extent_;
    std::vector<Image> images_; ///< depth, then colour where there is more than one sample
    std::vector<Framebuffer> framebuffers_;
    std::vector<Image> counts_; ///< one or none, as the next
    std::vector<Framebuffer> countsFramebuffer_;
    std::optional<Backdrop> backdrop_;
    std::optional<Enlarging> enlarging_;
    bool isCopied_ = false;
};

} // namespace sinew::viewer
