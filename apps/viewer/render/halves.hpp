// Two pictures side by side in one: each half is drawn into its own canvas, then copied to its place.
#pragma once

#include "viewer/render/canvas.hpp"

#include <array>

namespace sinew::viewer {

/// Made by Renderer::makeHalves. Movable. Must not outlive its Device; the picture views belong to the caller
/// and must outlive it.
struct Halves {
    RenderPass pass; ///< copies both halves to their places
    std::array<Canvas, 2> canvases;
    std::vector<Framebuffer> pictures;
    VkExtent2D extent;   ///< of the pictures
    std::uint32_t width; ///< of both halves, from the left; the rest is dark [pixels]
    /// The place of a half; both are equally wide.
    VkRect2D placeOf(std::size_t half) const noexcept {
        const VkExtent2D own = canvases[half].extent();
        return {{half == 0 ? 0 : static_cast<std::int32_t>(width - own.width), 0}, own};
    }
};

} // namespace sinew::viewer
