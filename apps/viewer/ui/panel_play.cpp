// Buttons for the actions of keys.
#include "viewer/input/tool.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <cstdio>

namespace sinew::viewer::parts {

namespace {

// Text such as "12.34 s, step 740".
std::string timeText(const Facts& facts) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f s, step %llu", facts.time,
                  static_cast<unsigned long long>(facts.steps));
    return text;
}

// Four buttons a line; the last one is that of Esc.
void tools(const Facts& facts, Wishes& wishes) {
    constexpr std::size_t inALine = 4;
    const float width = buttonWidth(inALine);
    std::size_t count = 0;
    for (std::size_t i = 0; i < toolTable().size(); ++i) {
        if (toolTable()[i]->key == 0) continue;
        button(actionOf(*toolTable()[i]), wishes, width, facts.toolsOn[i]);
        if (++count % inALine != 0) ImGui::SameLine();
    }
    button(Action::drop, wishes, width);
}

} // namespace

void play(const Facts& facts, Wishes& wishes) {
    row("time", timeText(facts));
    float width = buttonWidth(5);
    button(Action::pause, wishes, width, facts.isPaused, facts.isPaused ? "Go on" : "Pause");
    ImGui::SameLine();
    button(Action::stepBack, wishes, width);
    ImGui::SameLine();
    button(Action::step, wishes, width);
    ImGui::SameLine();
    button(Action::reset, wishes, width);
    ImGui::SameLine();
    button(Action::slowMotion, wishes, width, facts.knobs.pace < 1);
    tools(facts, wishes);
    width = buttonWidth(3);
    button(Action::frame, wishes, width);
    ImGui::SameLine();
    button(Action::frameBody, wishes, width);
    ImGui::SameLine();
    button(Action::center, wishes, width);
    width = buttonWidth(4);
    button(Action::screenshot, wishes, width);
    ImGui::SameLine();
    button(Action::record, wishes, width, facts.recorded.has_value(), facts.recorded ? "Stop" : nullptr);
    ImGui::SameLine();
    button(Action::saveInput, wishes, width);
    ImGui::SameLine();
    button(Action::saveState, wishes, width);
    button(Action::times, wishes, width);
    ImGui::SameLine();
    button(Action::vsync, wishes, width, facts.isVsync);
    ImGui::SameLine();
    button(Action::fullScreen, wishes, width);
    ImGui::SameLine();
    button(Action::help, wishes, width);
    button(Action::largerTexts, wishes, width);
    ImGui::SameLine();
    button(Action::smallerTexts, wishes, width);
    ImGui::SameLine();
    button(Action::panels, wishes, width);
    ImGui::SameLine();
    button(Action::quit, wishes, width);
    if (facts.isDiverged)
        wrapped("Diverged: the last finite state was kept. " + std::string(keyOf(Action::reset)) + " resets.",
                bad());
}

} // namespace sinew::viewer::parts
