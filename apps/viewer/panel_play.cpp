// Buttons for everything that a key does.
#include "viewer/panel_parts.hpp"

#include <cstdio>

namespace sinew::viewer::parts {

namespace {

// "12.34 s, step 740".
std::string timeText(const Facts& facts) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f s, step %llu", facts.time,
                  static_cast<unsigned long long>(facts.steps));
    return text;
}

} // namespace

void play(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    heading(scene.name.c_str());
    row("time", timeText(facts));
    float width = buttonWidth(3);
    button(Action::pause, wishes, width, facts.isPaused, facts.isPaused ? "Go on" : "Pause");
    ImGui::SameLine();
    button(Action::step, wishes, width);
    ImGui::SameLine();
    button(Action::reset, wishes, width);
    button(Action::blade, wishes, width, facts.isBladeOn);
    ImGui::SameLine();
    button(Action::drop, wishes, width);
    ImGui::SameLine();
    button(Action::frame, wishes, width);
    button(Action::screenshot, wishes, width);
    ImGui::SameLine();
    button(Action::vsync, wishes, width, facts.isVsync);
    ImGui::SameLine();
    button(Action::fullScreen, wishes, width);
    button(Action::help, wishes, width);
    ImGui::SameLine();
    button(Action::panels, wishes, width);
    ImGui::SameLine();
    button(Action::quit, wishes, width);
    if (facts.isDiverged)
        wrapped("Diverged: the last finite state was kept. " + std::string(keyOf(Action::reset)) + " resets.",
                bad());
}

} // namespace sinew::viewer::parts
