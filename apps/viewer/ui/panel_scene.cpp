// The scene on show, and the list of scenes.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"
#include "viewer/ui/picture_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace sinew::viewer::parts {

namespace {

constexpr float listWidth = 2; // of the list of scenes, in widths of the panel

// Draws the preview of a scene, or requests it, if the sheet has room for it.
void preview(const Facts& facts, std::size_t scene, const ImVec2& from, const ImVec2& to, Wishes& wishes) {
    const std::size_t count = facts.previews.size();
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (scene >= count || !facts.previews[scene]) {
        list->AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg));
        if (scene < count) wishes.previews->push_back(scene);
        return;
    }
    const auto row = [count](std::size_t i) { return static_cast<float>(i) / static_cast<float>(count); };
    list->AddImage(reinterpret_cast<ImTextureID>(sheetTexture), from, to, {0, row(scene)},
                   {1, row(scene + 1)});
}

// The name of a scene, and below it what happens there in at most two lines.
void sceneText(const Facts& facts, std::size_t scene, ImVec2 at, float height) {
    const float line = ImGui::GetTextLineHeight();
    const float room = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x - at.x;
    const std::string sentence = scene < facts.sentences.size() ? facts.sentences[scene] : "";
    const float lines =
        sentence.empty()
            ? 1
            : 1 + std::min(2.0f,
                           std::ceil(ImGui::CalcTextSize(sentence.c_str(), nullptr, false, room).y / line));
    at.y += std::round((height - lines * line) / 2);
    const ImVec4 color = scene == facts.scene ? accent() : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(at, ImGui::GetColorU32(color), facts.scenes[scene].c_str());
    if (sentence.empty() || room < line) return;
    const ImVec4 clip{at.x, at.y, at.x + room, at.y + lines * line};
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x, at.y + line}, ImGui::GetColorU32(quiet()),
                 sentence.c_str(), nullptr, room, &clip);
}

// The list of scenes, with a preview beside each name.
void sceneList(const Facts& facts, Wishes& wishes) {
    const float height = 3.6f * ImGui::GetFontSize(), between = ImGui::GetStyle().ItemSpacing.x;
    const float width = height * static_cast<float>(PictureSheet::extent.width) /
                        static_cast<float>(PictureSheet::extent.height);
    for (std::size_t i = 0; i < facts.scenes.size(); ++i) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable("##scene", i == facts.scene, ImGuiSelectableFlags_None, {0, height}))
            wishes.scene = i;
        const bool isSeen = ImGui::IsItemVisible();
        if (i == facts.scene && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
        ImGui::PopID();
        if (!isSeen) continue;
        preview(facts, i, at, {at.x + width, at.y + height}, wishes);
        sceneText(facts, i, {at.x + width + 2 * between, at.y}, height);
    }
}

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

void scenes(const SceneFacts& scene, const Facts& facts, PathField& path, Wishes& wishes) {
    const float step = 0.7f * buttonWidth(4), between = ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(contentWidth() - 3 * (step + between));
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSizeConstraints({std::min(listWidth * contentWidth(), all.x), 0}, all);
    if (ImGui::BeginCombo("##scenes", scene.name.c_str(), ImGuiComboFlags_HeightLargest)) {
        sceneList(facts, wishes);
        ImGui::EndCombo();
    }
    tip("or drop a scene or a mesh (OBJ, STL, PLY, glTF, GLB) on the window");
    ImGui::SameLine();
    button(Action::previousScene, wishes, step, false, "<");
    ImGui::SameLine();
    button(Action::nextScene, wishes, step, false, ">");
    ImGui::SameLine();
    button(Action::open, wishes, step, path.isShown);
    pathLine(path, wishes);
}

} // namespace sinew::viewer::parts
