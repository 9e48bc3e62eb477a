// The areas of a picture that panels cover, so that only these are blended.
#pragma once

#include "sinew/vk/device.hpp"

#include <vector>

struct ImDrawData;

namespace sinew::viewer {

/// Texture id (ImDrawCmd::TextureId) of opaque rectangles of two triangles: they replace what is behind them,
/// whatever their alpha, without blending.
inline constexpr std::size_t areaTexture = 2;

/// Disjoint rectangles of pixels.
struct PanelCover {
    std::vector<VkRect2D> areas; ///< opaque areas
    std::vector<VkRect2D> parts; ///< other areas with triangles, or near them
};
PanelCover coverOf(const ImDrawData& drawn, VkExtent2D extent);

} // namespace sinew::viewer
