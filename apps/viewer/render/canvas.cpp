// Images are in the order of the attachments of RenderPass::picture.
#include "viewer/render/canvas.hpp"

#include <array>
#include <utility>

namespace sinew::viewer {

Canvas::Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format,
               VkExtent2D extent, std::span<const VkImageView> pictures)
    : extent_(extent) {
    images_.emplace_back(device, ImageRequest{.name = "canvas.depth",
                                              .extent = extent,
                                              .format = format.depth,
                                              .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                              .samples = format.samples});
    const bool isResolved = format.samples != VK_SAMPLE_COUNT_1_BIT;
    if (isResolved)
        images_.emplace_back(device, ImageRequest{.name = "canvas.color",
                                                  .extent = extent,
                                                  .format = format.color,
                                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                                  .samples = format.samples});
    for (const VkImageView picture : pictures)
        framebuffers_.emplace_back(device, pass.handle(), views(picture), extent, "canvas.framebuffer");
}

Canvas::Canvas(const vk::Device& device, const RenderPass& pass, const CanvasFormat& format,
               Enlarging enlarging)
    : Canvas(device, pass, format, enlarging.drawn(), std::array{enlarging.view()}) {
    enlarging_.emplace(std::move(enlarging));
}

std::vector<VkImageView> Canvas::views(VkImageView picture) const {
    const bool isResolved = images_.size() > 1;
    std::vector<VkImageView> views{isResolved ? images_[1].view() : picture, images_[0].view()};
    if (isResolved) views.push_back(picture);
    return views;
}

void Canvas::addBackdrop(const vk::Device& device, const RenderPass& pass, VkFormat color) {
    backdrop_.emplace(device, pass, color, extent_, views(VK_NULL_HANDLE));
}

void Canvas::addSurfaces(const vk::Device& device, const RenderPass& pass) {
    std::vector<VkImageView> views;
    for (const VkFormat format : surfaceFormats) {
        surfaces_.emplace_back(
            device, ImageRequest{.name = "canvas.surfaces",
                                 .extent = extent_,
                                 .format = format,
                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
        views.push_back(surfaces_.back().view());
    }
    views.push_back(images_[0].view());
    surfacesFramebuffer_.emplace_back(device, pass.handle(), views, extent_, "canvas.surfaces");
}

void Canvas::addCounts(const vk::Device& device, const RenderPass& pass, VkSampleCountFlagBits samples) {
    if (hasCounts()) return;
    Image image(device, {.name = "canvas.counts",
                         .extent = extent_,
                         .format = countsFormat,
                         .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                         .samples = samples});
    countsFramebuffer_.emplace_back(device, pass.handle(), std::array{image.view()}, extent_,
                                    "canvas.counts");
    counts_.push_back(std::move(image));
}

} // namespace sinew::viewer
