// Tests of small pictures of scenes: the thread that makes them, and their contents.
#include "viewer/jobs/previews.hpp"

#include "scenes/built_in.hpp"
#include "support/device.hpp"
#include "viewer/jobs/shipped_pictures.hpp"
#include "viewer/ui/picture_sheet.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <unistd.h>

namespace sinew::viewer {
namespace {

using Made = std::pair<std::size_t, Picture>;

// Waits for `count` pictures without a time limit.
std::vector<Made> await(Previews& previews, std::size_t count) {
    std::vector<Made> made;
    while (made.size() < count) {
        if (auto one = previews.take()) made.push_back(std::move(*one));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return made;
}

Picture ofWidth(std::size_t width) {
    return {.width = static_cast<std::uint32_t>(width), .height = 1, .pixels = {}};
}

TEST(Previews, AreMadeInTheOrderInWhichTheyAreWantedAndOnce) {
    std::atomic<int> drawn = 0;
    Previews previews([&](std::size_t scene, const std::stop_token&) {
        ++drawn;
        return ofWidth(scene);
    });
    EXPECT_FALSE(previews.take());
    previews.want({4, 2, 7});
    const std::vector<Made> first = await(previews, 3);
    EXPECT_EQ(first[0].first, 4u);
    EXPECT_EQ(first[1].first, 2u);
    EXPECT_EQ(first[2].first, 7u);
    EXPECT_EQ(first[1].second.width, 2u);
    previews.want({2, 4, 5});
    EXPECT_EQ(await(previews, 1)[0].first, 5u);
    EXPECT_EQ(drawn, 4);
}

TEST(Previews, GoOnAfterASceneOfWhichThereIsNone) {
    Previews previews([](std::size_t scene, const std::stop_token&) {
        if (scene == 0) throw std::runtime_error("this is no scene");
        return ofWidth(scene);
    });
    previews.want({0, 1});
    EXPECT_EQ(await(previews, 1)[0].first, 1u);
    previews.want({0, 2});
    EXPECT_EQ(await(previews, 1)[0].first, 2u) << "what failed is not tried again";
}

TEST(Previews, EndWithoutMakingWhatIsStillWanted) {
    std::atomic<int> drawn = 0;
    std::atomic<bool> isAllowed = false;
    std::jthread allowing;
    {
        Previews previews([&](std::size_t scene, const std::stop_token&) {
            ++drawn;
            while (!isAllowed) std::this_thread::yield();
            return ofWidth(scene);
        });
        previews.want({0, 1, 2});
        while (drawn == 0) std::this_thread::yield();
        allowing = std::jthread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(50)); // by then it is asked to stop
            isAllowed = true;
        });
    }
    EXPECT_LT(drawn, 3);
}

TEST(PreviewPicture, ShowsTheBodiesOfAScene) {
    Options options;
    options.builtIn = "organ";
    const Picture picture = drawPreview(test::device(), options).value();
    EXPECT_EQ(picture.width, PictureSheet::extent.width);
    EXPECT_EQ(picture.height, PictureSheet::extent.height);
    std::size_t red = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
        if (picture.pixels[i] > 2 * picture.pixels[i + 1]) ++red;
    EXPECT_GT(red, picture.pixels.size() / 4 / 50) << "of the organ";
    PictureSheet sheet(2);
    EXPECT_TRUE(sheet.set(1, picture));
    EXPECT_FALSE(sheet.set(2, picture)) << "beyond it";
    EXPECT_FALSE(sheet.set(0, ofWidth(3)));
    EXPECT_EQ(sheet.has(), (std::vector<bool>{false, true}));
}

// A changed copy of a shipped scene may look different.
TEST(ShippedPicture, IsThatOfAnUnchangedScene) {
    Options options;
    options.builtIn = "organ_draped";
    const std::optional<Picture> picture = shippedPicture(options);
    ASSERT_TRUE(picture);
    EXPECT_TRUE(PictureSheet(1).set(0, *picture));
    std::size_t red = 0;
    for (std::size_t i = 0; i < picture->pixels.size(); i += 4)
        if (picture->pixels[i] > 3 * picture->pixels[i + 1] / 2) ++red;
    EXPECT_GT(red, picture->pixels.size() / 4 / 10) << "of the organ";
    options.scene = SINEW_SOURCE_FOLDER "/scenes/organ_draped.toml";
    EXPECT_TRUE(shippedPicture(options));
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("sinew-previews-" + std::to_string(::getpid()));
    std::filesystem::create_directory(folder);
    const std::filesystem::path copy = folder / "organ_draped.toml";
    std::filesystem::copy_file(options.scene, copy, std::filesystem::copy_options::overwrite_existing);
    options.scene = copy.string();
    EXPECT_TRUE(shippedPicture(options));
    std::ofstream(copy, std::ios::app) << "damping = 3\n";
    EXPECT_FALSE(shippedPicture(options));
    std::filesystem::remove_all(folder);
    options.scene.clear();
    options.builtIn = "no_such_scene";
    EXPECT_FALSE(shippedPicture(options));
}

TEST(ShippedPicture, IsThereForEveryBuiltInScene) {
    Options options;
    for (const std::string_view name : scenes::builtInNames()) {
        options.builtIn = name;
        EXPECT_EQ(shippedPicture(options).has_value(), name != "drop_mesh") << name;
    }
}

TEST(Previews, AskWhatIsBeingMadeToStop) {
    std::atomic<bool> isBegun = false, isAsked = false;
    {
        Previews previews([&](std::size_t, const std::stop_token& stop) -> std::optional<Picture> {
            isBegun = true;
            while (!stop.stop_requested()) std::this_thread::yield();
            isAsked = true;
            return std::nullopt;
        });
        previews.want({0});
        while (!isBegun) std::this_thread::yield();
    }
    EXPECT_TRUE(isAsked);
}

TEST(PreviewPicture, IsNoneWhereNobodyWaitsForIt) {
    Options options;
    options.builtIn = "cube";
    std::stop_source source;
    EXPECT_TRUE(drawPreview(test::device(), options, source.get_token()));
    source.request_stop();
    EXPECT_FALSE(drawPreview(test::device(), options, source.get_token()));
}

TEST(PreviewPicture, OfNoSceneIsNone) {
    Options options;
    options.scene = "/nowhere/none.toml";
    EXPECT_ANY_THROW(drawPreview(test::device(), options));
}

} // namespace
} // namespace sinew::viewer
