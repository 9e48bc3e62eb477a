// Tests of the gallery: cards of scenes, their pictures, and files opened last.
#include "panels_test.hpp"

#include "viewer/ui/panel_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace sinew::viewer {
namespace {

// The name of the scene opens it. Pictures are requested only for visible entries.
TEST_F(PanelsTest, AskForPicturesOfScenesThatAreSeenInTheGallery) {
    facts.scenes = {"cloth", "cube", "organ", "tear"};
    facts.previews = {false, true, false};
    settle();
    EXPECT_TRUE(picture().previews.value().empty());
    Wishes wishes;
    wishes.previews.emplace();
    for (float y = 20; y < 300 && wishes.previews->empty(); y += 6) {
        const bool isButton = std::ranges::count(click({1080, y}).actions, Action::gallery) > 0;
        if (!isButton) continue;
        panels.toggleGallery();
        settle();
        wishes = picture({.pointer = {1080, y}});
    }
    EXPECT_EQ(*wishes.previews, (std::vector<std::size_t>{0, 2})) << "what has one, or no place for one";
}

TEST_F(PanelsTest, ShowCardsOfScenesAndFilesOpenedLast) {
    facts.scenes = {"cloth", "cube", "organ", "pile", "beam"};
    facts.sentences = {"A cloth.", "A cube.", "An organ.", "A pile.", "A beam."};
    facts.marks = {{.order = 1}, {.order = 2}, {}, {.isHeavy = true}, {.isStudy = true}};
    facts.recent = {"/elsewhere/bunny.ply"};
    settle();
    EXPECT_FALSE(panels.closeTop());
    panels.toggleGallery();
    settle();
    const ImGuiWindow* gallery = ImGui::GetCurrentContext()->OpenPopupStack.back().Window;
    ASSERT_NE(gallery, nullptr);
    std::set<std::size_t> chosen;
    std::set<std::string> files;
    for (float y = gallery->Pos.y + 20; y < gallery->Pos.y + gallery->Size.y; y += 10)
        for (float x = gallery->Pos.x + 30; x < gallery->Pos.x + gallery->Size.x; x += 90) {
            if (!panels.isGalleryShown()) panels.toggleGallery();
            settle();
            PanelInput press{.pointer = {x, y}};
            picture(press);
            press.isDown[0] = true;
            press.presses[0] = 1;
            picture(press);
            const Wishes wishes = picture({.pointer = {x, y}});
            if (wishes.scene) chosen.insert(*wishes.scene);
            if (wishes.file) files.insert(*wishes.file);
        }
    EXPECT_EQ(chosen, (std::set<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(files, (std::set<std::string>{"/elsewhere/bunny.ply"}));
    if (!panels.isGalleryShown()) panels.toggleGallery();
    settle();
    EXPECT_TRUE(panels.closeTop()) << "Esc";
    settle();
    EXPECT_FALSE(panels.isGalleryShown());
}

// A folder of scenes without an order has one group.
TEST_F(PanelsTest, SetScenesWithoutAPlaceApart) {
    facts.scenes = {"cloth", "cube"};
    const auto heightWith = [&](std::uint32_t order) {
        facts.marks = {{.order = order}, {}};
        settle();
        if (!panels.isGalleryShown()) panels.toggleGallery();
        settle();
        settle();
        return ImGui::GetCurrentContext()->OpenPopupStack.back().Window->ContentSize.y;
    };
    const float together = heightWith(0);
    EXPECT_GT(heightWith(1), 1.5f * together) << "the second one is in a row of its own, under More";
    EXPECT_EQ(parts::galleryLabel("organ"), "Scenes: organ");
}

TEST_F(PanelsTest, EndASentenceThatIsTooLongForItsCardInDots) {
    settle();
    const std::string text = "A square of cloth, held at two corners, that swings down and comes to rest";
    EXPECT_EQ(parts::fitted(text, 2000, 1), text);
    std::size_t shortest = text.size();
    for (const float lines : {3.0f, 2.0f, 1.0f}) {
        const std::string part = parts::fitted(text, 140, lines);
        EXPECT_TRUE(part.ends_with(" ...")) << part;
        EXPECT_TRUE(text.starts_with(part.substr(0, part.size() - 4))) << part;
        const float height = ImGui::CalcTextSize(part.c_str(), nullptr, false, 140).y;
        EXPECT_EQ(height, lines * ImGui::GetTextLineHeight()) << part;
        EXPECT_LT(part.size(), shortest);
        shortest = part.size();
    }
    EXPECT_EQ(parts::fitted("pneumonoultramicroscopicsilicovolcanoconiosis", 50, 1), " ...");
}

} // namespace
} // namespace sinew::viewer
