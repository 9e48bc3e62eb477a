// Every key and mouse binding of the viewer, in one table: the window, the help text and the tests are made
// from it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::viewer {

enum class Action {
    grab,
    orbit,
    pan,
    zoom,
    toolSize,
    moveSection,
    center,
    frameBody,
    frame,
    pause,
    step,
    stepBack,
    reset,
    blade,
    poke,
    drop,
    pin,
    undo,
    redo,
    slowMotion,
    stiffer,
    softer,
    moreDamping,
    lessDamping,
    moreFriction,
    lessFriction,
    moreGravity,
    lessGravity,
    previousScene,
    nextScene,
    open,
    skinLook,
    wires,
    balls,
    links,
    contacts,
    cells,
    colorMap,
    inspect,
    beside,
    section,
    turnSection,
    faceSection,
    screenshot,
    record,
    saveInput,
    saveState,
    times,
    fullScreen,
    vsync,
    largerTexts,
    smallerTexts,
    panels,
    help,
    quit
};

/// What a hand does. `code` and `modifiers` are GLFW's: a key, a mouse button, or nothing for the wheel and
/// for modifiers that are held.
struct Trigger {
    enum class Kind { key, drag, doubleClick, wheel, held } kind = Kind::key;
    int code = 0;
    int modifiers = 0; ///< of Shift and Ctrl, of the wheel Alt too; others are ignored
    bool operator==(const Trigger&) const = default;
};

struct Binding {
    Trigger trigger;
    Action action;
    std::string_view shown; ///< how the help names it; empty = as the one before, on another keyboard
    std::string_view help;
    std::string_view button = {}; ///< what its button in the panels says; only the first of an action has one
};

std::span<const Binding> bindings();

std::optional<Action> actionFor(const Trigger& trigger);

/// One line per action: its triggers and what it does.
struct HelpLine {
    std::string triggers; ///< "Space, P"
    std::string_view help;
};
std::vector<HelpLine> helpLines();
/// The same as text.
std::string helpText();

/// How the first key of an action is shown: "Space".
std::string_view keyOf(Action action);
/// What can be done now, in a line: with the blade or the sphere in hand, while a body is held, or with empty
/// hands; `depth` of the blade [m], nothing = through.
enum class Hands { empty, holding, blade, poke };
std::string hintText(Hands hands, bool canCut, const std::optional<float>& depth = {});
/// How deep a blade goes: "0.012 m deep", "through".
std::string depthText(const std::optional<float>& depth);
/// Where there is no room for it: how to get help.
std::string shortHintText();

} // namespace sinew::viewer
