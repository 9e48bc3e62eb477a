// Tests of the command line: accepted and refused options, and the frames that become pictures.
#include "viewer/jobs/options.hpp"
#include "viewer/render/layer.hpp"

#include "app/guard.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

Options parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "sinew-viewer");
    return parseOptions(static_cast<int>(arguments.size()), arguments.data()).value();
}

std::string complaint(std::vector<const char*> arguments) {
    try {
        parse(std::move(arguments));
    } catch (const app::Failure& failure) {
        EXPECT_EQ(failure.code(), app::wrongUsage);
        return failure.what();
    }
    return "accepted";
}

TEST(Options, DefaultToAWindowWithTheBuiltInOrgan) {
    const Options options = parse({});
    EXPECT_FALSE(options.isHeadless);
    EXPECT_EQ(options.scene, "");
    EXPECT_EQ(options.size.width, 1280u);
    EXPECT_EQ(options.size.height, 720u);
}

TEST(Options, ThatAreMisspeltAreNamedAsTheyExist) {
    EXPECT_NE(complaint({"cube.toml", "--headles"}).find(": did you mean --headless?"), std::string::npos);
    EXPECT_NE(complaint({"--blade-dept=2"}).find(": did you mean --blade-depth?"), std::string::npos);
    EXPECT_EQ(complaint({"--surprise"}).find("did you mean"), std::string::npos);
}

TEST(Options, HeadlessTakesEveryFrameByDefault) {
    const Options options = parse({"cube.toml", "--headless", "--frames", "7", "--out", "pictures"});
    for (std::uint64_t frame = 0; frame <= 7; ++frame) EXPECT_TRUE(options.wantsPicture(frame));
    EXPECT_EQ(options.frames, 7u);
    EXPECT_EQ(options.folder, "pictures");
}

TEST(Options, HaveWhatKeysChangeInTheWindow) {
    const Options none = parse({});
    EXPECT_FALSE(none.isVsync || none.arePanelsShown || none.scale || none.isFullScreen || none.bladeDepth);
    const Options all =
        parse({"--no-vsync", "--panels", "--scale", "1.5", "--full-screen", "--blade-depth", "0.02"});
    EXPECT_EQ(all.isVsync, false);
    EXPECT_EQ(all.arePanelsShown, true);
    EXPECT_EQ(all.scale, 1.5f);
    EXPECT_TRUE(all.isFullScreen);
    EXPECT_EQ(all.bladeDepth, 0.02f);
    EXPECT_NE(complaint({"--scale", "9"}).find("--scale"), std::string::npos);
    for (const char* depth : {"0", "nan"})
        EXPECT_NE(complaint({"--blade-depth", depth}).find("--blade-depth"), std::string::npos) << depth;
    EXPECT_NE(complaint({"--scale", "nan"}).find("--scale"), std::string::npos);
    EXPECT_NE(complaint({"--blade-depth", "1", "--replay", "a.input"}).find("--replay"), std::string::npos);
}

TEST(Options, SayWhatPlaysBeside) {
    EXPECT_EQ(parse({"--beside", "gauss_seidel:4"}).beside, "gauss_seidel:4");
    EXPECT_EQ(parse({}).beside, "");
    EXPECT_NE(complaint({"--beside", "newton"}).find("--beside newton"), std::string::npos);
}

TEST(Options, OfTheWindowAreRefusedWithoutOne) {
    for (const std::vector<const char*>& some : {std::vector{"--no-vsync"},
                                                 {"--panels"},
                                                 {"--scale", "2"},
                                                 {"--full-screen"},
                                                 {"--blade-depth", "1"}}) {
        std::vector<const char*> all{"--headless", "--out", "x"};
        all.insert(all.end(), some.begin(), some.end());
        EXPECT_NE(complaint(all).find("has no effect"), std::string::npos) << some.front();
    }
}

TEST(Options, EveryKeepsFrameZero) {
    const Options options = parse({"--headless", "--out", "x", "--every", "3"});
    EXPECT_TRUE(options.wantsPicture(0));
    EXPECT_FALSE(options.wantsPicture(2));
    EXPECT_TRUE(options.wantsPicture(3));
}

TEST(Options, AListOfFramesMayComeInAnyOrderAndSetsTheLength) {
    const Options options = parse({"--headless", "--out", "x", "--picture-frames", "120,0,60"});
    EXPECT_EQ(options.frames, 120u);
    EXPECT_TRUE(options.wantsPicture(0));
    EXPECT_TRUE(options.wantsPicture(60));
    EXPECT_FALSE(options.wantsPicture(61));
}

TEST(Options, RefuseWhatMakesNoSense) {
    EXPECT_NE(complaint({"--frames", "3"}).find("--headless"), std::string::npos);
    EXPECT_NE(complaint({"--headless"}).find("--out"), std::string::npos);
    EXPECT_NE(complaint({"--headless", "--out", "x", "--frames", "0"}).find("--frames"), std::string::npos);
    EXPECT_NE(
        complaint({"--headless", "--out", "x", "--frames", "5", "--picture-frames", "9"}).find("beyond"),
        std::string::npos);
    EXPECT_NE(complaint({"--headless", "--video", "x.mp4", "--picture-frames", "9"}).find("--every"),
              std::string::npos);
    EXPECT_NE(complaint({"--solver", "magic"}).find("--solver"), std::string::npos);
    EXPECT_NE(complaint({"--substeps", "0"}).find("--substeps"), std::string::npos);
    EXPECT_NE(complaint({"a.toml", "b.toml"}), "accepted");
}

TEST(Options, ShowTakesLayersByTheirNames) {
    const Layers layers = parse({"--show", "glass,strain,wires"}).layers;
    EXPECT_EQ(layers.skin(), SkinLook::glass);
    EXPECT_EQ(layers.map(), ColorMap::strain);
    EXPECT_TRUE(layers.has(layer::wires));
    EXPECT_FALSE(layers.has(layer::particles));
    EXPECT_EQ(parse({}).layers, Layers{});
    for (const char* names : {"x-rays", "strain;wires", ""})
        EXPECT_NE(complaint({"--show", names}).find("--show"), std::string::npos) << names;
}

TEST(Options, AReplaySaysHowManyStepsThereAre) {
    EXPECT_FALSE(parse({"--headless", "--replay", "a.input"}).hasFrames);
    EXPECT_TRUE(parse({"--headless", "--replay", "a.input", "--frames", "3"}).hasFrames);
}

TEST(Options, SizesAreTwoSensibleNumbers) {
    EXPECT_EQ(parse({"--size", "640x400"}).size.height, 400u);
    for (const char* size : {"", "640", "640x", "x400", "640x400x3", "640 x 400", "-640x400", "8x8",
                             "9999x400", "99999999999x400", "640X400"})
        EXPECT_NE(complaint({"--size", size}).find("--size"), std::string::npos) << size;
}

TEST(Options, TakeASectionAsItsNormalAndHowFarAlongItLies) {
    EXPECT_FALSE(parse({}).layers.section);
    const Options options = parse({"--section", "-3,0,4,-0.25"});
    ASSERT_TRUE(options.layers.section);
    EXPECT_EQ(options.layers.section->normal, Vector3(-0.6f, 0, 0.8f)) << "of unit length";
    EXPECT_EQ(options.layers.section->offset, -0.25f);
    for (const char* wrong : {"0,0,0,1", "0,0,1", "0,0,1,nan", "up", "0,0,1,0,0"})
        EXPECT_NE(complaint({"--section", wrong}), "accepted") << wrong;
}

} // namespace
} // namespace sinew::viewer
