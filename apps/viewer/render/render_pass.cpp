// Render passes with their dependencies on each other and on earlier pictures, which use the same maps and
// multisampled images.
#include "viewer/render/render_pass.hpp"

#include "sinew/vk/check.hpp"

#include <utility>

namespace sinew::viewer {

namespace {

constexpr VkPipelineStageFlags depthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags colorStage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkAccessFlags depthAccess =
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags colorAccess =
    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;

VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits samples,
                                   VkImageLayout finalLayout) {
    return {.format = format,
            .samples = samples,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = finalLayout};
}

// The use of a picture after drawing: a copy, or a presentation, which waits for a semaphore.
struct Reader {
    VkPipelineStageFlags document;
    VkAccessFlags access;
};
// Union of all uses of pictures: passes that share pipelines need the same dependencies to be compatible.
constexpr Reader anyReader{colorStage | VK_PIPELINE_STAGE_TRANSFER_BIT |
                               VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                           VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_SHADER_READ_BIT};
constexpr Reader sampling{VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};

// Stages and accesses of a pass that draws: it waits for earlier readers of its images, and later readers
// wait for it.
struct Drawing {
    VkPipelineStageFlags stages;
    VkAccessFlags access, writes;
};
std::array<VkSubpassDependency, 2> between(const Reader& reader, const Drawing& drawing) {
    return {VkSubpassDependency{.srcSubpass = VK_SUBPASS_EXTERNAL,
                                .dstSubpass = 0,
                                .srcStageMask = reader.document | drawing.stages,
                                .dstStageMask = drawing.stages,
                                .srcAccessMask = drawing.writes,
                                .dstAccessMask = drawing.access},
            VkSubpassDependency{.srcSubpass = 0,
                                .dstSubpass = VK_SUBPASS_EXTERNAL,
                                .srcStageMask = drawing.stages,
                                .dstStageMask = reader.document,
                                .srcAccessMask = drawing.writes,
                                .dstAccessMask = reader.access}};
}

constexpr Drawing colors{colorStage, colorAccess, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
constexpr Drawing depths{depthStages, depthAccess, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

VkRenderPassCreateInfo passInfo(std::span<const VkAttachmentDescription> attachments,
                                const VkSubpassDescription& subpass,
                                std::span<const VkSubpassDependency> dependencies) {
    return {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
            .attachmentCount = static_cast<std::uint32_t>(attachments.size()),
            .pAttachments = attachments.data(),
            .subpassCount = 1,
            .pSubpasses = &subpass,
            .dependencyCount = static_cast<std::uint32_t>(dependencies.size()),
            .pDependencies = dependencies.data()};
}

constexpr VkAttachmentReference colorReference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};

} // namespace

RenderPass::RenderPass(const vk::Device& device, const VkRenderPassCreateInfo& info, const std::string& name)
    : device_(&device) {
    vk::check(device.functions().vkCreateRenderPass(device.handle(), &info, nullptr, &pass_),
              "vkCreateRenderPass", name);
    device.name(VK_OBJECT_TYPE_RENDER_PASS, vk::handleValue(pass_), name);
}

RenderPass RenderPass::depthMap(const vk::Device& device, VkFormat depth, const std::string& name) {
    const std::array attachments{
        attachment(depth, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)};
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .pDepthStencilAttachment = &reference};
    const auto dependencies = between(sampling, depths);
    return RenderPass(device, passInfo(attachments, subpass, dependencies), name);
}

