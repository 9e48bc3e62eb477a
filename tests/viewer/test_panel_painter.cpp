// Tests of panels drawn over a picture, under core, synchronisation and queue-submit validation.
#include "viewer/document/document.hpp"
#include "viewer/render/offscreen.hpp"
#include "viewer/ui/panels.hpp"

#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>

namespace sinew::viewer {
namespace {

constexpr VkExtent2D extent{800, 420};
constexpr Quality quick{.shadowSize = 256, .floorSize = 128, .shadowTaps = 4, .skyTaps = 4};
constexpr std::uint32_t sideFrom = 500; // first column of the panels

sim::Scene ball() {
    sim::Scene scene;
    sim::addParticles(scene, {.center = {0, 0.5f, 0}, .count = {1, 1, 1}, .radius = 0.3f});
    scene.planes.push_back({});
    return scene;
}

// A scene below panels, drawn with or without them.
struct Table {
    Table()
        : scene(ball()), camera(framing({}, sceneBounds(scene), 1.9f)), document(test::device(), scene, {}),
          offscreen(test::device(), extent, lightFor(scene, camera), quick),
          painter(test::device(), VK_FORMAT_R8G8B8A8_SRGB, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 2) {
        painter.setAtlas(panels.atlas());
        painter.setPictures(extent, std::array{offscreen.view()});
    }

    // Draws only the commands of `draw` with Dear ImGui over the scene.
    template <typename Draw> Picture takeDrawn(const Draw& draw) {
        ImGui::GetIO().DisplaySize = {static_cast<float>(extent.width), static_cast<float>(extent.height)};
        ImGui::NewFrame();
        draw();
        ImGui::Render();
        return picture(true, 0);
    }

    Picture take(bool withPanels, std::uint32_t slot = 0) {
        // The first build measures sizes, the second one scroll ranges of wrapped text.
        for (int i = 0; i < 3; ++i) panels.build(facts, changing, {}, extent, 1.0 / 60);
        return picture(withPanels, slot);
    }

    Picture picture(bool withPanels, std::uint32_t slot) {
        VkCommandBuffer commands = test::queue().begin();
        document.recordReset(commands);
        document.recordSkin(commands);
        offscreen.recordPicture(commands, camera, document.simulation());
        if (withPanels) painter.record(commands, slot, 0, panels.drawn(), which);
        offscreen.recordCopy(commands);
        test::queue().wait(test::queue().submit(commands));
        return offscreen.read();
    }

