// The table of bindings.
#include "viewer/bindings.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace sinew::viewer {

namespace {

using enum Action;
constexpr auto key = Trigger::Kind::key, drag = Trigger::Kind::drag, wheel = Trigger::Kind::wheel;

// Bindings of one action stand together; the first one's help is the one that is shown.
constexpr std::array table{
    Binding{{drag, GLFW_MOUSE_BUTTON_LEFT}, grab, "left drag", "on a body: grab and pull; beside: orbit"},
    Binding{{drag, GLFW_MOUSE_BUTTON_RIGHT}, orbit, "right drag", "orbit"},
    Binding{{drag, GLFW_MOUSE_BUTTON_MIDDLE}, pan, "middle drag", "pan"},
    Binding{{drag, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOD_SHIFT}, pan, "Shift + right drag", "pan"},
    Binding{{wheel}, zoom, "wheel", "zoom to the pointer"},
    Binding{{key, GLFW_KEY_F}, frame, "F", "frame everything"},
    Binding{{key, GLFW_KEY_HOME}, frame, "Home", "frame everything"},
    Binding{{key, GLFW_KEY_SPACE}, pause, "Space", "pause or go on"},
    Binding{{key, GLFW_KEY_P}, pause, "P", "pause or go on"},
    Binding{{key, GLFW_KEY_PERIOD}, step, ".", "pause and take one step"},
    Binding{{key, GLFW_KEY_R}, reset, "R", "reset the scene"},
    Binding{{key, GLFW_KEY_C}, blade, "C", "blade: left drag cuts, from the front through to the back"},
    Binding{{key, GLFW_KEY_ESCAPE}, drop, "Esc", "drop the blade, let go"},
    Binding{{key, GLFW_KEY_Z, GLFW_MOD_CONTROL}, undo, "Ctrl + Z", "undo a cut: back to before it"},
    Binding{{key, GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT}, redo, "Shift + Ctrl + Z", "redo it"},
    Binding{{key, GLFW_KEY_F12}, screenshot, "F12", "save a picture (PNG) in the current folder"},
    Binding{{key, GLFW_KEY_F11}, fullScreen, "F11", "full screen"},
    Binding{{key, GLFW_KEY_V}, vsync, "V", "wait for the screen (vsync) or not"},
    Binding{{key, GLFW_KEY_H}, help, "H", "print this help"},
    Binding{{key, GLFW_KEY_F1}, help, "F1", "print this help"},
    Binding{{key, GLFW_KEY_Q, GLFW_MOD_CONTROL}, quit, "Ctrl + Q", "quit"},
};

} // namespace

std::span<const Binding> bindings() {
    return table;
}

std::optional<Action> actionFor(const Trigger& trigger) {
    Trigger known = trigger;
    known.modifiers &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL;
    const auto* found = std::ranges::find(table, known, &Binding::trigger);
    return found == table.end() ? std::nullopt : std::optional(found->action);
}

std::string helpText() {
    std::string text;
    for (const auto* line = table.begin(); line != table.end();) {
        std::string triggers(line->shown);
        const auto* next = line + 1;
        for (; next != table.end() && next->action == line->action; ++next)
            triggers.append(", ").append(next->shown);
        triggers.resize(std::max<std::size_t>(triggers.size() + 2, 34), ' ');
        text.append("  ").append(triggers).append(line->help).append("\n");
        line = next;
    }
    return text;
}

} // namespace sinew::viewer
