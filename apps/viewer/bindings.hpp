// Every key and mouse binding of the viewer, in one table: the window, the help text and the tests are made
// from it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sinew::viewer {

enum class Action {
    grab,
    orbit,
    pan,
    zoom,
    frame,
    pause,
    step,
    reset,
    blade,
    drop,
    undo,
    redo,
    screenshot,
    fullScreen,
    vsync,
    help,
    quit
};

/// What a hand does. `code` and `modifiers` are GLFW's: a key, a mouse button, or nothing for the wheel.
struct Trigger {
    enum class Kind { key, drag, wheel } kind = Kind::key;
    int code = 0;
    int modifiers = 0; ///< of Shift and Ctrl; others are ignored
    bool operator==(const Trigger&) const = default;
};

struct Binding {
    Trigger trigger;
    Action action;
    std::string_view shown; ///< how the help text names it
    std::string_view help;
};

std::span<const Binding> bindings();

std::optional<Action> actionFor(const Trigger& trigger);

/// One line per action: its triggers and what it does.
std::string helpText();

} // namespace sinew::viewer
