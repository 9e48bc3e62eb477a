// Draws the image at the second picture with the same view, so that a moving camera costs nothing.
#include "viewer/render/backdrop.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace sinew::viewer {

namespace {

std::vector<VkImageView> withImage(std::span<const VkImageView> behind, VkImageView image) {
    std::vector<VkImageView> views(behind.begin(), behind.end());
    std::ranges::replace(views, VkImageView{VK_NULL_HANDLE}, image);
    return views;
}

} // namespace

Backdrop::Backdrop(const vk::Device& device, const RenderPass& pass, VkFormat color, VkExtent2D extent,
                   std::span<const VkImageView> behind)
    : image_(device, {.name = "backdrop",
                      .extent = extent,
                      .format = color,
                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}),
      framebuffer_(device, pass.handle(), withImage(behind, image_.view()), extent, "backdrop") {}

Backdrop::Use Backdrop::next(const layout::FrameParams& params) noexcept {
    layout::FrameParams seen = params;
    seen.section = {}; // affects only bodies
    const bool isSame = last_ && std::memcmp(&*last_, &seen, sizeof(seen)) == 0;
    last_ = seen;
    const bool wasMade = std::exchange(isMade_, isSame);
    return !isSame ? Use::direct : wasMade ? Use::kept : Use::made;
}

} // namespace sinew::viewer