RenderPass RenderPass::colorMap(const vk::Device& device, VkFormat color, const std::string& name,
                                VkSampleCountFlagBits samples) {
    const std::array attachments{attachment(color, samples, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &colorReference};
    const auto dependencies = between(sampling, colors);
    return RenderPass(device, passInfo(attachments, subpass, dependencies), name);
}

RenderPass RenderPass::surfaces(const vk::Device& device, std::span<const VkFormat> formats,
                                VkFormat depthFormat) {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> references;
    for (const VkFormat color : formats) {
        references.push_back(
            {static_cast<std::uint32_t>(attachments.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
        attachments.push_back(
            attachment(color, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL));
        attachments.back().loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    }
    const VkAttachmentReference depth{static_cast<std::uint32_t>(attachments.size()),
                                      VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    attachments.push_back(attachment(depthFormat, VK_SAMPLE_COUNT_1_BIT, depth.layout));
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = static_cast<std::uint32_t>(references.size()),
                                       .pColorAttachments = references.data(),
                                       .pDepthStencilAttachment = &depth};
    const Drawing both{colors.stages | depths.stages, colors.access | depths.access,
                       colors.writes | depths.writes};
    const Reader next{sampling.document | depths.stages, sampling.access | depths.access};
    const auto dependencies = between(next, both);
    return RenderPass(device, passInfo(attachments, subpass, dependencies), "surfaces");
}

RenderPass RenderPass::picture(const vk::Device& device, const Picture& picture) {
    const bool isResolved = picture.samples != VK_SAMPLE_COUNT_1_BIT;
    std::vector attachments{
        attachment(picture.color, picture.samples,
                   isResolved ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL : picture.finalLayout),
        attachment(picture.depth, picture.samples, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (picture.keepsDepth) {
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
        attachments[1].initialLayout = attachments[1].finalLayout;
    }
    if (isResolved) {
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments.push_back(attachment(picture.color, VK_SAMPLE_COUNT_1_BIT, picture.finalLayout));
        attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    }
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolve{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &colorReference,
                                       .pResolveAttachments = isResolved ? &resolve : nullptr,
                                       .pDepthStencilAttachment = &depth};
    const std::array dependencies{
        VkSubpassDependency{.srcSubpass = VK_SUBPASS_EXTERNAL,
                            .dstSubpass = 0,
                            .srcStageMask = colorStage | depthStages | anyReader.document,
                            .dstStageMask = colorStage | depthStages,
                            .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
                                             VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                            .dstAccessMask = colorAccess | depthAccess},
        VkSubpassDependency{.srcSubpass = 0,
                            .dstSubpass = VK_SUBPASS_EXTERNAL,
                            .srcStageMask = colorStage,
                            .dstStageMask = anyReader.document,
                            .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                            .dstAccessMask = anyReader.access}};
    return RenderPass(device, passInfo(attachments, subpass, dependencies), "picture");
}

RenderPass RenderPass::ofColor(const vk::Device& device, const VkAttachmentDescription& color,
                               const std::string& name) {
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &colorReference};
    const auto dependencies = between(anyReader, colors);
    return RenderPass(device, passInfo(std::span(&color, 1), subpass, dependencies), name);
}

RenderPass RenderPass::whole(const vk::Device& device, VkFormat color, VkImageLayout finalLayout) {
    VkAttachmentDescription picture = attachment(color, VK_SAMPLE_COUNT_1_BIT, finalLayout);
    picture.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    return ofColor(device, picture, "whole");
}

RenderPass RenderPass::over(const vk::Device& device, VkFormat color, VkImageLayout finalLayout) {
    VkAttachmentDescription picture = attachment(color, VK_SAMPLE_COUNT_1_BIT, finalLayout);
    picture.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    picture.initialLayout = finalLayout;
    return ofColor(device, picture, "over");
}

RenderPass::RenderPass(RenderPass&& other) noexcept
    : device_(other.device_), pass_(std::exchange(other.pass_, VK_NULL_HANDLE)) {}

RenderPass::~RenderPass() {
    device_->functions().vkDestroyRenderPass(device_->handle(), pass_, nullptr);
}

Framebuffer::Framebuffer(const vk::Device& device, VkRenderPass pass, std::span<const VkImageView> views,
                         VkExtent2D extent, const std::string& name)
    : device_(&device) {
    const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = pass,
                                       .attachmentCount = static_cast<std::uint32_t>(views.size()),
                                       .pAttachments = views.data(),
                                       .width = extent.width,
                                       .height = extent.height,
                                       .layers = 1};
    vk::check(device.functions().vkCreateFramebuffer(device.handle(), &info, nullptr, &framebuffer_),
              "vkCreateFramebuffer", name);
    device.name(VK_OBJECT_TYPE_FRAMEBUFFER, vk::handleValue(framebuffer_), name);
}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : device_(other.device_), framebuffer_(std::exchange(other.framebuffer_, VK_NULL_HANDLE)) {}

Framebuffer::~Framebuffer() {
    device_->functions().vkDestroyFramebuffer(device_->handle(), framebuffer_, nullptr);
}

} // namespace sinew::viewer
