// The render passes of a picture and their framebuffers. All pipeline stages and access masks of the viewer's
// drawing are in render_pass.cpp, as external dependencies: the renderer records no barrier of its own.
#pragma once

#include "viewer/render/image.hpp"

namespace sinew::viewer {

/// A VkRenderPass. Movable. Must not outlive its Device.
class RenderPass {
public:
    /// Clears a depth image, draws into it, and leaves it readable in fragment shaders.
    static RenderPass depthMap(const vk::Device& device, VkFormat depth, const std::string& name);

    /// Clears a colour image, draws into it, and leaves it readable in fragment shaders.
    static RenderPass colorMap(const vk::Device& device, VkFormat color, const std::string& name,
                               VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);

    struct Picture {
        VkFormat color = VK_FORMAT_UNDEFINED, depth = VK_FORMAT_UNDEFINED;
        VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
        /// PRESENT_SRC_KHR: drawing waits for an acquire semaphore at the colour output stage.
        /// TRANSFER_SRC_OPTIMAL: the picture is ready to be copied in the same queue.
        VkImageLayout finalLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        bool keepsDepth = false; ///< draws behind and before what surfaces() has left
    };
    /// Attachments: colour and depth of `samples` samples, then the image that the colour is resolved into.
    /// With one sample there is no third: the first attachment is the picture.
    static RenderPass picture(const vk::Device& device, const Picture& picture);

    /// Draws the surfaces that are seen into colour images that it leaves readable in fragment shaders, where
    /// nothing is drawn undefined, and a depth image, which it clears. One sample.
    static RenderPass surfaces(const vk::Device& device, std::span<const VkFormat> formats, VkFormat depth);

    /// Draws a whole picture with one sample and without depth, and leaves it in `finalLayout`, like
    /// picture().
    static RenderPass whole(const vk::Device& device, VkFormat color, VkImageLayout finalLayout);

    /// Draws over a picture that picture() has left in its final layout, and leaves it there.
    static RenderPass over(const vk::Device& device, VkFormat color, VkImageLayout finalLayout);

    RenderPass(RenderPass&& other) noexcept;
    RenderPass& operator=(RenderPass&&) = delete;
    ~RenderPass();

    VkRenderPass handle() const noexcept { return pass_; }

private:
    RenderPass(const vk::Device& device, const VkRenderPassCreateInfo& info, const std::string& name);
    static RenderPass ofColor(const vk::Device& device, const VkAttachmentDescription& color,
                              const std::string& name);
    const vk::Device* device_ = nullptr;
    VkRenderPass pass_ = VK_NULL_HANDLE;
};

/// A VkFramebuffer. Movable. Must not outlive its Device; owns none of the views.
class Framebuffer {
public:
    Framebuffer(const vk::Device& device, VkRenderPass pass, std::span<const VkImageView> views,
                VkExtent2D extent, const std::string& name);
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&&) = delete;
    ~Framebuffer();

    VkFramebuffer handle() const noexcept { return framebuffer_; }

private:
    const vk::Device* device_ = nullptr;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
};

} // namespace sinew::viewer
