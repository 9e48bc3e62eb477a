// Tests of blades and cuttable bodies in scene files.
#include "scenes/blades.hpp"
#include "scenes/load_fixture.hpp"

#include <Eigen/Geometry>

#include <algorithm>

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
                  .find("may be cut, which solver jacobi does not support"),
              std::string::npos);
}

TEST_F(LoadBlades, MakesBodiesTear) {
    const auto grid = [&](const std::string& keys) { return load(test::smallCloth + keys).scene.grids[0]; };
    EXPECT_EQ(grid("cuttable = true\n").tearStrain, 0);
    EXPECT_EQ(grid("cuttable = true\ntear = 0.2\n").tearStrain, 0.2f);
    EXPECT_EQ(grid("cuttable = true\ntear = 0.2\n").tearsPerStep, 16u);
    EXPECT_EQ(grid("cuttable = true\ntear = 0.2\ntears_per_step = 3\n").tearsPerStep, 3u);
    EXPECT_EQ(grid("cuttable = true\ntoughness = 250\n").toughness, 250.0f);
    const auto error = [&](const std::string& keys) { return errorOfText(test::smallCloth + keys); };
    EXPECT_NE(error("toughness = 250\n").find("toughness is given, but the body may not be cut"),
              std::string::npos);
    EXPECT_NE(error("tear = 0.2\n").find("tear is given, but the body may not be cut: add cuttable = true"),
              std::string::npos);
    EXPECT_NE(error("cuttable = true\ntear = -1\n").find("cloth[0].tear is -1: must be from 0 to 100"),
              std::string::npos);
    EXPECT_NE(error("cuttable = true\ntear = 1\ntears_per_step = 0\n").find("must be from 1 to 65535"),
              std::string::npos);
    for (const std::string& body :
         {std::string("[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\norigin = [0, 0, 0]\n"),
          std::string("[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n")}) {
        const sim::Grid torn =
            load(body + "cuttable = true\ntear = 0.3\ntears_per_step = 5\n").scene.grids[0];
        EXPECT_EQ(torn.tearStrain, 0.3f);
        EXPECT_EQ(torn.tearsPerStep, 5u);
        EXPECT_NE(errorOfText(body + "tear = 0.3\n").find("tear is given, but the body may not be cut"),
                  std::string::npos);
    }
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
    expectError(with("[1, 1]", two), "scene.toml:8: blade[0].times are not ascending");
    expectError(with("[-1, 1]", two), "scene.toml:8: blade[0].times is -1 s: must be from 0 to");
    expectError(with("1", two),
                "scene.toml:8: blade[0].times is the whole number 1: write a list of numbers");
    expectError(with("[0, 1, 2]", two), "scene.toml:9: blade[0].edges are 2, but there are 3 times");
    expectError(with("[0, 1]", "[" + edge + ", [[0, 0, 0]]]"),
                "scene.toml:9: blade[0].edges has a line of 1 points");
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

namespace {

std::vector<sim::Vec3> pointsOf(const scenes::LoadedScene& loaded) {
    std::vector<sim::Vec3> points;
    for (const scenes::BladeMotion& motion : loaded.blades)
        for (const auto& edge : motion.edges) points.insert(points.end(), edge.begin(), edge.end());
    return points;
}

const std::string strokes =
    "[[strokes]]\ncount = 300\ncenter = [1, 2, 3]\nsize = [0.4, 0.2, 0]\nlength = 0.1\n";

} // namespace

TEST_F(LoadBlades, OfStrokesAreSquaresInTheirCuboidInAnyDirection) {
    const scenes::LoadedScene loaded = load(box + strokes);
    ASSERT_EQ(loaded.blades.size(), 300u);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), low = mean, high = mean;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); // covariance of the normals
    for (const scenes::BladeMotion& motion : loaded.blades) {
        std::vector<Eigen::Vector3d> corners;
        for (const auto& edge : motion.edges)
            for (const sim::Vec3& x : edge) corners.emplace_back(double{x.x}, double{x.y}, double{x.z});
        ASSERT_EQ(corners.size(), 4u);
        const Eigen::Vector3d edge = corners[1] - corners[0], way = corners[2] - corners[0];
        EXPECT_NEAR(edge.norm(), 0.1, 1e-6);
        EXPECT_NEAR(way.norm(), 0.1, 1e-6);
        EXPECT_NEAR(edge.dot(way), 0, 1e-6);
        EXPECT_LT((corners[3] - corners[1] - way).norm(), 1e-6) << "the edge keeps its direction";
        const Eigen::Vector3d middle =
            (corners[0] + corners[1] + corners[2] + corners[3]) / 4 - Eigen::Vector3d(1, 2, 3);
        mean += middle / 300;
        low = low.cwiseMin(middle);
        high = high.cwiseMax(middle);
        const Eigen::Vector3d normal = edge.cross(way).normalized();
        spread += normal * normal.transpose() / 300;
    }
    EXPECT_LT((high - Eigen::Vector3d(0.2, 0.1, 0)).norm() + (low + Eigen::Vector3d(0.2, 0.1, 0)).norm(),
              0.02);
    EXPECT_LT(mean.norm(), 0.03) << "no more of them on one side";
    EXPECT_LT((spread - Eigen::Matrix3d::Identity() / 3).norm(), 0.1)
        << "in no direction more than in others";
}

