// The table of bindings.
#include "viewer/input/bindings.hpp"

#include "viewer/input/tool.hpp"
#include "viewer/render/layer.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace sinew::viewer {

namespace {

using enum Action;
constexpr auto key = Trigger::Kind::key, drag = Trigger::Kind::drag, wheel = Trigger::Kind::wheel,
               doubleClick = Trigger::Kind::doubleClick, held = Trigger::Kind::held;

// A phrase for each tool that has one, such as Tool::letGo.
std::string phrases(std::string_view Tool::*phrase, std::string_view between) {
    std::string all;
    for (const Tool* tool : toolTable()) {
        const std::string_view words = tool->*phrase;
        if (!words.empty()) all.append(all.empty() ? "" : between).append(words);
    }
    return all;
}

const std::string settingsHelp = phrases(&Tool::settingHelp, "; "), letGoHelp = phrases(&Tool::letGo, ", ");

// Bindings of one action are adjacent; the help shows the text of the first one.
const std::array beforeTools{
    Binding{{drag, GLFW_MOUSE_BUTTON_LEFT}, grab, "left drag", "on a body: grab; elsewhere: orbit"},
    Binding{{drag, GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_CONTROL}, grab, "", "on a body: grab; elsewhere: orbit"},
    Binding{{drag, GLFW_MOUSE_BUTTON_RIGHT}, orbit, "right drag", "orbit"},
    Binding{{drag, GLFW_MOUSE_BUTTON_MIDDLE}, pan, "middle drag", "pan"},
    Binding{{drag, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOD_SHIFT}, pan, "Shift + right drag", "pan"},
    Binding{{wheel}, zoom, "wheel", "zoom to the pointer"},
    Binding{{wheel, 0, GLFW_MOD_SHIFT}, toolSize, "Shift + wheel", settingsHelp},
    Binding{{wheel, 0, GLFW_MOD_ALT}, moveSection, "Alt + wheel", "move the section plane"},
    Binding{{doubleClick, GLFW_MOUSE_BUTTON_LEFT},
            center,
            "double click",
            "on a body: orbit around that point",
            "Orbit point"},
    Binding{{key, GLFW_KEY_F}, frameBody, "F", "frame the body under the pointer", "Frame body"},
    Binding{{key, GLFW_KEY_HOME}, frame, "Home", "frame everything", "Frame all"},
    Binding{{key, GLFW_KEY_SPACE}, pause, "Space", "pause or continue", "Pause"},
    Binding{{key, GLFW_KEY_P}, pause, "P", "pause or continue"},
    Binding{{key, GLFW_KEY_PERIOD}, step, "period (.)", "pause and take one step", "Step"},
    Binding{{key, GLFW_KEY_COMMA}, stepBack, "comma (,)", "pause and undo one step", "Back"},
    Binding{{key, GLFW_KEY_R}, reset, "R", "reset the scene", "Reset"},
    Binding{{key, GLFW_KEY_S}, slowMotion, "S", "slow motion: 1/2, 1/4, 1/8, full speed", "Slower"},
};

const std::array afterTools{
    Binding{{key, GLFW_KEY_ESCAPE}, drop, "Esc", letGoHelp, "Release"},
    Binding{{key, GLFW_KEY_Z, GLFW_MOD_CONTROL}, undo, "Ctrl + Z", "undo the last cut", "Undo"},
    Binding{{key, GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT},
            redo,
            "Shift + Ctrl + Z",
            "redo the cut",
            "Redo"},
    Binding{{key, GLFW_KEY_K}, stiffer, "K", "stiffer: all bodies, or the one in the panel"},
    Binding{{key, GLFW_KEY_K, GLFW_MOD_SHIFT}, softer, "Shift + K", "softer"},
    Binding{{key, GLFW_KEY_D}, moreDamping, "D", "more damping"},
    Binding{{key, GLFW_KEY_D, GLFW_MOD_SHIFT}, lessDamping, "Shift + D", "less damping"},
    Binding{{key, GLFW_KEY_T}, moreFriction, "T", "more friction"},
    Binding{{key, GLFW_KEY_T, GLFW_MOD_SHIFT}, lessFriction, "Shift + T", "less friction"},
    Binding{{key, GLFW_KEY_G}, moreGravity, "G", "more gravity"},
    Binding{{key, GLFW_KEY_G, GLFW_MOD_SHIFT}, lessGravity, "Shift + G", "less gravity"},
};

constexpr std::array afterLayers{
    Binding{{key, GLFW_KEY_I},
            inspect,
            "I",
            "inspect under the pointer: body, particle, speed, strain, contacts",
            "Inspect"},
    Binding{{key, GLFW_KEY_B},
            beside,
            "B",
            "compare with a second solver side by side: speed and error",
            "Compare"},
    Binding{
        {key, GLFW_KEY_L}, section, "L", "section: a plane opens bodies and shows their inside", "Section"},
    Binding{{key, GLFW_KEY_L, GLFW_MOD_SHIFT},
            turnSection,
            "Shift + L",
            "turn the section plane to the next axis",
            "Section axis"},
    Binding{{key, GLFW_KEY_L, GLFW_MOD_CONTROL},
            faceSection,
            "Ctrl + L",
            "turn the section plane towards the eye",
            "Section to the eye"},
    Binding{{key, GLFW_KEY_PAGE_UP}, previousScene, "Page Up", "open the previous scene", "Previous"},
    Binding{{key, GLFW_KEY_PAGE_DOWN}, nextScene, "Page Down", "open the next scene", "Next"},
    Binding{{key, GLFW_KEY_F2},
            gallery,
            "F2",
            "gallery: pictures of all scenes, and files opened last",
            "Gallery"},
    Binding{{key, GLFW_KEY_O, GLFW_MOD_CONTROL},
            open,
            "Ctrl + O",
            "open a file: a scene, a mesh or a saved state",
            "Open"},
    Binding{{key, GLFW_KEY_F9},
            record,
            "F9",
            "record a film in the current folder: a video, or pictures without ffmpeg; again: stop",
            "Record"},
    Binding{
        {key, GLFW_KEY_F12}, screenshot, "F12", "save a picture (PNG) in the current folder", "Screenshot"},
    Binding{{key, GLFW_KEY_F8},
            saveInput,
            "F8",
            "save all you did since the last reset to a file; --replay FILE plays it back",
            "Save actions"},
    Binding{{key, GLFW_KEY_S, GLFW_MOD_CONTROL},
            saveState,
            "Ctrl + S",
            "save the state in the current folder; open it or drop it here to continue",
            "Save state"},
    Binding{{key, GLFW_KEY_F7}, times, "F7", "print the frame times since the last print", "Frame times"},
    Binding{{key, GLFW_KEY_F11}, fullScreen, "F11", "full screen", "Full screen"},
    Binding{{key, GLFW_KEY_V}, vsync, "V", "turn vsync on or off", "Vsync"},
    Binding{{key, GLFW_KEY_EQUAL, GLFW_MOD_CONTROL}, largerTexts, "Ctrl + plus", "larger text", "Text +"},
    Binding{{key, GLFW_KEY_EQUAL, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT}, largerTexts, "", "larger text"},
    Binding{{key, '+', GLFW_MOD_CONTROL}, largerTexts, "", "larger text"}, // on layouts with a key for +
    Binding{{key, GLFW_KEY_MINUS, GLFW_MOD_CONTROL}, smallerTexts, "Ctrl + minus", "smaller text", "Text -"},
    Binding{{key, GLFW_KEY_TAB}, panels, "Tab", "show or hide the panels", "Hide panel"},
    Binding{{key, GLFW_KEY_H}, help, "H", "show or hide this help", "Help"},
    Binding{{key, GLFW_KEY_F1}, help, "F1", "show or hide this help"},
    Binding{{key, GLFW_KEY_Q, GLFW_MOD_CONTROL}, quit, "Ctrl + Q", "quit", "Quit"},
};

// GLFW's codes of digits and letters are their characters.
std::vector<Binding> allBindings() {
    std::vector<Binding> all(beforeTools.begin(), beforeTools.end());
    for (const Tool* tool : toolTable()) {
        if (tool->key == 0) continue;
        const Action action = actionOf(*tool);
        all.push_back({{key, tool->key}, action, {&tool->key, 1}, tool->help, tool->button});
        if (tool->isLent) all.push_back({{held, 0, GLFW_MOD_CONTROL}, action, "Ctrl held", tool->help});
    }
    all.insert(all.end(), afterTools.begin(), afterTools.end());
    for (std::size_t i = 0; i < layerTable().size(); ++i) {
        const Layer& layer = *layerTable()[i];
        all.push_back({{key, layer.key}, actionOfLayer(i), {&layer.key, 1}, layer.help, layer.button});
    }
    all.insert(all.end(), afterLayers.begin(), afterLayers.end());
    return all;
}

const std::vector<Binding> table = allBindings();

} // namespace

