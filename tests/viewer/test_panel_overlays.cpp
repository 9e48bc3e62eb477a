// Tests of the panels' small windows over the picture: hint, scale bar, sign of a recording, tooltips.
#include "panels_test.hpp"

#include "viewer/render/length_text.hpp"

#include <algorithm>

namespace sinew::viewer {
namespace {

TEST_F(PanelsTest, ShowThatAFilmIsRecordedAsLongAsItIs) {
    settle();
    EXPECT_EQ(shownWindow("recording"), nullptr);
    facts.recorded = 2.5;
    facts.notice = "a line that is long enough to be as wide as the window lets it, which is less than that";
    settle();
    settle();
    for (const float width : {1280.0f, 820.0f}) {
        const VkExtent2D extent{static_cast<std::uint32_t>(width), 600};
        settle(extent);
        settle(extent);
        const ImGuiWindow* sign = shownWindow("recording");
        ASSERT_NE(sign, nullptr);
        EXPECT_LE(sign->Pos.x + sign->Size.x, ImGui::FindWindowByName("side")->Pos.x) << width;
        const ImGuiWindow* notice = shownWindow("notice");
        EXPECT_LE(notice->Pos.x + notice->Size.x, sign->Pos.x) << width;
    }
    panels.choose(false);
    settle();
    EXPECT_NE(shownWindow("recording"), nullptr) << "without panels, too";
    facts.recorded.reset();
    settle();
    EXPECT_EQ(shownWindow("recording"), nullptr);
}

TEST_F(PanelsTest, ShowALengthBesideTheHint) {
    settle();
    EXPECT_EQ(shownWindow("scale"), nullptr) << "before anything is known";
    for (const float metersPerPixel : {1e-6f, 0.0013f, 7.0f})
        for (const std::uint32_t width : {1280u, 1050u}) {
            facts.metersPerPixel = metersPerPixel;
            const VkExtent2D extent{width, 600};
            settle(extent);
            settle(extent);
            const ImGuiWindow *bar = shownWindow("scale"), *hint = shownWindow("hint");
            ASSERT_TRUE(bar != nullptr && hint != nullptr) << width;
            EXPECT_LE(hint->Pos.x + hint->Size.x, bar->Pos.x) << width;
            EXPECT_LE(bar->Pos.x + bar->Size.x, ImGui::FindWindowByName("side")->Pos.x) << width;
            const float length = roundLength(110 * metersPerPixel); // the longest bar has 110 pixels
            const float text = ImGui::CalcTextSize(lengthText(length).c_str()).x;
            EXPECT_NEAR(bar->Size.x, text + 28 + length / metersPerPixel, 2) << lengthText(length);
        }
    constexpr VkExtent2D narrow{800, 600};
    facts.hint.canUse.fill(true);
    facts.hint.canUndo = true;
    settle(narrow);
    settle(narrow);
    EXPECT_EQ(shownWindow("scale"), nullptr) << "hints come first";
    EXPECT_GT(shownWindow("hint")->Size.x, 350);
    facts.metersPerPixel = 0;
    settle();
    EXPECT_EQ(shownWindow("scale"), nullptr);
}

// The window of the hint was as wide as the text of the picture before.
TEST_F(PanelsTest, FitTheHintInThePictureInWhichItChanges) {
    settle();
    for (const char* awaited : {"click a body to orbit around that point", "click"}) {
        facts.hint.awaited = awaited;
        picture();
        const float text = ImGui::CalcTextSize(hintText(facts.hint).c_str()).x;
        EXPECT_NEAR(shownWindow("hint")->Size.x, text + 20, 1) << awaited;
    }
}

// A paused scene has no next picture in which the legend would get its height.
TEST_F(PanelsTest, FitTheLegendInThePictureInWhichItChanges) {
    settle();
    const auto check = [&](const char* what) {
        picture();
        const ImGuiWindow* legend = shownWindow("legend");
        ASSERT_NE(legend, nullptr) << what;
        const float height = legend->Size.y, foot = legend->Rect().Max.y;
        settle();
        EXPECT_EQ(shownWindow("legend")->Size.y, height) << what;
        EXPECT_EQ(shownWindow("legend")->Rect().Max.y, foot) << what;
    };
    facts.legends[0] = {{LegendLine::Kind::row, "contacts", "12"}, {.name = "a line of text"}};
    check("two lines");
    const float two = shownWindow("legend")->Size.y;
    facts.legends[0].resize(9, {LegendLine::Kind::row, "contacts", "12"});
    check("nine lines");
    EXPECT_GT(shownWindow("legend")->Size.y, two + 60);
    facts.legends[0].resize(1);
    check("one line");
    EXPECT_LT(shownWindow("legend")->Size.y, two - 10);
}

// Nothing in the panel moves under the pointer when a color map is turned on.
TEST_F(PanelsTest, ShowLegendsOverTheHintInAWidePicture) {
    const auto height = [&](VkExtent2D extent) {
        settle(extent);
        settle(extent);
        return ImGui::FindWindowByName("side")->ContentSize.y;
    };
    constexpr VkExtent2D narrow{800, 720};
    const float before = height(large), beforeInNarrow = height(narrow);
    facts.legends[0] = {{LegendLine::Kind::row, "contacts", "12"}, {.name = "a line of text"}};
    EXPECT_EQ(height(large), before);
    const ImGuiWindow *legend = shownWindow("legend"), *hint = shownWindow("hint");
    ASSERT_TRUE(legend != nullptr && hint != nullptr);
    EXPECT_LE(legend->Pos.y + legend->Size.y, hint->Pos.y);
    EXPECT_GE(legend->Pos.y, 0);
    EXPECT_GT(height(narrow), beforeInNarrow) << "no room beside the panel";
    EXPECT_EQ(shownWindow("legend"), nullptr);
    panels.choose(false);
    settle();
    EXPECT_EQ(shownWindow("legend"), nullptr);
}

// The tooltip of a button must not lie on other rows of the panel.
TEST_F(PanelsTest, ShowTooltipsBesideThePanel) {
    settle();
    int seen = 0;
    for (float y = 100; y < 700; y += 24)
        for (const float x : {1020.0f, 1200.0f}) {
            for (int i = 0; i < 3; ++i) picture({.pointer = {x, y}});
            const ImGuiWindow* tip = shownWindow("##Tooltip_00");
            if (tip == nullptr) continue;
            ++seen;
            EXPECT_GE(tip->Pos.x, 0) << y;
            EXPECT_LE(tip->Pos.x + tip->Size.x, ImGui::FindWindowByName("side")->Pos.x) << y;
        }
    EXPECT_GT(seen, 10);
}

// A software device takes long for a film: its tooltip says so before it begins.
TEST_F(PanelsTest, SayThatARecordingIsSlowBeforeItBegins) {
    const auto heightOfTip = [&] {
        for (float y = 100; y < 700; y += 6)
            if (std::ranges::count(click({1200, y}).actions, Action::record) > 0) {
                for (int i = 0; i < 3; ++i) picture({.pointer = {1200, y}});
                const ImGuiWindow* tip = shownWindow("##Tooltip_00");
                return tip == nullptr ? 0 : tip->Size.y;
            }
        return 0.0f;
    };
    settle();
    scene.isSoftware = false;
    const float onAGpu = heightOfTip();
    EXPECT_GT(onAGpu, 0);
    scene.isSoftware = true;
    EXPECT_GT(heightOfTip(), onAGpu + 10);
}

} // namespace
} // namespace sinew::viewer
