// Icons as vector shapes: sharp at every scale, without a font or an image.
#pragma once

#include "viewer/input/icon.hpp"

#include <imgui.h>

namespace sinew::viewer {

/// Adds an icon to a list, in a square of `size` pixels with its upper left corner at `from`. Draws nothing
/// for Icon::none.
void drawIcon(ImDrawList& list, Icon icon, const ImVec2& from, float size, ImU32 color);

} // namespace sinew::viewer