    sim::Scene scene;
    Camera camera;
    Document document;
    Offscreen offscreen;
    Panels panels{1};
    PanelPainter painter;
    PanelPainter::Draw which = PanelPainter::Draw::anew;
    SceneFacts facts{.name = "ball", .device = "a device", .driver = "a driver", .isSoftware = true};
    Facts changing;
};

double brightness(const Picture& picture, std::uint32_t column, std::uint32_t row) {
    const std::uint8_t* at = &picture.pixels[4 * (std::size_t{row} * picture.width + column)];
    return (at[0] + at[1] + at[2]) / 765.0;
}

// Mean color of the columns from..to in the rows between the hint and the upper edge.
double mean(const Picture& picture, std::uint32_t from, std::uint32_t to) {
    double sum = 0;
    for (std::uint32_t row = 20; row < 360; ++row)
        for (std::uint32_t column = from; column < to; ++column) sum += brightness(picture, column, row);
    return sum / (340.0 * (to - from));
}

TEST(PanelPainter, DarkensTheSideAndLeavesTheSceneBesideItAsItWas) {
    Table table;
    table.panels.toggle(); // a small picture has no panels by default
    const Picture without = table.take(false), with = table.take(true);
    EXPECT_GT(mean(without, sideFrom, 780), 0.5);
    EXPECT_LT(mean(with, sideFrom, 780), 0.4);
    EXPECT_LT(mean(with, 14, 54), 0.4) << "the toolbar";
    for (std::uint32_t row = 0; row < 360; ++row)
        for (std::uint32_t column = 60; column < 480; ++column)
            ASSERT_EQ(brightness(with, column, row), brightness(without, column, row))
                << column << ' ' << row;
}

TEST(PanelPainter, DrawsTextInTheColorsItIsMeantToHave) {
    Table table;
    table.panels.toggle();
    const Picture picture = table.take(true);
    double lightest = 0, darkest = 1;
    for (std::uint32_t row = 20; row < 120; ++row)
        for (std::uint32_t column = sideFrom + 20; column < 770; ++column) {
            lightest = std::max(lightest, brightness(picture, column, row));
            darkest = std::min(darkest, brightness(picture, column, row));
        }
    EXPECT_NEAR(lightest, 234.0 / 255, 0.03) << "text: 232, 234, 237 as shown";
    EXPECT_LT(darkest, 0.35);
}

TEST(PanelPainter, TakesAnySlotAndMoreTrianglesThanBefore) {
    Table table;
    const Picture few = table.take(true, 0);
    table.panels.toggle();
    table.panels.toggleHelp();
    table.changing.notice = "something happened";
    const Picture first = table.take(true, 0), second = table.take(true, 1);
    EXPECT_LT(mean(first, 300, 480), mean(few, 300, 480) - 0.2) << "help stands in the middle";
    EXPECT_EQ(first.pixels, second.pixels);
}

TEST(PanelPainter, ShowsThemAsTheyWereUntilTheyAreDueOrCannotBe) {
    Table table;
    const Picture before = table.take(true, 0);
    table.changing.notice = "something happened";
    table.which = PanelPainter::Draw::asKept;
    EXPECT_EQ(table.take(true, 1).pixels, before.pixels);
    table.which = PanelPainter::Draw::anew;
    const Picture after = table.take(true, 0);
    EXPECT_NE(after.pixels, before.pixels);
    table.changing.notice.clear();
    table.which = PanelPainter::Draw::asKept;
    EXPECT_EQ(table.take(true, 1).pixels, after.pixels);
    table.painter.setAtlas(table.panels.atlas());
    EXPECT_EQ(table.take(true, 0).pixels, before.pixels) << "other glyphs";
    table.changing.notice = "something happened";
    table.painter.setPictures(extent, std::array{table.offscreen.view()});
    EXPECT_EQ(table.take(true, 1).pixels, after.pixels) << "other pictures";
}

// Every changed pixel must lie in one of the rectangles, and none in two.
TEST(PanelPainter, KnowsWhereItHasDrawn) {
    Table table;
    table.panels.toggle();
    table.panels.toggleHelp();
    table.changing.notice = "something happened";
    const Picture without = table.take(false), with = table.take(true);
    const PanelCover cover = coverOf(table.panels.drawn(), extent);
    std::vector<int> count(std::size_t{extent.width} * extent.height);
    std::size_t ofAreas = 0, all = 0;
    const auto mark = [&](const VkRect2D& part) {
        EXPECT_LE(static_cast<std::uint32_t>(part.offset.x) + part.extent.width, extent.width);
        EXPECT_LE(static_cast<std::uint32_t>(part.offset.y) + part.extent.height, extent.height);
        for (std::uint32_t row = 0; row < part.extent.height; ++row)
            for (std::uint32_t column = 0; column < part.extent.width; ++column)
                ++count[(static_cast<std::uint32_t>(part.offset.y) + row) * extent.width +
                        static_cast<std::uint32_t>(part.offset.x) + column];
        return std::size_t{part.extent.width} * part.extent.height;
    };
    for (const VkRect2D& area : cover.areas) ofAreas += mark(area);
    all = ofAreas;
    for (const VkRect2D& part : cover.parts) all += mark(part);
    for (std::size_t p = 0; p < count.size(); ++p) {
        ASSERT_LE(count[p], 1) << p;
        const auto isSame = std::equal(&with.pixels[4 * p], &with.pixels[4 * p] + 4, &without.pixels[4 * p]);
        ASSERT_TRUE(isSame || count[p] == 1) << p % extent.width << ' ' << p / extent.width;
    }
    EXPECT_GT(ofAreas, std::size_t{200} * 300) << "the panel at the side hides what is behind it";
    EXPECT_LT(all, count.size()) << "and not everything is hidden";
}

TEST(PanelPainter, KnowsOfAreasOverOneAnother) {
    Table table;
    table.takeDrawn([] {
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        list.PushTextureID(reinterpret_cast<ImTextureID>(areaTexture));
        list.AddRectFilled({20, 20}, {120.5f, 60}, IM_COL32(200, 40, 30, 120));
        list.AddRectFilled({100, 40}, {200, 80}, IM_COL32(200, 40, 30, 120));
        list.PopTextureID();
        list.AddRectFilled({10, 30}, {150, 50}, IM_COL32(0, 0, 0, 120));
    });
    const PanelCover cover = coverOf(table.panels.drawn(), extent);
    const auto sum = [](std::span<const VkRect2D> some) {
        std::size_t pixels = 0;
        for (const VkRect2D& one : some) pixels += std::size_t{one.extent.width} * one.extent.height;
        return pixels;
    };
    EXPECT_EQ(sum(cover.areas), 100u * 40 + 100u * 40 - 20u * 20);
    const std::size_t joined = 190u * 60; // from the left end of the gap to the right end of all
    EXPECT_EQ(sum(cover.parts), joined - sum(cover.areas));
}

// Both pictures of the sheet, side by side at their own size.
TEST(PanelPainter, ShowsPicturesOfItsSheetAsTheyAre) {
    Table table;
    PictureSheet sheet(2);
    const auto plain = [](std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
        Picture picture{
            .width = PictureSheet::extent.width, .height = PictureSheet::extent.height, .pixels = {}};
        for (std::uint32_t i = 0; i < picture.width * picture.height; ++i)
            picture.pixels.insert(picture.pixels.end(), {red, green, blue, 255});
        return picture;
    };
    sheet.set(0, plain(200, 40, 30));
    table.painter.setSheet(sheet);
    sheet.set(1, plain(20, 60, 180));
    table.painter.addPicture(sheet, 1);
    constexpr std::uint32_t width = PictureSheet::extent.width, height = PictureSheet::extent.height,
                            right = width + 28; // from the first picture to the second
    const Picture picture = table.takeDrawn([] {
        for (int i = 0; i < 2; ++i) {
            const float left = 20 + static_cast<float>(right) * static_cast<float>(i),
                        row = 0.5f * static_cast<float>(i);
            ImGui::GetForegroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(sheetTexture), {left, 20},
                                                     {left + float{width}, 20 + float{height}}, {0, row},
                                                     {1, row + 0.5f});
        }
    });
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        const std::uint8_t* one = &picture.pixels[4 * (std::size_t{row} * picture.width + column)];
        return std::array<int, 3>{one[0], one[1], one[2]};
    };
    for (const std::uint32_t row : {20u, 80u, 19u + height})
        for (const std::uint32_t column : {20u, 100u, 19u + width}) {
            EXPECT_EQ(at(column, row), (std::array{200, 40, 30})) << column << ' ' << row;
            EXPECT_EQ(at(column + right, row), (std::array{20, 60, 180})) << column << ' ' << row;
        }
    EXPECT_NE(at(100, 19), (std::array{200, 40, 30}));
    EXPECT_NE(at(100, 20 + height), (std::array{200, 40, 30}));
}

TEST(PanelPainter, HidesWhatIsBehindAreas) {
    Table table;
    const Picture picture = table.takeDrawn([] {
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        list.PushTextureID(reinterpret_cast<ImTextureID>(areaTexture));
        list.AddRectFilled({20, 20}, {120, 60}, IM_COL32(200, 40, 30, 120));
        list.PopTextureID();
        list.AddRectFilled({20, 80}, {120, 120}, IM_COL32(200, 40, 30, 120));
    });
    const auto red = [&](std::uint32_t column, std::uint32_t row) {
        return int{picture.pixels[4 * (std::size_t{row} * picture.width + column)]};
    };
    for (const std::uint32_t column : {20u, 70u, 119u}) {
        EXPECT_EQ(red(column, 40), 200) << column;
        EXPECT_NE(red(column, 100), 200) << column << ": what is no area is mixed with the scene";
    }
}

} // namespace
} // namespace sinew::viewer