std::optional<std::size_t> toolOf(Action action) {
    const auto index = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::firstTool);
    return index < toolTable().size() ? std::optional(index) : std::nullopt;
}

Action actionOf(const Tool& tool) {
    return static_cast<Action>(static_cast<std::size_t>(Action::firstTool) + indexOf(tool));
}

std::optional<std::size_t> layerOf(Action action) {
    const auto index = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::firstLayer);
    return index < layerTable().size() ? std::optional(index) : std::nullopt;
}

Action actionOfLayer(std::size_t layer) {
    return static_cast<Action>(static_cast<std::size_t>(Action::firstLayer) + layer);
}

std::span<const Binding> bindings() {
    return table;
}

std::optional<Action> actionFor(const Trigger& trigger) {
    Trigger known = trigger;
    const int ofWheel = trigger.kind == Trigger::Kind::wheel ? GLFW_MOD_ALT : 0;
    known.modifiers &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | ofWheel;
    const auto found = std::ranges::find(table, known, &Binding::trigger);
    return found == table.end() ? std::nullopt : std::optional(found->action);
}

namespace {

// Groups of the help, by their first actions in the order of the table.
std::string_view headingAt(Action action) {
    if (action == actionOfLayer(0)) return "View and compare";
    switch (action) {
    case grab:
        return "Pointer and camera";
    case pause:
        return "Time";
    case stiffer:
        return "Material and gravity";
    case previousScene:
        return "Scenes, files, recording";
    case times:
        return "Window";
    default:
        return toolOf(action) == std::optional<std::size_t>(0) ? "Tools" : "";
    }
}

} // namespace

