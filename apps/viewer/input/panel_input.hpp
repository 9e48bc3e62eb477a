// Pointer and keyboard events that belong to the panels; the window does not pass them to the scene.
#pragma once

#include "viewer/render/geometry.hpp"

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace sinew::viewer {

struct PanelInput {
    Vector2 pointer = Vector2::Constant(-1); ///< from the upper left corner [pixels]
    std::array<bool, 3> isDown{};            ///< left, right, middle; pressed over a panel
    std::array<int, 3> presses{};            ///< since the last picture, even if already released
    float notches = 0;                       ///< of the wheel, over a panel
    std::vector<unsigned> characters;        ///< typed into a panel
    std::vector<std::pair<int, bool>> keys;  ///< GLFW keys; true = pressed
    int modifiers = 0;                       ///< GLFW modifiers
    bool isTouched = false;                  ///< whether panels may look different now
};

/// Decides, before each event, whether it belongs to the panels.
struct Cover {
    std::function<bool(const Vector2& pixels)> holds = [](const Vector2&) { return false; };
    std::function<bool()> takesKeys = [] { return false; };
    std::function<bool()> takesLetters = [] { return false; }; ///< of keys only those that type a letter
};

} // namespace sinew::viewer
