// The scene on show, the list of scenes, and the adjustable parameters.
#include "viewer/ui/knob_keys.hpp"
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

// Writes a name in quiet text and leaves the right side for a control.
void knob(const char* name) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(quiet(), "%s", name);
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMin().x + 0.38f * contentWidth());
    ImGui::SetNextItemWidth(0.62f * contentWidth());
}

// A slider with factor 1 in the middle.
bool factorSlider(float& factor) {
    return ImGui::SliderFloat("##stiffness", &factor, 0.01f, 100, "x %.3g", ImGuiSliderFlags_Logarithmic);
}

// Selects the body whose stiffness the slider changes.
void bodyCombo(const SceneFacts& scene, int& body) {
    const auto nameOf = [&](int i) {
        return i < 0 ? "all bodies" : scene.bodies[static_cast<std::size_t>(i)].c_str();
    };
    if (!ImGui::BeginCombo("##body", nameOf(body))) return;
    for (int i = -1; i < static_cast<int>(scene.bodies.size()); ++i) {
        ImGui::PushID(i);
        if (ImGui::Selectable(nameOf(i), i == body)) body = i;
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

bool materialKnobs(const SceneFacts& scene, Knobs& turned) {
    bool isTurned = false;
    knob("stiffness");
    const bool isOne = turned.body >= 0 && static_cast<std::size_t>(turned.body) < turned.bodies.size();
    isTurned |= factorSlider(isOne ? turned.bodies[static_cast<std::size_t>(turned.body)] : turned.stiffness);
    tip("stiffness relative to the scene file; acts at once; Ctrl + click to type");
    if (scene.bodies.size() > 1) {
        knob("  of");
        const int before = turned.body;
        bodyCombo(scene, turned.body);
        isTurned |= turned.body != before;
    }
    knob("damping");
    isTurned |= ImGui::SliderFloat("##damping", &turned.damping, 0, 20, "%.2f 1/s");
    tip("damping of all motion; acts at once");
    knob("friction");
    isTurned |= ImGui::SliderFloat("##friction", &turned.friction, 0, 2, "%.2f");
    tip("friction of planes, colliders and bodies; acts at once");
    if (isTurned) limitMaterial(turned);
    return isTurned;
}

// The slider's right end means through.
bool bladeKnob(const Facts& facts, Knobs& turned) {
    const auto [least, most] = facts.bladeDepths;
    const float through = 1.05f * most;
    // In centimeters, so that a number that is typed has the unit on show.
    float shown = 100 * turned.bladeDepth.value_or(through);
    knob("blade depth");
    const bool isTurned =
        ImGui::SliderFloat("##depth", &shown, 100 * least, 100 * through,
                           turned.bladeDepth ? "%.3g cm" : "through", ImGuiSliderFlags_Logarithmic);
    const float depth = shown / 100;
    tip("depth below the surface under the pointer; right end: through; acts at once");
    if (isTurned) turned.bladeDepth = depth > most ? std::nullopt : std::optional(std::max(depth, least));
    return isTurned;
}

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

namespace {

void take(Knobs turned, const Facts& facts, Wishes& wishes) {
    turned.substeps = std::clamp(turned.substeps, 0, mostSubsteps);
    limitGravity(turned); // typed values have no limits
    turned.pace = std::clamp(turned.pace, 0.01f, 1.0f);
    if (turned != facts.knobs) wishes.knobs = turned;
}

// A warning that bodies are softer than asked, and the cure. True if the cure was taken. It is the last
// control, so that none moves when it appears.
bool softness(const SceneFacts& scene, Knobs& turned) {
    if (scene.stiffness.empty()) return false;
    wrapped(scene.stiffness, warning());
    if (scene.neededSubsteps == 0) return false;
    const auto needed = static_cast<int>(scene.neededSubsteps);
    const std::string text = "Use " + std::to_string(needed) + " substeps";
    const bool isTaken = turned.substeps != needed && ImGui::Button(text.c_str(), {contentWidth(), 0});
    if (isTaken) turned.substeps = needed;
    return isTaken;
}

} // namespace

void parameters(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    Knobs turned = facts.knobs;
    bool isTurned = materialKnobs(scene, turned);
    knob("gravity");
    isTurned |= ImGui::SliderFloat("##gravity", &turned.gravity, 0, 20, "%.2f m/s\u00b2");
    tip("acts at once; Ctrl + click to type");
    knob("speed");
    isTurned |= ImGui::SliderFloat("##pace", &turned.pace, 0.05f, 1, "%.2f x real time");
    tip("speed of the scene relative to real time; acts at once");
    if (scene.canCut) isTurned |= bladeKnob(facts, turned);
    Knobs shown = facts.knobs;
    shown.body = scene.fromFile.body; // the selected body is not a change
    ImGui::BeginDisabled(shown == scene.fromFile);
    if (ImGui::Button("Reset parameters", {contentWidth(), 0})) {
        turned = scene.fromFile;
        isTurned = true;
    }
    ImGui::EndDisabled();
    if (isTurned) take(turned, facts, wishes);
}

void solver(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    Knobs turned = facts.knobs;
    knob("substeps");
    bool isTurned =
        ImGui::InputInt("##substeps", &turned.substeps, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
    tip("act once prepared; 0 = as many as the scene needs");
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
    tip("acts once prepared");
    isTurned |= softness(scene, turned);
    if (isTurned) take(turned, facts, wishes);
}

} // namespace sinew::viewer::parts
