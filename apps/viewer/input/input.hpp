// The input of the window since the last poll.
#pragma once

#include "viewer/input/bindings.hpp"
#include "viewer/input/panel_input.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

/// Events since the last poll, as actions: keys and buttons are already looked up in the table of bindings.
struct Input {
    struct Drag {
        Action action;
        Vector2 heights; ///< x right, y down, in window heights
    };
    /// A press or release of a button that drags.
    struct Press {
        Action action;
        bool isDown;
        Vector2 pointer; ///< see `pointer` below
    };
    std::vector<Action> actions;
    std::vector<Press> presses;
    std::vector<Drag> drags;
    std::vector<std::string> files;    ///< dropped on the window
    float notches = 0;                 ///< of the wheel, forwards positive
    float growth = 0;                  ///< of the wheel for the setting of a tool, forwards positive
    float slide = 0;                   ///< of the wheel for the section plane, forwards positive
    Vector2 pointer = Vector2::Zero(); ///< from the middle, x right, y down, in window heights
    std::optional<Action> held;        ///< by modifiers alone
    bool needsRedraw = false;          ///< resized or uncovered
    PanelInput panels;                 ///< all other events
    bool isEmpty() const {
        return actions.empty() && presses.empty() && drags.empty() && files.empty() && notches == 0 &&
               growth == 0 && slide == 0 && !needsRedraw;
    }
};

} // namespace sinew::viewer
