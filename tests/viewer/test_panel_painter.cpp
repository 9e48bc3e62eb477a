// Panels over a picture, drawn under core, synchronisation and queue-submit validation.
#include "viewer/draw/offscreen.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/panels/panels.hpp"

#include "sim/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>

namespace sinew::viewer {
namespace {

constexpr VkExtent2D extent{800, 420};
constexpr Quality quick{.shadowSize = 256, .floorSize = 128, .shadowTaps = 4, .skyTaps = 4};
constexpr std::uint32_t sideFrom = 500; // where panels are, columns from here on

sim::Scene ball() {
    sim::Scene scene;
    sim::addParticles(scene, {.center = {0, 0.5f, 0}, .count = {1, 1, 1}, .radius = 0.3f});
    scene.planes.push_back({});
    return scene;
}

// A scene under panels; a picture of it with them or without.
struct Table {
    Table()
        : scene(ball()), camera(framing({}, stageBounds(scene), 1.9f)), stage(test::device(), scene, {}),
          offscreen(test::device(), extent, lightFor(scene, camera), quick),
          painter(test::device(), VK_FORMAT_R8G8B8A8_SRGB, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 2) {
        painter.setAtlas(panels.atlas());
        painter.setPictures(extent, std::array{offscreen.view()});
    }

    // What `draw` says to Dear ImGui, and nothing else, over the scene.
    template <typename Draw> Picture takeDrawn(const Draw& draw) {
        ImGui::GetIO().DisplaySize = {static_cast<float>(extent.width), static_cast<float>(extent.height)};
        ImGui::NewFrame();
        draw();
        ImGui::Render();
        return picture(true, 0);
    }

    Picture take(bool withPanels, std::uint32_t slot = 0) {
        // Sizes are learnt in the first, in the second how far what is wrapped can be scrolled.
        for (int i = 0; i < 3; ++i) panels.build(facts, changing, {}, extent, 1.0 / 60);
        return picture(withPanels, slot);
    }

    Picture picture(bool withPanels, std::uint32_t slot) {
        VkCommandBuffer commands = test::queue().begin();
        stage.recordReset(commands);
        stage.recordSkin(commands);
        offscreen.recordPicture(commands, camera, stage.simulation());
        if (withPanels) painter.record(commands, slot, 0, panels.drawn());
        offscreen.recordCopy(commands);
        test::queue().wait(test::queue().submit(commands));
        return offscreen.read();
    }

    sim::Scene scene;
    Camera camera;
    Stage stage;
    Offscreen offscreen;
    Panels panels{1};
    PanelPainter painter;
    SceneFacts facts{.name = "ball", .device = "a device", .driver = "a driver", .isSoftware = true};
    Facts changing;
};

double brightness(const Picture& picture, std::uint32_t column, std::uint32_t row) {
    const std::uint8_t* at = &picture.pixels[4 * (std::size_t{row} * picture.width + column)];
    return (at[0] + at[1] + at[2]) / 765.0;
}

// Of columns from..to of the rows between the hint and the upper edge.
double mean(const Picture& picture, std::uint32_t from, std::uint32_t to) {
    double sum = 0;
    for (std::uint32_t row = 20; row < 360; ++row)
        for (std::uint32_t column = from; column < to; ++column) sum += brightness(picture, column, row);
    return sum / (340.0 * (to - from));
}

TEST(PanelPainter, DarkensTheSideAndLeavesTheSceneBesideItAsItWas) {
    Table table;
    table.panels.toggle(); // the picture is too small to have panels unasked
    const Picture without = table.take(false), with = table.take(true);
    EXPECT_GT(mean(without, sideFrom, 780), 0.5);
    EXPECT_LT(mean(with, sideFrom, 780), 0.4);
    for (std::uint32_t row = 0; row < 360; ++row)
        for (std::uint32_t column = 0; column < 480; ++column)
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

// Both pictures of the sheet, each as large as it is, beside each other.
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
    const Picture picture = table.takeDrawn([] {
        constexpr float width = PictureSheet::extent.width, height = PictureSheet::extent.height;
        for (int i = 0; i < 2; ++i) {
            const float left = 20 + 200 * static_cast<float>(i), row = 0.5f * static_cast<float>(i);
            ImGui::GetForegroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(sheetTexture), {left, 20},
                                                     {left + width, 20 + height}, {0, row}, {1, row + 0.5f});
        }
    });
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        const std::uint8_t* one = &picture.pixels[4 * (std::size_t{row} * picture.width + column)];
        return std::array<int, 3>{one[0], one[1], one[2]};
    };
    for (const std::uint32_t row : {20u, 80u, 139u})
        for (const std::uint32_t column : {20u, 100u, 211u}) {
            EXPECT_EQ(at(column, row), (std::array{200, 40, 30})) << column << ' ' << row;
            EXPECT_EQ(at(column + 200, row), (std::array{20, 60, 180})) << column << ' ' << row;
        }
    EXPECT_NE(at(100, 19), (std::array{200, 40, 30}));
    EXPECT_NE(at(100, 140), (std::array{200, 40, 30}));
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
