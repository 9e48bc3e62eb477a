// Draws into an sRGB image, copies it to a mapped buffer.
#include "viewer/draw/offscreen.hpp"

#include "vk/commands.hpp"

#include <algorithm>

namespace sinew::viewer {

namespace {

constexpr VkFormat format = VK_FORMAT_R8G8B8A8_SRGB; // every device draws and copies it

Image makeImage(const vk::Device& device, VkExtent2D extent) {
    return Image(device, {.name = "offscreen.picture",
                          .extent = extent,
                          .format = format,
                          .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
}

} // namespace

Offscreen::Offscreen(const vk::Device& device, VkExtent2D extent, const StageLight& light,
                     const Quality& quality, float scale)
    : device_(device), image_(makeImage(device, extent)),
      readback_(device, {.name = "offscreen.readback",
                         .count = VkDeviceSize{extent.width} * extent.height,
                         .stride = 4,
                         .kind = vk::MemoryKind::readback}),
      renderer_(device, {.color = format}, quality, light),
      canvas_(renderer_.makeCanvas(extent, std::array{image_.view()}, scale)) {}

void Offscreen::record(VkCommandBuffer commands, const Camera& camera, const sim::Simulation& simulation,
                       const Overlay& overlay) noexcept {
    recordPicture(commands, camera, simulation, overlay);
    recordCopy(commands);
}

void Offscreen::recordPicture(VkCommandBuffer commands, const Camera& camera,
                              const sim::Simulation& simulation, const Overlay& overlay) noexcept {
    renderer_.record(commands, 0, canvas_, 0, camera, simulation, overlay);
}

void Offscreen::recordCopy(VkCommandBuffer commands) const noexcept {
    const VkBufferImageCopy region{.bufferOffset = readback_.view().offset,
                                   .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {image_.extent().width, image_.extent().height, 1}};
    device_.functions().vkCmdCopyImageToBuffer(
        commands, image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback_.view().buffer, 1, &region);
    vk::Commands(device_, commands).hostBarrier();
}

Picture Offscreen::read() const {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(readback_.mapped());
    const VkExtent2D extent = image_.extent();
    return {.width = extent.width, .height = extent.height, .pixels = {bytes, bytes + readback_.view().size}};
}

} // namespace sinew::viewer
