// A two-dimensional image with its memory and one view: render targets and shadow maps.
#pragma once

#include "sinew/vk/device.hpp"

namespace sinew::viewer {

struct ImageRequest {
    std::string name;
    VkExtent2D extent{};
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageUsageFlags usage = 0;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

/// RAII. Has device-local memory of its own (a viewer has a handful of images). Must not outlive its Device.
class Image {
public:
    /// Throws vk::Error(outOfMemory) naming the image.
    Image(const vk::Device& device, const ImageRequest& request);
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;
    ~Image();

    VkImage handle() const noexcept { return image_; }
    VkImageView view() const noexcept { return view_; }
    VkExtent2D extent() const noexcept { return extent_; }

private:
    void create(const ImageRequest& request);
    void release() noexcept;
    const vk::Device* device_ = nullptr;
    VkExtent2D extent_{};
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
};

/// Makes a colour view of a whole image that another object owns. The caller destroys the view.
VkImageView makeView(const vk::Device& device, VkImage image, VkFormat format, const std::string& name);

/// True for the depth formats this viewer uses.
bool isDepthFormat(VkFormat format) noexcept;

/// The first of `formats` whose optimally tiled images have all `features`; VK_FORMAT_UNDEFINED if none.
VkFormat findFormat(const vk::Device& device, std::span<const VkFormat> formats,
                    VkFormatFeatureFlags features);

} // namespace sinew::viewer
