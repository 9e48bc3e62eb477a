// Numbers that are typed into the panel.
#include "viewer/ui/panel_numbers.hpp"

#include "viewer/ui/facts.hpp"
#include "viewer/ui/number_text.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace sinew::viewer::parts {

namespace {

// The text with which a field has lost the keys in this picture; empty if it has not, and after Esc.
std::optional<std::string> leftBehind(TypedNumber& typed, ImGuiID field, bool hasKeys,
                                      const std::string& before, const std::string& now) {
    const int picture = ImGui::GetFrameCount();
    const bool hadKeys = typed.field == field && typed.picture + 1 == picture;
    if (hasKeys) {
        typed = {field, picture, hadKeys ? typed.first : before, now};
        return std::nullopt;
    }
    if (!hadKeys || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) return std::nullopt;
    const std::string& last =
        now == before ? typed.text : now; // another control may have got the press first
    return last == typed.first ? std::nullopt : std::optional(last);
}

} // namespace

bool number(TypedNumber& typed, float& value, const Range& range, const Format& format) {
    const auto read = [&](const std::string& text) {
        return range.highest != nullptr && text == range.highest ? std::optional(range.high)
                                                                 : numberOf(text, format.unit);
    };
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format.text, double{value});
    const std::string before = text.data();
    const ImGuiID id = ImGui::GetID("##number");
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const bool isRed = kept.GetBool(id);
    if (isRed) ImGui::PushStyleColor(ImGuiCol_Text, bad());
    const bool isEntered =
        ImGui::InputText("##number", text.data(), text.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (isRed) ImGui::PopStyleColor();
    const bool isTyped = ImGui::IsItemActive();
    if (isTyped && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) // Dear ImGui selects a word
        ImGui::GetInputTextState(id)->SelectAll();
    kept.SetBool(id, isTyped && !read(text.data()));
    const std::optional<std::string> left = leftBehind(typed, id, isTyped, before, text.data());
    const std::optional<std::string> taken = isEntered ? std::optional<std::string>(text.data()) : left;
    const std::optional<float> now = taken && taken != before ? read(*taken) : std::nullopt;
    if (now) value = *now;
    return now.has_value();
}

bool substeps(TypedNumber& typed, int& value, float width) {
    const float side = ImGui::GetFrameHeight(), between = ImGui::GetStyle().ItemInnerSpacing.x;
    const int before = value, step = ImGui::GetIO().KeyCtrl ? 10 : 1;
    ImGui::BeginGroup();
    ImGui::SetNextItemWidth(std::max(width - 2 * (side + between), 1.0f));
    float shown = static_cast<float>(value);
    if (number(typed, shown, {}, {"%.0f", ""}))
        value = static_cast<int>(std::lround(std::clamp(shown, 0.0f, static_cast<float>(mostSubsteps))));
    ImGui::PushButtonRepeat(true);
    ImGui::SameLine(0, between);
    if (ImGui::Button("-", {side, side})) value = std::max(value - step, 0);
    ImGui::SameLine(0, between);
    if (ImGui::Button("+", {side, side})) value = std::min(value + step, mostSubsteps);
    ImGui::PopButtonRepeat();
    ImGui::EndGroup();
    return value != before;
}

} // namespace sinew::viewer::parts
