// Tests of the foldable sections of the panel: a click on a heading folds, and moves nothing above it.
#include "panels_test.hpp"

#include "viewer/ui/folds.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <cmath>
#include <optional>
#include <set>

namespace sinew::viewer {
namespace {

class PanelFoldsTest : public PanelsTest {
protected:
    PanelFoldsTest() { areSectionsOpen = false; }
    // The place of a heading, found by clicks; the sections are as before.
    std::optional<Vector2> headingOf(Fold fold, VkExtent2D extent = large) {
        const Folds before = panels.folds();
        for (float y = 20; y < static_cast<float>(extent.height) - 20; y += 6) {
            const Vector2 at(static_cast<float>(extent.width) - 100, y);
            click(at, extent);
            const bool isIt = panels.folds()[indexOf(fold)] != before[indexOf(fold)];
            panels.fold(before);
            settle(extent);
            if (isIt) return at;
        }
        return std::nullopt;
    }
    float contentHeight() { return ImGui::FindWindowByName("side")->ContentSize.y; }
};

TEST_F(PanelFoldsTest, FoldAndOpenAtAClickOnTheHeading) {
    constexpr VkExtent2D tall{1280, 1400};
    panels.fold({});
    settle(tall);
    settle(tall);
    for (std::size_t i = 0; i < foldTitles.size(); ++i) {
        panels.fold({});
        settle(tall);
        const auto at = headingOf(static_cast<Fold>(i), tall);
        ASSERT_TRUE(at) << foldTitles[i];
        const float open = contentHeight(); // the search may have opened the list of passes
        click(*at, tall);
        EXPECT_EQ(panels.folds(), Folds().set(i)) << foldTitles[i];
        settle(tall);
        settle(tall);
        EXPECT_LT(contentHeight(), open - 20) << foldTitles[i];
        click(*at, tall);
        EXPECT_TRUE(panels.folds().none()) << "the heading has not moved: " << foldTitles[i];
    }
}

// The name and the driver of a device take lines; they are in Performance.
TEST_F(PanelFoldsTest, HaveOneLineOfTheDeviceAboveThem) {
    panels.fold(Folds().set());
    for (const bool isSoftware : {true, false}) {
        scene.isSoftware = isSoftware;
        scene.device = scene.driver = "device";
        settle();
        settle();
        const float height = contentHeight();
        const auto first = headingOf(Fold::scene);
        ASSERT_TRUE(first);
        EXPECT_LT(first->y(), 60) << "one line stands above the first heading";
        scene.device = "llvmpipe (LLVM 15.0.7, 256 bits), a name that is longer than a line of the panel";
        scene.driver = "Mesa 22.3.6 (LLVM 15.0.7), llvmpipe";
        settle();
        settle();
        EXPECT_EQ(contentHeight(), height);
    }
}

// A panel scrolled to its end would slide down when it becomes shorter.
TEST_F(PanelFoldsTest, KeepTheHeadingUnderThePointerInAScrolledPanel) {
    constexpr VkExtent2D low{1280, 500};
    panels.choose(true);
    panels.fold({});
    facts.phases = {{"solve", {}}};
    facts.phases.front().ms.add(1);
    settle(low);
    const ImGuiWindow* side = shownWindow("side");
    ASSERT_NE(side, nullptr);
    for (int i = 0; i < 200; ++i) picture({.pointer = {1200, 100}, .notches = -5}, low);
    ASSERT_GT(side->Scroll.y, 100);
    const float end = side->Scroll.y;
    int folded = 0;
    for (float y = 476; y > 20; y -= 6) { // upwards: what a click opens above would move the end
        const Folds before = panels.folds();
        click({1180, y}, low);
        if (panels.folds() == before) continue;
        ++folded;
        for (int i = 0; i < 3; ++i) picture({.pointer = {1180, y}}, low);
        EXPECT_EQ(side->Scroll.y, end) << y;
        click({1180, y}, low);
        EXPECT_EQ(panels.folds(), before) << "the same heading is still under the pointer: " << y;
        for (int i = 0; i < 3; ++i) picture({.pointer = {1180, y}}, low);
        ASSERT_EQ(side->Scroll.y, end) << y;
        y -= 18;
    }
    EXPECT_GE(folded, 1);
}

// A heading at the foot of the panel opened a section below the window: nothing was seen to happen.
TEST_F(PanelFoldsTest, ScrollToASectionThatOpensBelowTheWindow) {
    constexpr VkExtent2D tall{1280, 1400};
    const Folds folded = Folds().set(indexOf(Fold::compare)).set(indexOf(Fold::material));
    panels.fold(folded);
    settle(tall);
    const auto compare = headingOf(Fold::compare, tall);
    const auto material = headingOf(Fold::material, tall);
    ASSERT_TRUE(compare && material);
    const VkExtent2D low{1280, static_cast<std::uint32_t>(compare->y()) + 30};
    panels.fold(folded);
    for (int i = 0; i < 20; ++i) picture({.pointer = {1200, 100}, .notches = 5}, low);
    const ImGuiWindow* side = shownWindow("side");
    ASSERT_EQ(side->Scroll.y, 0);
    click(*material, low);
    settle(low);
    EXPECT_EQ(side->Scroll.y, 0) << "what opens is in view";
    panels.fold(folded);
    settle(low);
    click(*compare, low);
    settle(low);
    EXPECT_FALSE(panels.folds()[indexOf(Fold::compare)]);
    EXPECT_GT(side->Scroll.y, 20);
    EXPECT_LT(side->Scroll.y, compare->y()) << "its heading is still in view";
}

// A double click on a heading would press what has come under the pointer.
TEST_F(PanelFoldsTest, KeepAPressFromWhatScrolledUnderThePointer) {
    constexpr VkExtent2D tall{1280, 1400};
    const Folds folded = Folds().set(indexOf(Fold::compare));
    panels.fold(folded);
    settle(tall);
    const auto compare = headingOf(Fold::compare, tall);
    ASSERT_TRUE(compare);
    const VkExtent2D low{1280, static_cast<std::uint32_t>(compare->y()) + 30};
    panels.fold(folded);
    for (int i = 0; i < 20; ++i) picture({.pointer = {1200, 100}, .notches = 5}, low);
    const ImGuiWindow* side = shownWindow("side");
    ASSERT_EQ(side->Scroll.y, 0);
    for (const float x : {1000.0f, 1080.0f, 1180.0f, 1240.0f}) {
        const Vector2 at(x, compare->y());
        const auto rest = [&] {
            for (int i = 0; i < 3; ++i) picture({.pointer = at}, low);
        };
        EXPECT_TRUE(click(at, low).isEmpty());
        rest();
        ASSERT_GT(side->Scroll.y, 20);
        ASSERT_FALSE(panels.folds()[indexOf(Fold::compare)]);
        EXPECT_EQ(ImGui::GetHoveredID(), 0u) << "nothing under the pointer lights up";
        EXPECT_TRUE(click(at, low).isEmpty());
        EXPECT_EQ(panels.folds(), folded) << "the section folds again";
        rest();
        EXPECT_EQ(side->Scroll.y, 0);
    }
    const Vector2 at(1180, compare->y());
    click(at, low);
    settle(low);
    std::set<Action> clicked; // once the pointer has moved, all is as always
    for (float y = compare->y() - 10; y > 20; y -= 8)
        for (const Action action : click({1180, y}, low).actions) clicked.insert(action);
    EXPECT_TRUE(clicked.contains(Action::beside));
}

// The second simulation takes seconds to make: its figures would push down what is below.
TEST_F(PanelFoldsTest, TakeTheRoomOfAComparisonBeforeItIsThere) {
    panels.fold({});
    scene.solvers = {"split", "gauss_seidel"};
    const auto height = [&] {
        settle({1280, 2000});
        settle({1280, 2000});
        return contentHeight();
    };
    PhaseCurve solve{"solve", {}};
    solve.ms.add(2);
    facts.phases = {solve};
    const float off = height();
    facts.beside.isOn = facts.beside.isMaking = true;
    EXPECT_EQ(height(), off);
    facts.beside.isMaking = false;
    facts.beside.names = {"split, 24 substeps", "gauss_seidel, 24 substeps"};
    facts.beside.phases = {};
    facts.beside.strainRms.add(0.01f);
    facts.beside.strainMax.add(0.1f);
    EXPECT_EQ(height(), off);
    facts.beside.apart = Distance{.rms = 1.2e-3f, .largest = 4.7e-3f};
    facts.beside.phases = {solve};
    EXPECT_EQ(height(), off) << "a result of two lines";
}

// A cut adds phases, and another solver removes some: the colors of the others stay.
TEST(PhaseColor, IsOfTheNameAndDistinct) {
    std::set<ImU32> colors;
    for (const char* name : {"begin", "cut", "solve", "publish", "skin", "whole skin", "of a later version"})
        colors.insert(parts::phaseColor(name));
    EXPECT_EQ(colors.size(), 7u);
}

TEST(ComparisonText, SaysCostAndDistanceAsFarAsTheyAreKnown) {
    Curve none, slow, fast;
    slow.add(2);
    fast.add(0.92f);
    const std::optional<Distance> apart = Distance{.rms = 1.2e-3f, .largest = 4.7e-3f};
    EXPECT_EQ(parts::comparisonText(none, none, {}), "");
    EXPECT_EQ(parts::comparisonText(slow, none, {}), "");
    EXPECT_EQ(parts::comparisonText(slow, fast, {}), "The right one takes 0.46 times as long.");
    EXPECT_EQ(parts::comparisonText(none, none, apart), "Particles are 1.2 mm apart (rms), at most 4.7 mm.");
    EXPECT_EQ(parts::comparisonText(fast, slow, apart),
              "The right one takes 2.2 times as long; particles are 1.2 mm apart (rms), at most 4.7 mm.");
    EXPECT_EQ(parts::comparisonText(none, none, Distance{}), "Particles are in the same places.");
    Curve slowest;
    slowest.add(240);
    EXPECT_EQ(parts::comparisonText(slow, slowest, {}), "The right one takes 120 times as long.");
}

TEST_F(PanelFoldsTest, NameWhatPlaysInEachHalfOfAComparison) {
    settle();
    EXPECT_EQ(shownWindow("left"), nullptr);
    facts.beside.isOn = true;
    facts.beside.names = {"split, 24 substeps", "gauss_seidel, 24 substeps"};
    for (const bool isShown : {true, false}) {
        panels.choose(isShown);
        settle();
        const float width = large.width - static_cast<float>(panels.sideWidth(large));
        const ImGuiWindow *left = shownWindow("left"), *right = shownWindow("right");
        ASSERT_TRUE(left != nullptr && right != nullptr);
        EXPECT_NEAR(left->Rect().GetCenter().x, 0.25f * width, 1);
        EXPECT_NEAR(right->Rect().GetCenter().x, 0.75f * width, 1);
    }
}

TEST_F(PanelFoldsTest, ShowTheWarningOfSoftBodiesInTheHeadingOfAFoldedSection) {
    EXPECT_EQ(panels.folds(), foldedAtFirst);
    const auto vertices = [&] {
        settle({1280, 1400});
        return panels.drawn().TotalVtxCount;
    };
    const int before = vertices();
    scene.stiffness = "Softer than asked: the softest link has 2 % of its stiffness.";
    EXPECT_GT(vertices(), before);
}

TEST_F(PanelFoldsTest, ShowTheListOfFilesWhateverIsFolded) {
    panels.fold(Folds().set());
    settle();
    panels.toggleFiles();
    settle();
    settle();
    EXPECT_NE(shownWindow("files"), nullptr);
    EXPECT_EQ(panels.folds(), Folds().set());
}

} // namespace
} // namespace sinew::viewer