std::vector<HelpLine> helpLines() {
    std::vector<HelpLine> lines;
    for (auto line = table.begin(); line != table.end();) {
        std::string triggers(line->shown);
        auto next = line + 1;
        for (; next != table.end() && next->action == line->action; ++next)
            if (!next->shown.empty()) triggers.append(", ").append(next->shown);
        lines.push_back({std::move(triggers), line->help, headingAt(line->action)});
        line = next;
    }
    return lines;
}

std::vector<HelpLine> helpLines(std::string_view search) {
    const auto contains = [search](std::string_view text) {
        const auto isSame = [](unsigned char a, unsigned char b) {
            return std::tolower(a) == std::tolower(b);
        };
        return !std::ranges::search(text, search, isSame).empty() || search.empty();
    };
    std::vector<HelpLine> found;
    std::string_view group, open; // headings: of this line, and of the last one that was found
    for (HelpLine& line : helpLines()) {
        if (!line.heading.empty()) group = line.heading;
        if (!contains(line.triggers) && !contains(line.help) && !contains(group)) continue;
        line.heading = std::exchange(open, group) == group ? "" : group;
        found.push_back(std::move(line));
    }
    return found;
}

std::string helpText() {
    std::string text;
    for (HelpLine& line : helpLines()) {
        if (!line.heading.empty()) text.append(line.heading).append(":\n");
        line.triggers.resize(std::max<std::size_t>(line.triggers.size() + 2, 34), ' ');
        text.append("  ").append(line.triggers).append(line.help).append("\n");
    }
    return text;
}

std::string_view keyOf(Action action) {
    const auto found = std::ranges::find(table, action, &Binding::action);
    return found == table.end() ? std::string_view() : found->shown;
}

void HintLine::add(std::string_view words, std::initializer_list<Action> keys) {
    std::string hint;
    for (const Action action : keys) hint.append(hint.empty() ? "" : " or ").append(keyOf(action));
    hints_.push_back(hint.append(hint.empty() ? "" : " ").append(words));
}

std::string HintLine::text(const std::string& last) const {
    std::string text;
    for (const std::string& hint : hints_) text.append(hint).append("   \u00b7   ");
    return text + last;
}

bool HintLine::drop() {
    if (hints_.empty()) return false;
    hints_.pop_back();
    return true;
}

namespace {

// While nothing is in use: what a drag does, and undo once there is something to undo. The help has the rest.
void addOffers(HintLine& line, const HintFacts& facts) {
    for (const bool isOfKey : {false, true}) // first that of the tool without a key
        for (std::size_t i = 0; i < toolTable().size(); ++i) {
            const Tool& tool = *toolTable()[i];
            const bool isOffered = !tool.offer.empty() && (tool.key == 0 || facts.canUse[i]);
            if (isOffered && (tool.key != 0) == isOfKey) line.add(tool.offer);
        }
    if (facts.canUndo) line.add("undoes", {undo});
}

void addOffersHeld(HintLine& line, const HintFacts& facts) {
    for (std::size_t i = 0; i < toolTable().size(); ++i)
        if (const Tool& tool = *toolTable()[i]; facts.canUse[i] && !tool.offerHeld.empty())
            line.add(tool.offerHeld, {actionOf(tool)});
}

HintLine hintsOf(const HintFacts& facts) {
    HintLine line;
    if (!facts.awaited.empty()) {
        line.add(facts.awaited);
        line.add("cancels", {drop});
        return line;
    }
    if (facts.inUse) {
        const Tool& tool = *toolTable()[*facts.inUse];
        if (tool.addHints != nullptr) tool.addHints(line, facts.setting);
        if (tool.key == 0) addOffersHeld(line, facts);
        line.add("panels", {Action::panels});
    } else {
        addOffers(line, facts);
    }
    return line;
}

} // namespace

std::string hintText(const HintFacts& facts, const std::function<bool(const std::string&)>& fits) {
    HintLine line = hintsOf(facts);
    const std::string last = std::string(keyOf(help)) + " help";
    while (fits && !fits(line.text(last)) && line.drop()) {
    }
    return line.text(last);
}

} // namespace sinew::viewer
