// Allocates images directly from the driver: src/vk provides only buffers.
#include "viewer/render/image.hpp"

#include "sinew/vk/check.hpp"
#include "vk/allocator.hpp"

#include <utility>

namespace sinew::viewer {

namespace {

VkDeviceMemory allocate(const vk::Device& device, const VkMemoryRequirements& needs,
                        const std::string& name) {
    VkPhysicalDeviceMemoryProperties properties;
    device.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties);
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (const std::uint32_t type :
         vk::suitableMemoryTypes(properties, needs.memoryTypeBits, vk::MemoryKind::device)) {
        const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                        .allocationSize = needs.size,
                                        .memoryTypeIndex = type};
        VkDeviceMemory memory = VK_NULL_HANDLE;
        result = device.functions().vkAllocateMemory(device.handle(), &info, nullptr, &memory);
        if (result == VK_SUCCESS) return memory;
    }
    vk::check(result, "vkAllocateMemory", "image " + name);
    return VK_NULL_HANDLE;
}

VkImageView makeView(const vk::Device& device, VkImage image, VkFormat format, VkImageAspectFlags aspect,
                     const std::string& name) {
    const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = image,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = format,
                                     .subresourceRange = {aspect, 0, 1, 0, 1}};
    VkImageView view = VK_NULL_HANDLE;
    vk::check(device.functions().vkCreateImageView(device.handle(), &info, nullptr, &view),
              "vkCreateImageView", name);
    device.name(VK_OBJECT_TYPE_IMAGE_VIEW, vk::handleValue(view), name);
    return view;
}

} // namespace

Image::Image(const vk::Device& device, const ImageRequest& request)
    : device_(&device), extent_(request.extent) {
    try {
        create(request);
    } catch (...) {
        release();
        throw;
    }
}

void Image::create(const ImageRequest& request) {
    const vk::DeviceFunctions& functions = device_->functions();
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = request.format,
                                 .extent = {request.extent.width, request.extent.height, 1},
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = request.samples,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = request.usage,
                                 .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    vk::check(functions.vkCreateImage(device_->handle(), &info, nullptr, &image_), "vkCreateImage",
              request.name);
    device_->name(VK_OBJECT_TYPE_IMAGE, vk::handleValue(image_), request.name);
    VkMemoryRequirements needs;
    functions.vkGetImageMemoryRequirements(device_->handle(), image_, &needs);
    memory_ = allocate(*device_, needs, request.name);
    vk::check(functions.vkBindImageMemory(device_->handle(), image_, memory_, 0), "vkBindImageMemory",
              request.name);
    const VkImageAspectFlags aspect =
        isDepthFormat(request.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    view_ = makeView(*device_, image_, request.format, aspect, request.name);
}

Image::Image(Image&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)), extent_(other.extent_),
      image_(std::exchange(other.image_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      view_(std::exchange(other.view_, VK_NULL_HANDLE)) {}

Image& Image::operator=(Image&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(extent_, other.extent_);
    std::swap(image_, other.image_);
    std::swap(memory_, other.memory_);
    std::swap(view_, other.view_);
    return *this;
}

Image::~Image() {
    release();
}

void Image::release() noexcept {
    if (device_ == nullptr) return;
    device_->functions().vkDestroyImageView(device_->handle(), view_, nullptr);
    device_->functions().vkDestroyImage(device_->handle(), image_, nullptr);
    device_->functions().vkFreeMemory(device_->handle(), memory_, nullptr);
}

VkImageView makeView(const vk::Device& device, VkImage image, VkFormat format, const std::string& name) {
    return makeView(device, image, format, VK_IMAGE_ASPECT_COLOR_BIT, name);
}

bool isDepthFormat(VkFormat format) noexcept {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_X8_D24_UNORM_PACK32 ||
           format == VK_FORMAT_D16_UNORM;
}

VkFormat findFormat(const vk::Device& device, std::span<const VkFormat> formats,
                    VkFormatFeatureFlags features) {
    for (const VkFormat format : formats) {
        VkFormatProperties properties;
        device.instanceFunctions().vkGetPhysicalDeviceFormatProperties(device.physical(), format,
                                                                       &properties);
        if ((properties.optimalTilingFeatures & features) == features) return format;
    }
    return VK_FORMAT_UNDEFINED;
}

} // namespace sinew::viewer
