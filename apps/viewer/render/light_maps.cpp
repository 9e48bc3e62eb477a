// Makes the maps. Everything outside a map is lit: the border of the samplers is 1.
#include "viewer/render/light_maps.hpp"

#include <array>

namespace sinew::viewer {

namespace {

VkFormat mapDepthFormat(const vk::Device& device) {
    constexpr std::array formats{VK_FORMAT_D32_SFLOAT, VK_FORMAT_X8_D24_UNORM_PACK32, VK_FORMAT_D16_UNORM};
    return findFormat(device, formats,
                      VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT);
}

LightMap makeMap(const vk::Device& device, VkFormat format, std::uint32_t size, const std::string& name) {
    const bool isDepth = isDepthFormat(format);
    const VkExtent2D extent{size, size};
    const VkImageUsageFlags attachment =
        isDepth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    Image image(
        device,
        {.name = name, .extent = extent, .format = format, .usage = attachment | VK_IMAGE_USAGE_SAMPLED_BIT});
    RenderPass pass =
        isDepth ? RenderPass::depthMap(device, format, name) : RenderPass::colorMap(device, format, name);
    const std::array views{image.view()};
    Framebuffer framebuffer(device, pass.handle(), views, extent, name);
    return {std::move(image), std::move(pass), std::move(framebuffer)};
}

// Filtering of compared depths is optional in Vulkan; without it only the taps soften the edge.
VkFilter comparingFilter(const vk::Device& device, VkFormat depth) {
    const bool isFiltered =
        findFormat(device, std::array{depth}, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) == depth;
    return isFiltered ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
}

} // namespace

LightMaps::LightMaps(const vk::Device& device, std::uint32_t shadowSize, std::uint32_t floorSize)
    : depthFormat_(mapDepthFormat(device)), shadow(makeMap(device, depthFormat_, shadowSize, "light.shadow")),
      plan(makeMap(device, depthFormat_, floorSize, "light.plan")),
      floor(makeMap(device, VK_FORMAT_R8G8_UNORM, floorSize, "light.floor")),
      comparing_(
          device,
          {.name = "light.comparing", .filter = comparingFilter(device, depthFormat_), .isComparing = true}),
      nearest_(device, {.name = "light.nearest"}),
      smooth_(device, {.name = "light.smooth", .filter = VK_FILTER_LINEAR}),
      stretching_(device, {.name = "stretching",
                           .filter = VK_FILTER_LINEAR,
                           .beyond = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}) {}

} // namespace sinew::viewer
