// The list of files that can be opened, with a field for a part of a name, or for a path.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace sinew::viewer::parts {

namespace {

// Names of the kinds of an entry.
constexpr std::array kindTexts{"", "scene", "mesh", "state"};

// Keeps the end of a path, which says most.
std::string shortened(const std::string& path, float width) {
    std::string text = path;
    while (ImGui::CalcTextSize(text.c_str()).x > width) {
        const std::size_t slash = text.find('/', 4);
        if (slash == std::string::npos) return text;
        text = "..." + text.substr(slash);
    }
    return text;
}

bool isWayUp(const FileEntry& entry) {
    return entry.name == "../";
}

bool isPressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

// The field keeps the keys as long as the list is open. True: Enter was pressed.
bool field(FileField& files) {
    if (files.wantsKeys) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(contentWidth());
    const std::string before = files.text.data();
    const bool isEntered = ImGui::InputTextWithHint("##path", "part of a name, or a path", files.text.data(),
                                                    files.text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    files.wantsKeys = !ImGui::IsItemActive() && !ImGui::IsAnyMouseDown();
    if (before != files.text.data()) files.browser.filter(files.text.data());
    return isEntered;
}

// A line for each entry. Returns the one that is clicked.
std::optional<std::size_t> lines(const FileBrowser& browser, bool isMoved) {
    std::optional<std::size_t> clicked;
    const float width = contentWidth();
    for (std::size_t i = 0; i < browser.shown().size(); ++i) {
        const FileEntry& entry = browser.shown()[i];
        const bool isChosen = browser.chosen() == i;
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (isChosen) ImGui::PushStyleColor(ImGuiCol_Header, lit());
        if (ImGui::Selectable("##entry", isChosen)) clicked = i;
        if (isChosen) ImGui::PopStyleColor();
        if (entry.isRecent) tip(entry.path.string());
        if (isChosen && isMoved) ImGui::SetScrollHereY();
        ImGui::PopID();
        const bool isFolder = entry.kind == FileEntry::Kind::folder;
        const std::string kind =
            std::string(entry.isRecent ? "recent " : "") + kindTexts[static_cast<std::size_t>(entry.kind)];
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float right = at.x + width - ImGui::CalcTextSize(kind.c_str()).x;
        list.PushClipRect(at, {right, at.y + ImGui::GetTextLineHeight()}, true);
        list.AddText(
            at, ImGui::ColorConvertFloat4ToU32(isFolder ? accent() : ImGui::GetStyleColorVec4(ImGuiCol_Text)),
            entry.name.c_str());
        list.PopClipRect();
        list.AddText({std::floor(right), at.y}, ImGui::ColorConvertFloat4ToU32(quiet()), kind.c_str());
    }
    return clicked;
}

} // namespace

void open(FileField& files, Wishes& wishes) {
    FileBrowser& browser = files.browser;
    ImGui::TextColored(accent(), "Open a scene, a mesh or a saved state");
    const bool isEntered = field(files);
    ImGui::TextColored(quiet(), "%s", shortened(browser.folder().string(), contentWidth()).c_str());
    const int by = (isPressed(ImGuiKey_DownArrow) ? 1 : 0) - (isPressed(ImGuiKey_UpArrow) ? 1 : 0);
    if (by != 0) browser.move(by);
    rule();
    ImGui::BeginChild("entries");
    const std::optional<std::size_t> clicked = lines(browser, by != 0);
    if (!browser.complaint().empty()) wrapped(browser.complaint(), warning());
    if (browser.complaint().empty() && std::ranges::all_of(browser.shown(), isWayUp))
        wrapped(browser.shown().empty() ? "No file or folder has that name."
                                        : "No scene, mesh or saved state in this folder.",
                quiet());
    ImGui::EndChild();
    if (clicked || isEntered) {
        wishes.file = clicked ? browser.take(*clicked) : browser.takeTyped();
        files.text = {};
        files.wantsKeys = true;
    }
    if (wishes.file || isPressed(ImGuiKey_Escape)) files.isShown = false;
}

} // namespace sinew::viewer::parts