TEST_F(LoadBlades, OfStrokesAreThoseOfTheirSeed) {
    const auto with = [&](const std::string& keys) { return pointsOf(load(box + strokes + keys)); };
    const auto isSame = [](const auto& a, const auto& b) {
        return std::ranges::equal(
            a, b, [](sim::Vec3 p, sim::Vec3 q) { return p.x == q.x && p.y == q.y && p.z == q.z; });
    };
    EXPECT_TRUE(isSame(with(""), with("seed = 1\n")));
    EXPECT_FALSE(isSame(with(""), with("seed = 2\n")));
    EXPECT_TRUE(isSame(with(""), with("begin = 3\nevery = 0.5\n"))) << "times change no places";
}

TEST_F(LoadBlades, OfStrokesComeInWholeStepsOneAfterTheOther) {
    const auto framesOf = [&](const std::string& keys) {
        const scenes::LoadedScene loaded = load(box + strokes + keys);
        scenes::ScriptedBlades blades(loaded.blades, loaded.scene.dt);
        std::vector<int> frames; // a negative number continues the stroke before
        for (int frame = 0; frame < 20; ++frame) {
            const sim::Blade cut = blades.at(static_cast<std::uint64_t>(frame));
            if (!cut.from.empty()) frames.push_back(cut.isCarried ? -frame : frame);
        }
        return frames;
    };
    EXPECT_EQ(framesOf(""), (std::vector<int>{0, 10}));
    EXPECT_EQ(framesOf("begin = 0.05\nevery = 0.06\n"), (std::vector<int>{5, 11, 17}));
    EXPECT_EQ(framesOf("begin = 0.041\nevery = 0.052\nduration = 0.02\n"),
              (std::vector<int>{5, -6, 11, -12, 17, -18}));
    EXPECT_EQ(framesOf("every = 0\n").size(), 20u) << "one in every step, but no two";
}

TEST_F(LoadBlades, RefusesStrokesThatAreNone) {
    const auto error = [&](const std::string& from, const std::string& to) {
        std::string text = strokes;
        text.replace(text.find(from), from.size(), to);
        return errorOfText(box + text);
    };
    EXPECT_EQ(errorOfText(box + strokes), "");
    const auto expect = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    expect(error("count = 300", "count = 0"), "strokes[0].count is 0 strokes: must be from 1 to 10000");
    expect(error("count = 300", "count = 10001"), "must be from 1 to 10000");
    expect(error("count = 300", "count = 2.5"), "strokes[0].count is the number 2.5: write a whole number");
    expect(error("count = 300\n", ""), "strokes[0].count is missing");
    expect(error("length = 0.1", "length = 0"), "strokes[0].length is 0 m: must be above 0");
    expect(error("size = [0.4, 0.2, 0]", "size = [0.4, -1, 0]"), "strokes[0].size is -1 m: must be from 0");
    expect(error("length = 0.1", "length = nan"), "strokes[0].length is nan");
    expect(error("length = 0.1", "length = 0.1\nevery = 0.01\nduration = 0.02"),
           "strokes[0].every is shorter than a stroke's duration");
    expect(error("length = 0.1", "lenght = 0.1"), "did you mean length?");
    const std::string plain = box.substr(0, box.find("cuttable"));
    expect(errorOfText(plain + strokes), "strokes has nothing to cut");
    expect(errorOfText(box + strokes + strokes), "strokes number 301 cuts in a step in which number 1 does");
}

TEST_F(LoadBlades, OfStrokesFarAwayAreNearTheirScene) {
    std::string far = box, text = strokes;
    far.replace(far.find("[0, 0, 0]"), 9, "[-1e6, 0, 0]");
    text.replace(text.find("[1, 2, 3]"), 9, "[-999999, 2, 3]");
    const auto near = pointsOf(load(box + strokes)), there = pointsOf(load(far + text));
    ASSERT_EQ(near.size(), there.size());
    for (std::size_t p = 0; p < near.size(); ++p) EXPECT_EQ(near[p].x, there[p].x);
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
