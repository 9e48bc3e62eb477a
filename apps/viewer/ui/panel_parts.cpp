// Shared parts of the panels: colours, rows, buttons, headings.
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sinew::viewer::parts {

ImU32 curveColor(std::size_t curve) {
    constexpr std::array<ImU32, 7> colors{IM_COL32(86, 180, 233, 255), IM_COL32(230, 159, 0, 255),
                                          IM_COL32(0, 158, 115, 255),  IM_COL32(204, 121, 167, 255),
                                          IM_COL32(240, 228, 66, 255), IM_COL32(0, 114, 178, 255),
                                          IM_COL32(213, 94, 0, 255)};
    return colors[curve % colors.size()];
}

ImU32 phaseColor(std::string_view name) {
    constexpr std::array<std::string_view, 6> names{"begin", "solve", "publish", "cut", "skin", "whole skin"};
    return curveColor(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
}

ImVec4 quiet() {
    return {0.62f, 0.65f, 0.69f, 1};
}

ImVec4 bad() {
    return {1.0f, 0.45f, 0.38f, 1};
}

ImVec4 warning() {
    return {0.95f, 0.75f, 0.30f, 1};
}

ImVec4 accent() {
    return {0.55f, 0.80f, 0.95f, 1};
}

ImVec4 lit() {
    return {0.34f, 0.70f, 0.91f, 0.45f};
}

float contentWidth() {
    return ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x;
}

void rule() {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + contentWidth(), at.y + 1},
                                              ImGui::GetColorU32(ImGuiCol_Separator));
    ImGui::Dummy({0, ImGui::GetStyle().ItemSpacing.y / 2});
}

void heading(const char* name) {
    ImGui::Dummy({0, ImGui::GetStyle().ItemSpacing.y});
    ImGui::PushStyleColor(ImGuiCol_Text, quiet());
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    rule();
}

void foldMark(const ImVec2& at, float height, bool isOpen, ImU32 color) {
    const ImVec2 middle{at.x + 0.3f * height, at.y + height / 2};
    const float half = 0.28f * height;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (isOpen)
        list.AddTriangleFilled({middle.x - half, middle.y - 0.6f * half},
                               {middle.x + half, middle.y - 0.6f * half}, {middle.x, middle.y + half}, color);
    else
        list.AddTriangleFilled({middle.x - 0.6f * half, middle.y - half},
                               {middle.x - 0.6f * half, middle.y + half}, {middle.x + half, middle.y}, color);
}

namespace {

// The heading of a section: a click folds or opens it.
void headingOf(Fold fold, Folds& folds, const std::string& text, const ImVec4& color) {
    const std::size_t index = indexOf(fold);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight(), width = contentWidth();
    const float height = std::floor(1.6f * line);
    const std::string id = "##fold" + std::to_string(index);
    if (ImGui::InvisibleButton(id.c_str(), {width, height})) folds.flip(index);
    const ImU32 ink =
        ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : accent());
    const float top = at.y + std::floor((height - line) / 2);
    foldMark({at.x, top}, line, !folds[index], ink);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::string_view title = foldTitles[index];
    list.AddText({at.x + line, top}, ink, title.data(), title.data() + title.size());
    list.AddText({std::floor(at.x + width - ImGui::CalcTextSize(text.c_str()).x), top},
                 ImGui::ColorConvertFloat4ToU32(color), text.c_str());
    list.AddRectFilled({at.x, at.y + height - 1}, {at.x + width, at.y + height},
                       ImGui::GetColorU32(ImGuiCol_Separator));
}

// Scrolls to a section that was opened where nothing of it is in view, but keeps its heading in view.
void reveal(float top, float begin) {
    const float pad = ImGui::GetStyle().WindowPadding.y, seen = ImGui::GetWindowHeight() - pad;
    if (begin + ImGui::GetFrameHeight() <= ImGui::GetScrollY() + seen) return;
    ImGui::SetScrollY(std::min(ImGui::GetCursorPosY() - seen, top - pad));
}

} // namespace

void section(Fold fold, Folds& folds, const std::string& text, const std::function<void()>& content,
             const ImVec4& color) {
    const bool wasFolded = folds[indexOf(fold)];
    const float top = ImGui::GetCursorPosY();
    headingOf(fold, folds, text, color);
    if (folds[indexOf(fold)]) return;
    const float begin = ImGui::GetCursorPosY();
    content();
    if (wasFolded) reveal(top, begin);
}

void row(const char* name, const std::string& value, const ImVec4& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, quiet());
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine();
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - width));
    ImGui::TextColored(color, "%s", value.c_str());
}

void pair(const char* name, const std::string& value, const char* other, const std::string& otherValue,
          const ImVec4& otherColor) {
    const float middle = ImGui::GetWindowContentRegionMin().x + contentWidth() / 2;
    ImGui::TextColored(quiet(), "%s", name);
    ImGui::SameLine();
    ImGui::TextUnformatted(value.c_str());
    ImGui::SameLine();
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), middle));
    row(other, otherValue, otherColor);
}

void row(const char* name, const std::string& value) {
    row(name, value, ImGui::GetStyleColorVec4(ImGuiCol_Text));
}

void tip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float left = ImGui::GetWindowPos().x, right = left + ImGui::GetWindowWidth();
    const float behind = ImGui::GetIO().DisplaySize.x - right;
    const float room = std::max(left, behind) - 2 * style.ItemSpacing.x - 2 * style.WindowPadding.x;
    const bool isBeside = room > 12 * ImGui::GetFontSize(), isLeft = left > behind;
    if (isBeside)
        ImGui::SetNextWindowPos(
            {isLeft ? left - style.ItemSpacing.x : right + style.ItemSpacing.x, ImGui::GetItemRectMin().y},
            ImGuiCond_Always, {isLeft ? 1.0f : 0.0f, 0});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(isBeside ? room : 24 * ImGui::GetFontSize());
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

float buttonWidth(std::size_t inARow) {
    const float between = ImGui::GetStyle().ItemSpacing.x;
    const auto count = static_cast<float>(inARow);
    return (contentWidth() - (count - 1) * between) / count;
}

void button(Action action, Wishes& wishes, float width, bool isOn, const char* name, std::string_view more) {
    const auto binding = std::ranges::find(bindings(), action, &Binding::action);
    const std::string label = name != nullptr ? name : std::string(binding->button);
    if (isOn) ImGui::PushStyleColor(ImGuiCol_Button, lit());
    ImGui::PushID(static_cast<int>(action)); // the label may change while the button is pressed
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, ImGui::GetStyle().FramePadding.y});
    if (ImGui::Button((label + "###button").c_str(), {width, 0})) wishes.actions.push_back(action);
    ImGui::PopStyleVar();
    ImGui::PopID();
    if (isOn) ImGui::PopStyleColor();
    tip(std::string(binding->shown) + ": " + std::string(binding->help) + (more.empty() ? "" : "\n") +
        std::string(more));
}

std::string fitted(const std::string& text, float width, float lines) {
    const float most = (lines + 0.5f) * ImGui::GetTextLineHeight();
    const auto fits = [&](const std::string& one) {
        return ImGui::CalcTextSize(one.c_str(), nullptr, false, width).y < most;
    };
    if (fits(text)) return text;
    std::size_t end = text.size();
    while (end > 0 && !fits(text.substr(0, end) + " ...")) {
        const std::size_t space = text.rfind(' ', end - 1);
        end = space == std::string::npos ? 0 : space;
    }
    return text.substr(0, end) + " ...";
}

void wrapped(const std::string& text, const ImVec4& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

} // namespace sinew::viewer::parts
