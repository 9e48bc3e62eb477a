// The scene on show, and the list of scenes.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"

namespace sinew::viewer::parts {

// The name of the scene is the button of the gallery.
void scenes(const SceneFacts& scene, const Facts& facts, SceneFields& fields, Wishes& wishes) {
    const float step = 0.7f * buttonWidth(4), between = ImGui::GetStyle().ItemSpacing.x;
    button(Action::gallery, wishes, contentWidth() - 3 * (step + between), fields.gallery.isOpen,
           scene.name.c_str());
    ImGui::SameLine();
    button(Action::previousScene, wishes, step, false, "<");
    ImGui::SameLine();
    button(Action::nextScene, wishes, step, false, ">");
    ImGui::SameLine();
    button(Action::open, wishes, step, fields.files.isShown);
    gallery(facts, fields.gallery, wishes);
}

} // namespace sinew::viewer::parts
