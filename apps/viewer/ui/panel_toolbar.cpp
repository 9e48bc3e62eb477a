// The toolbar: tools of the pointer, the section plane, undo and reset, as icons.
#include "viewer/input/tool.hpp"
#include "viewer/ui/icons.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sinew::viewer::parts {

namespace {

struct Entry {
    Icon icon = Icon::none;
    Action action = Action::grab;
    bool isOn = false, isUsable = true;
    std::string text{}; ///< tooltip; empty: the help of the action
};

constexpr std::size_t groupEnds = 3; // of tools, views, and ways back

// The tool without a key is in hand while no other one is: Esc leads there.
Entry entryOf(const Tool& tool, const Facts& facts) {
    const std::size_t index = indexOf(tool);
    if (tool.key != 0)
        return {.icon = tool.icon,
                .action = actionOf(tool),
                .isOn = facts.toolsOn[index],
                .isUsable = facts.hint.canUse[index]};
    const auto isOther = [&](const Tool* other) { return other->key != 0 && facts.toolsOn[indexOf(*other)]; };
    return {.icon = tool.icon,
            .action = Action::drop,
            .isOn = std::ranges::none_of(toolTable(), isOther),
            .text = "grab: left drag pulls a body; puts other tools away"};
}

// Tools in the order of the table, but the one without a key first.
std::vector<Entry> toolsOf(const Facts& facts) {
    std::vector<Entry> entries;
    for (const bool hasKey : {false, true})
        for (const Tool* tool : toolTable())
            if ((tool->key != 0) == hasKey) entries.push_back(entryOf(*tool, facts));
    return entries;
}

std::array<std::vector<Entry>, groupEnds> groupsOf(const Facts& facts) {
    return {toolsOf(facts),
            {{.icon = Icon::inside, .action = Action::section, .isOn = facts.layers.section.has_value()}},
            {{.icon = Icon::undo, .action = Action::undo, .isUsable = facts.undos > 0},
             {.icon = Icon::redo, .action = Action::redo, .isUsable = facts.undos < facts.cuts.size()},
             {.icon = Icon::reset, .action = Action::reset}}};
}

// A tool that cannot be used can be clicked: a message says why. Others are disabled.
void iconButton(const Entry& entry, float side, Wishes& wishes) {
    const auto binding = std::ranges::find(bindings(), entry.action, &Binding::action);
    const bool isTool = toolOf(entry.action).has_value();
    ImGui::BeginDisabled(!entry.isUsable && !isTool);
    ImGui::PushStyleColor(ImGuiCol_Button, entry.isOn ? lit() : ImVec4(0, 0, 0, 0));
    ImGui::PushID(static_cast<int>(entry.action));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Button("##icon", {side, side})) wishes.actions.push_back(entry.action);
    ImGui::PopID();
    ImGui::PopStyleColor();
    const float size = std::round(0.64f * side), margin = std::floor((side - size) / 2);
    const ImU32 color = entry.isUsable || !isTool ? ImGui::GetColorU32(ImGuiCol_Text)
                                                  : ImGui::GetColorU32(ImGuiCol_Text, 0.4f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    drawIcon(list, entry.icon, {at.x + margin, at.y + margin}, size, color);
    if (entry.icon == Icon::none)
        list.AddText({at.x + margin, at.y + margin}, color, binding->shown.data(),
                     binding->shown.data() + binding->shown.size());
    ImGui::EndDisabled();
    tip(std::string(binding->shown) + ": " + (entry.text.empty() ? std::string(binding->help) : entry.text));
}

} // namespace

std::size_t toolbarButtons() {
    std::size_t count = 0;
    for (const auto& group : groupsOf({})) count += group.size();
    return count;
}

std::size_t toolbarGroups() {
    return groupEnds;
}

void toolbar(const Facts& facts, float side, Wishes& wishes) {
    bool isFirst = true;
    for (const std::vector<Entry>& group : groupsOf(facts)) {
        if (!std::exchange(isFirst, false)) rule();
        for (const Entry& entry : group) iconButton(entry, side, wishes);
    }
}

} // namespace sinew::viewer::parts
