// Tests of the toolbar: its place in windows of all sizes, its buttons and tooltips, and its icons.
#include "panels_test.hpp"

#include "viewer/input/tool.hpp"
#include "viewer/ui/icons.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace sinew::viewer {
namespace {

class ToolbarTest : public PanelsTest {
protected:
    // Actions of all icons, from top to bottom.
    std::vector<Action> actionsOfIcons(VkExtent2D extent) {
        std::vector<Action> actions;
        const ImGuiWindow* bar = shownWindow("toolbar");
        if (bar == nullptr) return actions;
        for (float y = bar->Pos.y; y < bar->Pos.y + bar->Size.y; y += 3)
            for (const Action action : click({bar->Pos.x + bar->Size.x / 2, y}, extent).actions)
                if (actions.empty() || actions.back() != action) actions.push_back(action);
        return actions;
    }
    // Vertices in the color of buttons that are on, within the toolbar; the lowest first.
    std::vector<float> litRows() {
        std::vector<float> rows;
        const ImU32 color = ImGui::GetColorU32(parts::lit());
        const ImGuiWindow* bar = shownWindow("toolbar");
        for (const ImDrawVert& vertex : bar->DrawList->VtxBuffer)
            if (vertex.col == color) rows.push_back(vertex.pos.y);
        std::ranges::sort(rows);
        return rows;
    }
};

Action actionOfKey(char key) {
    const auto found = std::ranges::find(toolTable(), key, [](const Tool* tool) { return tool->key; });
    return actionOf(**found);
}

TEST_F(ToolbarTest, HasToolsAndWaysBackInViewInEveryWindow) {
    facts.cuts = {"at 1.00 s", "at 2.00 s"};
    facts.undos = 1;
    facts.hint.canUse.fill(true);
    facts.metersPerPixel = 0.001f;
    const std::vector<Action> all{Action::drop,    actionOfKey('C'), actionOfKey('O'), actionOfKey('N'),
                                  Action::section, Action::undo,     Action::redo,     Action::reset};
    for (const float scale : {1.0f, 2.0f}) {
        panels.rescale(scale);
        for (const VkExtent2D extent :
             {VkExtent2D{640, 400}, VkExtent2D{800, 500}, large, VkExtent2D{2560, 1440}}) {
            if (scale > 1 && extent.width < large.width) continue;
            settle(extent);
            settle(extent);
            const ImGuiWindow *bar = shownWindow("toolbar"), *hint = shownWindow("hint");
            ASSERT_TRUE(bar != nullptr && hint != nullptr) << extent.width;
            EXPECT_LE(bar->Pos.y + bar->Size.y, hint->Pos.y) << extent.width << " at scale " << scale;
            if (const ImGuiWindow* side = shownWindow("side")) {
                EXPECT_LT(bar->Pos.x + bar->Size.x, side->Pos.x);
            }
            EXPECT_TRUE(panels.covers({bar->Pos.x + 2, bar->Pos.y + 2}));
            EXPECT_EQ(actionsOfIcons(extent), all) << extent.width << " at scale " << scale;
        }
    }
}

TEST_F(ToolbarTest, GoesWithThePanelAndWhereThereIsNoRoom) {
    settle();
    ASSERT_NE(shownWindow("toolbar"), nullptr);
    panels.toggle();
    settle();
    EXPECT_EQ(shownWindow("toolbar"), nullptr);
    panels.toggle();
    for (const VkExtent2D extent : {VkExtent2D{320, 200}, VkExtent2D{360, 600}, VkExtent2D{1200, 120}}) {
        settle(extent);
        EXPECT_EQ(shownWindow("toolbar"), nullptr) << extent.width;
    }
}

TEST_F(ToolbarTest, MarksTheToolInHand) {
    settle();
    const std::vector<float> grab = litRows();
    ASSERT_FALSE(grab.empty()) << "the pointer grabs";
    facts.toolsOn[*toolOf(actionOfKey('O'))] = true;
    settle();
    const std::vector<float> poke = litRows();
    ASSERT_FALSE(poke.empty());
    EXPECT_GT(poke.front(), grab.back()) << "that of the sphere alone";
    facts.layers.section = Section{};
    settle();
    EXPECT_GT(litRows().back(), poke.back()) << "that of the section, too";
}

TEST_F(ToolbarTest, OffersWaysBackOnlyToWhatWasDone) {
    facts.cuts = {"at 1.00 s"};
    facts.undos = 1;
    settle();
    const std::vector<Action> undoing = actionsOfIcons(large);
    EXPECT_EQ(std::ranges::count(undoing, Action::undo), 1);
    EXPECT_EQ(std::ranges::count(undoing, Action::redo), 0);
    facts.undos = 0;
    const std::vector<Action> redoing = actionsOfIcons(large);
    EXPECT_EQ(std::ranges::count(redoing, Action::undo), 0);
    EXPECT_EQ(std::ranges::count(redoing, Action::redo), 1);
}

TEST_F(ToolbarTest, ShowsTooltipsBesideIt) {
    settle();
    const ImGuiWindow* bar = shownWindow("toolbar");
    ASSERT_NE(bar, nullptr);
    int seen = 0;
    for (float y = bar->Pos.y + 4; y < bar->Pos.y + bar->Size.y; y += 12) {
        for (int i = 0; i < 3; ++i) picture({.pointer = {bar->Pos.x + 20, y}});
        const ImGuiWindow* tip = shownWindow("##Tooltip_00");
        if (tip == nullptr) continue;
        ++seen;
        EXPECT_GE(tip->Pos.x, bar->Pos.x + bar->Size.x) << y;
        EXPECT_LE(tip->Pos.x + tip->Size.x, shownWindow("side")->Pos.x) << y;
    }
    EXPECT_GT(seen, 10);
}

TEST_F(ToolbarTest, IsNotCoveredByMessagesAndLegends) {
    facts.notice = "a line that is long enough to be as wide as the window lets it, which is less than that";
    facts.legends[0] = std::vector<LegendLine>(12, {LegendLine::Kind::row, "contacts", "12"});
    for (const VkExtent2D extent : {large, VkExtent2D{1280, 500}, VkExtent2D{800, 500}}) {
        settle(extent);
        settle(extent);
        const ImGuiWindow* bar = shownWindow("toolbar");
        ASSERT_NE(bar, nullptr);
        for (const char* name : {"notice", "legend"})
            if (const ImGuiWindow* other = shownWindow(name)) {
                EXPECT_GE(other->Pos.x, bar->Pos.x + bar->Size.x) << name << extent.width;
            }
    }
}

TEST_F(ToolbarTest, HasAnIconForEveryTool) {
    for (const Tool* tool : toolTable()) EXPECT_NE(tool->icon, Icon::none) << tool->name;
}

TEST_F(ToolbarTest, DrawsDifferentIconsWithinTheirSquares) {
    settle();
    std::set<std::vector<float>> shapes;
    for (int i = 1; i <= static_cast<int>(Icon::reset); ++i) {
        ImDrawList list(ImGui::GetDrawListSharedData());
        list._ResetForNewFrame();
        list.PushTextureID(ImGui::GetIO().Fonts->TexID);
        list.PushClipRectFullScreen();
        drawIcon(list, static_cast<Icon>(i), {100, 200}, 24, IM_COL32_WHITE);
        std::vector<float> shape;
        for (const ImDrawVert& vertex : list.VtxBuffer) {
            EXPECT_GE(vertex.pos.x, 99) << i;
            EXPECT_LE(vertex.pos.x, 125) << i;
            EXPECT_GE(vertex.pos.y, 199) << i;
            EXPECT_LE(vertex.pos.y, 225) << i;
            shape.insert(shape.end(), {vertex.pos.x, vertex.pos.y});
        }
        EXPECT_GT(shape.size(), 20u) << i;
        shapes.insert(shape);
    }
    EXPECT_EQ(shapes.size(), static_cast<std::size_t>(Icon::reset));
}

} // namespace
} // namespace sinew::viewer
