// The table of keys, in groups. Typed characters leave the lines that contain them.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <string>

namespace sinew::viewer {

void HelpSearch::type(const PanelInput& input) {
    constexpr std::size_t longest = 24;
    for (const auto& [key, isDown] : input.keys)
        if (key == GLFW_KEY_BACKSPACE && isDown && !text.empty()) text.pop_back();
    for (const unsigned character : input.characters)
        if (character >= ' ' && character < 127 && text.size() < longest)
            text.push_back(static_cast<char>(character));
}

namespace parts {

namespace {

// The search on the left, and on the right how to close the help.
void head(const std::string& search) {
    ImGui::TextColored(accent(), "Keys and mouse");
    ImGui::SameLine();
    if (search.empty())
        ImGui::TextColored(quiet(), "type to search");
    else
        ImGui::TextUnformatted((search + "_").c_str());
    ImGui::SameLine();
    const std::string closing = std::string(keyOf(Action::drop)) + " closes this";
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(closing.c_str()).x);
    ImGui::TextColored(quiet(), "%s", closing.c_str());
    rule();
}

void table(const std::vector<HelpLine>& lines, float scale) {
    if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 204 * scale);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
    for (const HelpLine& line : lines) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (!line.heading.empty()) {
            ImGui::Dummy({0, 4 * scale});
            ImGui::TextColored(accent(), "%s", std::string(line.heading).c_str());
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
        }
        ImGui::TextUnformatted(line.triggers.c_str());
        ImGui::TableNextColumn();
        wrapped(std::string(line.help), quiet());
    }
    ImGui::EndTable();
}

} // namespace

// A search leaves the window as large as it was: nothing moves under the pointer.
void help(HelpSearch& search, float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
    const float most = std::max(size.y - 24 * scale, 40.0f);
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(600 * scale, size.x - 16 * scale), search.text.empty() ? 0 : search.height});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x, most});
    ImGui::SetNextWindowFocus();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {24 * scale, 18 * scale});
    ImGui::Begin("help", nullptr, flags);
    if (search.text.empty()) search.height = ImGui::GetWindowHeight();
    head(search.text);
    const std::vector<HelpLine> lines = helpLines(search.text);
    if (lines.empty()) wrapped("No key has that in its text. Backspace removes a letter.", quiet());
    table(lines, scale);
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace parts
} // namespace sinew::viewer
