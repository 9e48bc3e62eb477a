// Makes the maps. Outside all of them there is light: their samplers' border is 1.
#include "viewer/draw/light_maps.hpp"

#include "vk/check.hpp"

namespace sinew::viewer {

namespace {

constexpr VkSamplerAddressMode border = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;

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

} // namespace

LightMaps::LightMaps(const vk::Device& device, std::uint32_t shadowSize, std::uint32_t floorSize)
    : device_(device), depthFormat_(mapDepthFormat(device)),
      shadow(makeMap(device, depthFormat_, shadowSize, "light.shadow")),
      plan(makeMap(device, depthFormat_, floorSize, "light.plan")),
      floor(makeMap(device, VK_FORMAT_R8G8_UNORM, floorSize, "light.floor")) {
    // Filtering compared depths is optional in Vulkan; without it the taps alone soften the edge.
    const bool isFiltered = findFormat(device, std::array{depthFormat_},
                                       VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) == depthFormat_;
    try {
        comparing_ =
            makeSampler(isFiltered ? VK_FILTER_LINEAR : VK_FILTER_NEAREST, true, border, "light.comparing");
        nearest_ = makeSampler(VK_FILTER_NEAREST, false, border, "light.nearest");
        smooth_ = makeSampler(VK_FILTER_LINEAR, false, border, "light.smooth");
        stretching_ =
            makeSampler(VK_FILTER_LINEAR, false, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, "stretching");
    } catch (...) {
        release();
        throw;
    }
}

LightMaps::~LightMaps() {
    release();
}

void LightMaps::release() noexcept {
    for (const VkSampler sampler : {comparing_, nearest_, smooth_, stretching_})
        device_.functions().vkDestroySampler(device_.handle(), sampler, nullptr);
}

VkSampler LightMaps::makeSampler(VkFilter filter, bool isComparing, VkSamplerAddressMode beyond,
                                 const std::string& name) {
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = filter,
                                   .minFilter = filter,
                                   .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .addressModeU = beyond,
                                   .addressModeV = beyond,
                                   .addressModeW = beyond,
                                   .compareEnable = isComparing,
                                   .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
                                   .borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE};
    VkSampler sampler = VK_NULL_HANDLE;
    vk::check(device_.functions().vkCreateSampler(device_.handle(), &info, nullptr, &sampler),
              "vkCreateSampler", name);
    device_.name(VK_OBJECT_TYPE_SAMPLER, vk::handleValue(sampler), name);
    return sampler;
}

} // namespace sinew::viewer
