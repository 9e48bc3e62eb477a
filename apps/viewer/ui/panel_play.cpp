// Buttons for the actions of keys.
#include "viewer/ui/panel_parts.hpp"

#include <cstdio>
#include <initializer_list>

namespace sinew::viewer::parts {

namespace {

// Text such as "12.34 s, step 740".
std::string timeText(const Facts& facts) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f s, step %llu", facts.time,
                  static_cast<unsigned long long>(facts.steps));
    return text;
}

// Buttons, `inALine` in a line.
void buttons(std::initializer_list<Action> actions, std::size_t inALine, Wishes& wishes) {
    const float width = buttonWidth(inALine);
    std::size_t count = 0;
    for (const Action action : actions) {
        if (count++ % inALine != 0) ImGui::SameLine();
        button(action, wishes, width);
    }
}

} // namespace

void play(const Facts& facts, Wishes& wishes) {
    row("time", timeText(facts));
    const float width = buttonWidth(4);
    button(Action::pause, wishes, width, facts.isPaused, facts.isPaused ? "Play" : "Pause");
    ImGui::SameLine();
    button(Action::stepBack, wishes, width);
    ImGui::SameLine();
    button(Action::step, wishes, width);
    ImGui::SameLine();
    button(Action::slowMotion, wishes, width, facts.knobs.pace < 1);
    if (facts.isDiverged)
        wrapped("The simulation became unstable. Press " + std::string(keyOf(Action::reset)) + ".", bad());
}

void camera(Wishes& wishes) {
    buttons({Action::frame, Action::frameBody, Action::center}, 3, wishes);
}

void files(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    const float width = buttonWidth(2);
    button(Action::screenshot, wishes, width);
    ImGui::SameLine();
    button(Action::record, wishes, width, facts.recorded.has_value(), facts.recorded ? "Stop" : nullptr,
           scene.isSoftware && !facts.recorded ? slowRecording : std::string_view());
    buttons({Action::saveState, Action::saveInput}, 2, wishes);
}

void window(const Facts& facts, Wishes& wishes) {
    const float width = buttonWidth(3);
    button(Action::help, wishes, width);
    ImGui::SameLine();
    button(Action::fullScreen, wishes, width);
    ImGui::SameLine();
    button(Action::vsync, wishes, width, facts.isVsync);
    buttons({Action::largerTexts, Action::smallerTexts, Action::panels}, 3, wishes);
    buttons({Action::times, Action::quit}, 2, wishes);
}

} // namespace sinew::viewer::parts
