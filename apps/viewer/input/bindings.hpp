// The table of all key and mouse bindings of the viewer, from which the window, the help text and the tests
// are made.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::viewer {

struct Tool;

/// All tools of the pointer, in the order of keys and buttons (input/tool.hpp). At most mostTools.
std::span<const Tool* const> toolTable();
constexpr std::size_t mostTools = 8;
/// Index into toolTable().
std::size_t indexOf(const Tool& tool);

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
    drop,
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
    gallery,
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
    firstTool, ///< the key of the first row of toolTable(); those of further rows follow
    firstLayer =
        firstTool +
        mostTools ///< turns the first row of layerTable() to its next look; those of further rows follow
};

/// The layer that an action turns to its next look: index into layerTable().
std::optional<std::size_t> layerOf(Action action);
Action actionOfLayer(std::size_t layer);

/// The tool whose key an action is: index into toolTable().
std::optional<std::size_t> toolOf(Action action);
Action actionOf(const Tool& tool);

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
    std::string_view heading = {}; ///< of the group that begins with this line; empty = the group goes on
};
std::vector<HelpLine> helpLines();
/// The lines with this text in their triggers, their help or the heading of their group; case does not count.
std::vector<HelpLine> helpLines(std::string_view search);
/// The help lines as one text.
std::string helpText();

/// Name of the first key of an action: "Space".
std::string_view keyOf(Action action);
/// Hints one after the other, each with the keys that it is about.
class HintLine {
public:
    void add(std::string_view words, std::initializer_list<Action> keys = {});
    /// All hints, and `last` after them.
    std::string text(const std::string& last) const;
    /// Drops the hint at the right; false if there is none.
    bool drop();

private:
    std::vector<std::string> hints_;
};
/// Facts about the tools for their hints.
struct HintFacts {
    std::optional<std::size_t> inUse;     ///< index into toolTable(); empty = none
    std::array<bool, mostTools> canUse{}; ///< in this scene, by that index
    std::optional<float> setting;         ///< of the one in use
    bool canUndo = false;                 ///< whether there is a cut to undo
    std::string_view awaited = {};        ///< what the next press does, if a button waits for it
};
/// One line on the possible actions. Hints are dropped from the right until `fits` is true; the key of the
/// help stays.
std::string hintText(const HintFacts& facts, const std::function<bool(const std::string&)>& fits = {});

} // namespace sinew::viewer
