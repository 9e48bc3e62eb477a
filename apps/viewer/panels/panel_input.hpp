// The pointer and the keyboard as far as they belong to the panels: what the window keeps back from the
// scene.
#pragma once

#include "viewer/draw/geometry.hpp"

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace sinew::viewer {

struct PanelInput {
    Vector2 pointer = Vector2::Constant(-1); ///< from the upper left corner [pixels]
    std::array<bool, 3> isDown{};            ///< left, right, middle; pressed over a panel
    std::array<int, 3> presses{};            ///< since the last picture, even if it is up again
    float notches = 0;                       ///< of the wheel, over a panel
    std::vector<unsigned> characters;        ///< typed into a panel
    std::vector<std::pair<int, bool>> keys;  ///< GLFW's, and whether they went down
    int modifiers = 0;                       ///< GLFW's
    bool isTouched = false;                  ///< whether a panel may look different now
};

/// What lies over the scene, asked before each event is given to the scene.
struct Cover {
    std::function<bool(const Vector2& pixels)> holds = [](const Vector2&) { return false; };
    std::function<bool()> takesKeys = [] { return false; };
};

} // namespace sinew::viewer
