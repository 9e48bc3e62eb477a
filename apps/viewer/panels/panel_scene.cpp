// Which scene is on show, and what can be turned in it.
#include "viewer/panels/panel_parts.hpp"

#include <algorithm>
#include <cstdio>

namespace sinew::viewer::parts {

namespace {

constexpr int mostSubsteps = 1000;

// A quiet name, and on the right of it room for something to turn.
void knob(const char* name) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(quiet(), "%s", name);
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMin().x + 0.38f * contentWidth());
    ImGui::SetNextItemWidth(0.62f * contentWidth());
}

void tip(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

} // namespace

void scenes(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    heading(facts.isOpening ? "scene: opening ..." : "scene");
    const float step = 0.7f * buttonWidth(4), between = ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(contentWidth() - 2 * (step + between));
    if (ImGui::BeginCombo("##scenes", scene.name.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (std::size_t i = 0; i < facts.scenes.size(); ++i)
            if (ImGui::Selectable(facts.scenes[i].c_str(), i == facts.scene)) wishes.scene = i;
        ImGui::EndCombo();
    }
    tip("or drop a scene or a mesh (OBJ, STL, PLY, glTF, GLB) on the window");
    ImGui::SameLine();
    button(Action::previousScene, wishes, step, false, "<");
    ImGui::SameLine();
    button(Action::nextScene, wishes, step, false, ">");
}

void knobs(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    heading("parameters");
    Knobs turned = facts.knobs;
    bool isTurned = false;
    knob("gravity");
    isTurned |= ImGui::SliderFloat("##gravity", &turned.gravity, 0, 20, "%.2f m/s\u00b2");
    tip("acts at once; Ctrl + click to type");
    knob("pace");
    isTurned |= ImGui::SliderFloat("##pace", &turned.pace, 0.05f, 1, "%.2f x real time");
    tip("slow motion; acts at once");
    knob("substeps");
    isTurned |= ImGui::InputInt("##substeps", &turned.substeps, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
    tip("begins the scene anew; 0 = as many as it needs");
    knob("solver");
    const auto solver = static_cast<std::size_t>(turned.solver);
    if (ImGui::BeginCombo("##solver", solver < scene.solvers.size() ? scene.solvers[solver].c_str() : "")) {
        for (std::size_t i = 0; i < scene.solvers.size(); ++i)
            if (ImGui::Selectable(scene.solvers[i].c_str(), i == solver)) {
                turned.solver = static_cast<int>(i);
                isTurned = true;
            }
        ImGui::EndCombo();
    }
    tip("begins the scene anew");
    if (facts.knobs != scene.fromFile && ImGui::Button("As in the file", {contentWidth(), 0})) {
        turned = scene.fromFile;
        isTurned = true;
    }
    turned.substeps = std::clamp(turned.substeps, 0, mostSubsteps);
    turned.gravity = std::clamp(turned.gravity, 0.0f, 1000.0f); // typed
    turned.pace = std::clamp(turned.pace, 0.01f, 1.0f);
    if (isTurned && turned != facts.knobs) wishes.knobs = turned;
}

} // namespace sinew::viewer::parts
