// The gallery: a card with a picture for each scene, and the files that were opened last.
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/panels.hpp"
#include "viewer/ui/picture_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace sinew::viewer::parts {

namespace {

constexpr int mostInARow = 4;
constexpr float cardWidth = 12.5f; // [text heights]
constexpr float linesOfText = 3;   // below the name

struct CardSize {
    float width, picture, height; // [pixels]
};

CardSize cardSize() {
    const float width = std::round(cardWidth * ImGui::GetFontSize());
    const float picture = std::round(width * static_cast<float>(PictureSheet::extent.height) /
                                     static_cast<float>(PictureSheet::extent.width));
    return {width, picture, picture + (1 + linesOfText) * ImGui::GetTextLineHeight() + 4};
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

// The name of a scene, its mark on the right, and below what happens there.
void cardText(const Facts& facts, std::size_t scene, const ImVec2& at, float width) {
    const float line = ImGui::GetTextLineHeight();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec4 color = scene == facts.scene ? accent() : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    list.AddText(at, ImGui::GetColorU32(color), facts.scenes[scene].c_str());
    if (scene < facts.marks.size() && facts.marks[scene].isHeavy) {
        const char* mark = "heavy";
        list.AddText({std::floor(at.x + width - ImGui::CalcTextSize(mark).x), at.y},
                     ImGui::ColorConvertFloat4ToU32(warning()), mark);
    }
    if (scene >= facts.sentences.size()) return;
    const std::string sentence = fitted(facts.sentences[scene], width, linesOfText);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x, at.y + line}, ImGui::GetColorU32(quiet()),
                 sentence.c_str(), nullptr, width);
}

// A card is one button.
void card(const Facts& facts, std::size_t scene, const CardSize& size, Wishes& wishes) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(scene));
    if (ImGui::Selectable("##scene", scene == facts.scene, ImGuiSelectableFlags_None,
                          {size.width, size.height}))
        wishes.scene = scene;
    const bool isSeen = ImGui::IsItemVisible();
    ImGui::PopID();
    if (scene < facts.sentences.size() && !facts.sentences[scene].empty()) tip(facts.sentences[scene]);
    if (!isSeen) return;
    preview(facts, scene, at, {at.x + size.width, at.y + size.picture}, wishes);
    cardText(facts, scene, {at.x, at.y + size.picture + 2}, size.width);
}

void cards(const Facts& facts, std::size_t first, std::size_t end, int inARow, Wishes& wishes) {
    const CardSize size = cardSize();
    for (std::size_t scene = first; scene < end; ++scene) {
        if ((scene - first) % static_cast<std::size_t>(inARow) != 0) ImGui::SameLine();
        card(facts, scene, size, wishes);
    }
}

// Files from elsewhere: the list of scenes has them not.
void recentFiles(const Facts& facts, Wishes& wishes) {
    if (facts.recent.empty()) return;
    heading("Recent files");
    for (const std::string& file : facts.recent) {
        const std::string name = std::filesystem::path(file).filename().string();
        if (ImGui::Selectable((name + "##" + file).c_str())) wishes.file = file;
        tip(file);
    }
}

int cardsInARow() {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::GetIO().DisplaySize.x - 4 * style.WindowPadding.x - style.ScrollbarSize;
    return std::clamp(static_cast<int>(room / (cardSize().width + style.ItemSpacing.x)), 1, mostInARow);
}

// Indices at which two groups begin: the scenes after the first ones, and those for studies. A folder whose
// scenes have no order has one group.
std::array<std::size_t, 2> cardGroups(const Facts& facts) {
    const std::size_t count = facts.scenes.size();
    const auto before = [&](auto isOf) {
        const auto end = std::ranges::find_if_not(facts.marks, isOf);
        return end == facts.marks.end() ? count : static_cast<std::size_t>(end - facts.marks.begin());
    };
    const std::size_t first = facts.marks.empty() ? 0 : before(&scenes::Gallery::isFirst);
    const std::size_t study = before([](const scenes::Gallery& one) { return !one.isStudy; });
    return {first > 0 ? first : study, study};
}

} // namespace

void gallery(const Facts& facts, GalleryState& state, Wishes& wishes) {
    if (std::exchange(state.wants, false)) ImGui::OpenPopup("gallery");
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const float edge = ImGui::GetStyle().WindowPadding.x;
    const float top = std::min(ImGui::GetCursorScreenPos().y, 0.4f * all.y);
    ImGui::SetNextWindowPos({all.x - edge, top}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {all.x - 2 * edge, all.y - top - edge});
    state.isOpen = ImGui::BeginPopup("gallery");
    if (!state.isOpen) return;
    const auto [more, firstStudy] = cardGroups(facts);
    const int inARow = cardsInARow();
    cards(facts, 0, more, inARow, wishes);
    recentFiles(facts, wishes);
    if (more < firstStudy) heading("More");
    cards(facts, more, firstStudy, inARow, wishes);
    if (firstStudy < facts.scenes.size()) heading("For studies and tests");
    cards(facts, firstStudy, facts.scenes.size(), inARow, wishes);
    if (std::exchange(state.closes, false)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace sinew::viewer::parts
