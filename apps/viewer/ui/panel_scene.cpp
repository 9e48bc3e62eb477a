// The scene on show, and the list of scenes.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"

#include <cmath>

namespace sinew::viewer::parts {

std::string galleryLabel(const std::string& scene) {
    return "Scenes: " + scene;
}

// The name of the scene is the button of the gallery, with the arrow of a list.
void scenes(const SceneFacts& scene, const Facts& facts, SceneFields& fields, Wishes& wishes) {
    button(Action::gallery, wishes, contentWidth(), fields.gallery.isOpen, galleryLabel(scene.name).c_str());
    const float line = ImGui::GetTextLineHeight(), pad = ImGui::GetStyle().FramePadding.x;
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    foldMark({to.x - pad - 0.6f * line, from.y + std::floor((to.y - from.y - line) / 2)}, line, true,
             ImGui::GetColorU32(ImGuiCol_Text));
    const float third = buttonWidth(3);
    button(Action::previousScene, wishes, third);
    ImGui::SameLine();
    button(Action::nextScene, wishes, third);
    ImGui::SameLine();
    button(Action::open, wishes, third, fields.files.isShown);
    gallery(facts, fields.gallery, wishes);
}

} // namespace sinew::viewer::parts
