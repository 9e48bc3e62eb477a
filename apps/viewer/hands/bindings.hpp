// The table of all key and mouse bindings of the viewer, from which the window, the help text and the tests
// are made.
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
    quit,
    firstLayer ///< turns the first row of layerTable() to its next look; those of further rows follow
};

/// The layer that an action turns to its next look: index into layerTable().
std::optional<std::size_t> layerOf(Action action);
Action actionOfLayer(std::size_t layer);

/// A user input. `code` and `modifiers` are GLFW's: a key, a mouse button, or 0 for the wheel and for
/// modifiers that are held.
struct Trigger {
    enum class Kind { key, drag, doubleClick, wheel, held } kind = Kind::key;
    int code = 0;
    int modifiers = 0; ///< Shift and Ctrl, for the wheel also Alt; others are ignored
    bool operator==(const Trigger&) const = default;
};

struct Binding {
    Trigger trigger;
    Action action;
    std::string_view shown; ///< name in the help; empty = same as the one before, on another keyboard
    std::string_view help;
    std::string_view button = {}; ///< label in the panels; only for the first binding of an action
};

std::span<const Binding> bindings();

std::optional<Action> actionFor(const Trigger& trigger);

/// One line per action: its triggers and what it does.
struct HelpLine {
    std::string triggers; ///< "Space, P"
    std::string_view help;
};
std::vector<HelpLine> helpLines();
/// The help lines as one text.
std::string helpText();

/// Name of the first key of an action: "Space".
std::string_view keyOf(Action action);
/// One line on the possible actions: with the blade or the sphere, while a body is held, or without a tool.
/// `depth` of the blade [m], empty = through.
enum class Hands { empty, holding, blade, poke };
std::string hintText(Hands hands, bool canCut, const std::optional<float>& depth = {});
/// Depth of a blade: "0.012 m deep", "through".
std::string depthText(const std::optional<float>& depth);
/// For windows without room for hintText(): only how to get help.
std::string shortHintText();

} // namespace sinew::viewer
