// Draws into an image and copies it to a mapped buffer.
#include "viewer/render/shot.hpp"

#include "sinew/vk/commands.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

Image makeImage(const vk::Device& device, VkFormat format, VkExtent2D extent) {
    return Image(device, {.name = "shot.picture",
                          .extent = extent,
                          .format = format,
                          .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
}

bool isBlueFirst(VkFormat format) {
    return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
}

} // namespace

Shot::Shot(const vk::Device& device, Renderer& renderer, VkExtent2D extent, float scale)
    : device_(device), renderer_(renderer), image_(makeImage(device, renderer.format(), extent)),
      readback_(device, {.name = "shot.readback",
                         .count = VkDeviceSize{extent.width} * extent.height,
                         .stride = 4,
                         .kind = vk::MemoryKind::readback}),
      canvas_(renderer.makeCopiedCanvas(extent, std::array{image_.view()}, scale)) {}

void Shot::record(VkCommandBuffer commands, std::uint32_t slot, const Camera& camera,
                  const sim::Simulation& simulation, const Overlay& overlay) {
    recordPicture(commands, slot, camera, simulation, overlay);
    recordCopy(commands);
}

void Shot::recordPicture(VkCommandBuffer commands, std::uint32_t slot, const Camera& camera,
                         const sim::Simulation& simulation, const Overlay& overlay) {
    renderer_.prepareCanvas(overlay.layers, canvas_);
    renderer_.record(commands, slot, canvas_, 0, camera, simulation, overlay);
}

void Shot::recordHalves(VkCommandBuffer commands, std::array<std::uint32_t, 2> slots, const Camera& camera,
                        const std::array<Side, 2>& sides) {
    if (!halves_)
        halves_.emplace(
            renderer_.makeHalves(image_.extent(), std::array{image_.view()}, image_.extent().width, true));
    for (std::size_t side = 0; side < 2; ++side) {
        renderer_.prepareCanvas(sides[side].overlay.layers, halves_->canvases[side]);
        renderer_.record(commands, slots[side], halves_->canvases[side], 0, camera, sides[side].simulation,
                         sides[side].overlay);
    }
    renderer_.recordHalves(commands, slots, *halves_, 0);
    recordCopy(commands);
}

void Shot::recordCopy(VkCommandBuffer commands) const noexcept {
    const VkBufferImageCopy region{.bufferOffset = readback_.view().offset,
                                   .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {image_.extent().width, image_.extent().height, 1}};
    device_.functions().vkCmdCopyImageToBuffer(
        commands, image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback_.view().buffer, 1, &region);
    vk::Commands(device_, commands).hostBarrier();
}

Picture Shot::read() const {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(readback_.mapped());
    const VkExtent2D extent = image_.extent();
    Picture picture{
        .width = extent.width, .height = extent.height, .pixels = {bytes, bytes + readback_.view().size}};
    if (isBlueFirst(renderer_.format()))
        for (std::size_t at = 0; at + 3 < picture.pixels.size(); at += 4)
            std::swap(picture.pixels[at], picture.pixels[at + 2]);
    return picture;
}

} // namespace sinew::viewer
