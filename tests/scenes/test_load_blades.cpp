// Blades and bodies that may be cut, as a scene file says them.
#include "scenes/blades.hpp"
#include "scenes/load_fixture.hpp"

using namespace sinew;

namespace {

class LoadBlades : public test::LoadFixture {};

const std::string box =
    "dt = 0.01\n[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\norigin = [0, 0, 0]\ncuttable = true\n";
const std::string blade =
    "[[blade]]\ntimes = [0.02, 0.04, 0.05]\nedges = [[[0, 1, 0], [0, 1, 1]], [[0, 0, 0], [0, 0, 1]], "
    "[[2, 0, 0], [4, 0, 1]]]\n";

} // namespace

TEST_F(LoadBlades, MakesBodiesCuttable) {
    const std::string plain = box.substr(0, box.find("cuttable"));
    EXPECT_TRUE(load(box).scene.grids[0].isCuttable);
    EXPECT_FALSE(load(plain).scene.grids[0].isCuttable);
    EXPECT_TRUE(load(test::smallCloth + "cuttable = true\n").scene.grids[0].isCuttable);
    EXPECT_TRUE(
        load("[[mesh]]\ngenerate = \"sphere\"\nresolution = 6\ncuttable = true\n").scene.grids[0].isCuttable);
    expectError(plain + "cuttable = 1\n",
                "scene.toml:6: box[0].cuttable is the whole number 1: write true or false");
    EXPECT_NE(errorOfText(box + "[solver]\nname = \"jacobi\"\n")
                  .find("may be cut, which solver jacobi has no form for"),
              std::string::npos);
}

TEST_F(LoadBlades, MakesClothTear) {
    const auto grid = [&](const std::string& keys) { return load(test::smallCloth + keys).scene.grids[0]; };
    EXPECT_EQ(grid("cuttable = true\n").tearStrain, 0);
    EXPECT_EQ(grid("cuttable = true\ntear = 0.2\n").tearStrain, 0.2f);
    EXPECT_EQ(grid("cuttable = true\ntear = 0.2\n").tearsPerStep, 16u);
    EXPECT_EQ(grid("cuttable = true\ntear = 0.2\ntears_per_step = 3\n").tearsPerStep, 3u);
    const auto error = [&](const std::string& keys) { return errorOfText(test::smallCloth + keys); };
    EXPECT_NE(error("tear = 0.2\n").find("tear is given, but the cloth may not be cut: add cuttable = true"),
              std::string::npos);
    EXPECT_NE(error("cuttable = true\ntear = -1\n").find("cloth[0].tear is -1: must be from 0 to 100"),
              std::string::npos);
    EXPECT_NE(error("cuttable = true\ntear = 1\ntears_per_step = 0\n").find("must be from 1 to 65535"),
              std::string::npos);
    EXPECT_EQ(error("cuttable = true\nskip_stiffness = 5\nbending_stiffness = 1e-4\n"), "");
}

TEST_F(LoadBlades, OfTheShippedClothsLoad) {
    const scenes::LoadedScene curtain = scenes::load(SINEW_SOURCE_FOLDER "/scenes/cloth_cut.toml");
    EXPECT_EQ(curtain.blades.size(), 3u);
    EXPECT_TRUE(curtain.scene.grids.at(0).isCuttable);
    EXPECT_GT(scenes::load(SINEW_SOURCE_FOLDER "/scenes/tear.toml").scene.grids.at(0).tearStrain, 0);
}

TEST_F(LoadBlades, PlaysABladeThroughItsPoses) {
    const scenes::LoadedScene loaded = load(box + blade);
    ASSERT_EQ(loaded.blades.size(), 1u);
    scenes::ScriptedBlades blades(loaded.blades, loaded.scene.dt);
    EXPECT_TRUE(blades.at(1).from.empty()) << "not yet";
    sim::Blade cut = blades.at(2);
    ASSERT_EQ(cut.from.size(), 2u);
    EXPECT_FALSE(cut.isCarried) << "a stroke begins";
    EXPECT_FLOAT_EQ(cut.from[0].y, 1);
    EXPECT_FLOAT_EQ(cut.to[0].y, 0.5f);
    cut = blades.at(3);
    EXPECT_TRUE(cut.isCarried);
    EXPECT_FLOAT_EQ(cut.from[1].y, 0.5f);
    EXPECT_NEAR(cut.to[1].y, 0, 1e-6);
    cut = blades.at(4);
    EXPECT_NEAR(cut.to[1].x, 4, 1e-6);
    EXPECT_TRUE(blades.at(5).from.empty()) << "no longer";
}

TEST_F(LoadBlades, RefusesBladesThatAreNone) {
    const auto with = [](const std::string& times, const std::string& edges) {
        return box + "[[blade]]\ntimes = " + times + "\nedges = " + edges + "\n";
    };
    const std::string edge = "[[0, 0, 0], [0, 0, 1]]", two = "[" + edge + ", " + edge + "]";
    EXPECT_EQ(errorOfText(with("[0, 1]", two)), "");
    expectError(with("[1]", "[" + edge + "]"), "scene.toml:8: blade[0].times has 1: give at least two");
    expectError(with("[1, 1]", two), "scene.toml:8: blade[0].times do not grow");
    expectError(with("[-1, 1]", two), "scene.toml:8: blade[0].times is -1 s: must be from 0 to");
    expectError(with("1", two),
                "scene.toml:8: blade[0].times is the whole number 1: write a list of numbers");
    expectError(with("[0, 1, 2]", two), "scene.toml:9: blade[0].edges are 2, but there are 3 times");
    expectError(with("[0, 1]", "[" + edge + ", [[0, 0, 0]]]"),
                "scene.toml:9: blade[0].edges has one of 1 points");
    expectError(with("[0, 1]", "[[[0, 0], [0, 1]]]"),
                "scene.toml:9: blade[0].edges is a list of 1: write a list of poly");
    expectError(with("[0, 1]", "[[[0, 0, 1e9], [0, 0, 1]], " + edge + "]"),
                "scene.toml:9: blade[0].edges is 1e+09 m");
    expectError(box + "[[blade]]\ntimes = [0, 1]\n", "scene.toml:7: blade[0].edges is missing");
}

TEST_F(LoadBlades, RefusesABladeWithNothingToCutAndTwoInOneStep) {
    expectError(test::smallCloth + blade, "scene.toml:4: blade has nothing to cut");
    const auto from = [](double begin, double end) {
        return "[[blade]]\ntimes = [" + std::to_string(begin) + ", " + std::to_string(end) +
               "]\nedges = [[[0, 0, 0], [0, 0, 1]], [[0, 1, 0], [0, 1, 1]]]\n";
    };
    EXPECT_EQ(errorOfText(box + from(0, 0.02) + from(0.02, 0.05)), "");
    EXPECT_NE(
        errorOfText(box + from(0, 0.021) + from(0.025, 0.05)).find("cuts in a step in which number 1 does"),
        std::string::npos);
}

TEST_F(LoadBlades, OfTheShippedSceneCutInTwoStepsOneAfterTheOther) {
    const scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/cube_quarters.toml");
    scenes::ScriptedBlades blades(loaded.blades, loaded.scene.dt);
    std::vector<std::uint64_t> frames;
    for (std::uint64_t frame = 0; frame < 200; ++frame)
        if (!blades.at(frame).from.empty()) frames.push_back(frame);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[1], frames[0] + 1);
}
