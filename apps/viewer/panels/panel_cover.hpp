// Where panels are in a picture, so that nobody looks for them elsewhere.
#pragma once

#include "vk/device.hpp"

#include <vector>

struct ImDrawData;

namespace sinew::viewer {

/// As ImDrawCmd::TextureId: rectangles of two triangles that hide what is behind them, whatever their alpha,
/// and are not mixed with it.
inline constexpr std::size_t areaTexture = 2;

/// Rectangles of pixels, none over another.
struct PanelCover {
    std::vector<VkRect2D> areas; ///< of which nothing is seen through
    std::vector<VkRect2D> parts; ///< where else something is, or is close by
};
PanelCover coverOf(const ImDrawData& drawn, VkExtent2D extent);

} // namespace sinew::viewer
