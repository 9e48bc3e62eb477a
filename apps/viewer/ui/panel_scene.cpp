// The scene on show, and the list of scenes.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"

#include <cstdlib>
#include <string>
#include <utility>

namespace sinew::viewer::parts {

namespace {

// Expands ~/ like a shell.
std::string expanded(const char* path) {
    const char* home = std::getenv("HOME");
    const bool isOfHome = path[0] == '~' && path[1] == '/' && home != nullptr;
    return isOfHome ? std::string(home) + (path + 1) : path;
}

// A text field for a path: Enter opens it; Esc or a click elsewhere closes the field.
void pathLine(PathField& path, Wishes& wishes) {
    if (!path.isShown) return;
    if (std::exchange(path.wantsKeys, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(contentWidth());
    const bool isEntered =
        ImGui::InputTextWithHint("##path", "path of a scene, mesh or state", path.text.data(),
                                 path.text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    if (isEntered && path.text[0] != '\0') wishes.file = expanded(path.text.data());
    if (isEntered || ImGui::IsItemDeactivated()) path.isShown = false;
}

} // namespace

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
    button(Action::open, wishes, step, fields.path.isShown);
    pathLine(fields.path, wishes);
    gallery(facts, fields.gallery, wishes);
}

} // namespace sinew::viewer::parts
