// Pictures of two simulations side by side, drawn one after the other with the same maps.
#include "viewer/render/renderer.hpp"

namespace sinew::viewer {

Halves Renderer::makeHalves(VkExtent2D extent, std::span<const VkImageView> pictures, std::uint32_t width,
                            bool isCopied) const {
    const VkExtent2D half{(width + 1) / 2, extent.height};
    const auto makeHalf = [&] {
        Canvas canvas(device_, *readablePass_, format_,
                      Enlarging(device_, *wholePass_, format_.color, half, 1, {}));
        addSurfaces(canvas);
        return canvas;
    };
    Halves halves{RenderPass::whole(device_, format_.color,
                                    isCopied ? VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL : finalLayout_),
                  {makeHalf(), makeHalf()},
                  {},
                  extent,
                  width};
    for (const VkImageView picture : pictures)
        halves.pictures.emplace_back(device_, halves.pass.handle(), std::array{picture}, extent, "halves");
    return halves;
}

void Renderer::recordHalves(VkCommandBuffer commands, std::array<std::uint32_t, 2> ofHalves,
                            const Halves& halves, std::size_t picture) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    begin(commands, halves.pass, halves.pictures[picture].handle(), halves.extent, {});
    for (std::size_t half = 0; half < 2; ++half) {
        const VkRect2D place = halves.placeOf(half);
        const VkViewport viewport{
            static_cast<float>(place.offset.x),      0, static_cast<float>(place.extent.width),
            static_cast<float>(place.extent.height), 0, 1};
        functions.vkCmdSetViewport(commands, 0, 1, &viewport);
        functions.vkCmdSetScissor(commands, 0, 1, &place);
        sets_.bind(commands, ofHalves[half]);
        drawScreen(commands, enlargePipeline);
    }
    const VkClearAttachment dark{VK_IMAGE_ASPECT_COLOR_BIT, 0, {.color = {{0.02f, 0.02f, 0.02f, 1}}}};
    const auto clear = [&](std::uint32_t from, std::uint32_t to) {
        const VkClearRect part{
            {{static_cast<std::int32_t>(from), 0}, {to - from, halves.extent.height}}, 0, 1};
        if (to > from) functions.vkCmdClearAttachments(commands, 1, &dark, 1, &part);
    };
    const std::uint32_t middle = halves.width / 2;
    if (middle > 1) clear(middle - 1, middle + 1);
    clear(halves.width, halves.extent.width);
    functions.vkCmdEndRenderPass(commands);
}

} // namespace sinew::viewer
