// The small image has at least one pixel a side.
#include "viewer/render/enlarging.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew::viewer {

namespace {

VkExtent2D scaled(VkExtent2D extent, float scale) {
    const auto side = [scale](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(std::max(std::lround(scale * static_cast<float>(pixels)), 1l));
    };
    return {side(extent.width), side(extent.height)};
}

} // namespace

Enlarging::Enlarging(const vk::Device& device, const RenderPass& pass, VkFormat color, VkExtent2D extent,
                     float scale, std::span<const VkImageView> pictures)
    : extent_(extent),
      image_(device, {.name = "small picture",
                      .extent = scaled(extent, scale),
                      .format = color,
                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}) {
    for (const VkImageView picture : pictures)
        framebuffers_.emplace_back(device, pass.handle(), std::array{picture}, extent, "enlarged picture");
}

} // namespace sinew::viewer
