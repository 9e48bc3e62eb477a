// Strokes of the pointer as sweeps of a blade, without a device.
#include "viewer/hands/cut_tool.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

const Camera fromFront{.distance = 3, .azimuth = 0, .elevation = 0};
const Box stage(Vector3(-0.5f, -0.5f, -0.5f), Vector3(0.5f, 0.5f, 0.5f));

Vector3 toVector(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

CutTool withBlade() {
    CutTool tool(stage);
    tool.toggle();
    return tool;
}

TEST(CutTool, CutsNothingUntilItIsTakenUp) {
    CutTool tool(stage);
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.2f, 0});
    EXPECT_FALSE(tool.next());
}

TEST(CutTool, SweepsFromBeforeTheStageToBehindItAndEachGoesOnWhereTheLastEnded) {
    CutTool tool = withBlade();
    tool.press(fromFront, {-0.1f, 0});
    EXPECT_FALSE(tool.next()) << "a press alone cuts nothing";
    tool.move(fromFront, {0, 0.01f});
    tool.move(fromFront, {0.1f, 0.01f});
    tool.release();
    EXPECT_TRUE(tool.beginsStroke());
    const auto first = tool.next(), second = tool.next();
    ASSERT_TRUE(first && second);
    EXPECT_FALSE(first->isCarried);
    EXPECT_TRUE(second->isCarried);
    for (const Sweep& sweep : {*first, *second})
        for (const auto& edge : {sweep.from, sweep.to}) {
            EXPECT_GT(edge[0].z, 0.5f) << "before the stage";
            EXPECT_LT(edge[1].z, -0.5f) << "behind it";
            const Vector3 ray = toVector(edge[1]) - eye(fromFront), near = toVector(edge[0]) - eye(fromFront);
            EXPECT_LT(ray.normalized().cross(near).norm(), 1e-4f) << "along the ray of the pointer";
        }
    for (int end : {0, 1}) EXPECT_EQ(toVector(first->to[end]), toVector(second->from[end]));
    EXPECT_FALSE(tool.next());
    EXPECT_FALSE(tool.isCutting());
    EXPECT_TRUE(tool.path().empty()) << "what is cut is no longer drawn";
}

TEST(CutTool, WaitsForMovesThatAreSeen) {
    CutTool tool = withBlade();
    tool.press(fromFront, {0, 0});
    for (int i = 1; i <= 10; ++i) tool.move(fromFront, {0.001f * static_cast<float>(i), 0});
    int sweeps = 0;
    while (tool.next()) ++sweeps;
    EXPECT_EQ(sweeps, 3);
}

TEST(CutTool, EndsAStrokeBesideTheStageAndBeginsAnotherWhereItComesBack) {
    CutTool tool = withBlade();
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.1f, 0});
    tool.move(fromFront, {3, 0});
    tool.move(fromFront, {0.2f, 0});
    EXPECT_TRUE(tool.next());
    EXPECT_FALSE(tool.next());
    tool.move(fromFront, {0.3f, 0});
    EXPECT_TRUE(tool.beginsStroke());
}

TEST(CutTool, KeepsTheWholeWayOfAStrokeThatStepsDoNotKeepUpWith) {
    CutTool tool = withBlade();
    tool.press(fromFront, {-0.2f, 0});
    for (int i = 1; i <= 100; ++i) tool.move(fromFront, {-0.2f + 0.004f * static_cast<float>(i), 0});
    std::vector<Sweep> sweeps;
    while (const auto sweep = tool.next()) sweeps.push_back(*sweep);
    ASSERT_EQ(sweeps.size(), 16u);
    for (std::size_t i = 1; i < sweeps.size(); ++i)
        EXPECT_EQ(toVector(sweeps[i].from[1]), toVector(sweeps[i - 1].to[1]));
    const Ray last = rayThrough(fromFront, {0.2f, 0});
    const Vector3 end = toVector(sweeps.back().to[1]) - last.origin;
    EXPECT_LT(end.cross(last.direction).norm(), 1e-4f);
}

TEST(CutTool, CutsNoChordWhereAStrokeLeftTheStage) {
    CutTool tool = withBlade();
    tool.press(fromFront, {-0.2f, 0});
    for (int i = 1; i <= 40; ++i) tool.move(fromFront, {-0.2f + 0.004f * static_cast<float>(i), 0});
    tool.move(fromFront, {3, 0});
    tool.move(fromFront, {0.2f, 0.1f});
    tool.move(fromFront, {0.21f, 0.1f});
    std::vector<Sweep> sweeps;
    while (const auto sweep = tool.next()) sweeps.push_back(*sweep);
    ASSERT_EQ(sweeps.size(), 17u);
    EXPECT_FALSE(sweeps.back().isCarried);
}

TEST(CutTool, KeepsWhatWaitsOfAStrokeWhenTheNextBegins) {
    CutTool tool = withBlade();
    for (const float y : {0.0f, 0.1f}) {
        tool.press(fromFront, {0, y});
        tool.move(fromFront, {0.1f, y});
        tool.release();
    }
    EXPECT_TRUE(tool.next());
    EXPECT_TRUE(tool.beginsStroke());
    EXPECT_TRUE(tool.next());
}

TEST(CutTool, DropsWhatIsStillToBeCut) {
    CutTool tool = withBlade();
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.1f, 0});
    tool.drop();
    EXPECT_FALSE(tool.next());
    EXPECT_FALSE(tool.isCutting());
    EXPECT_TRUE(tool.isOn());
}

TEST(CutTool, CutsAgainFirstWhatWasUndone) {
    CutTool tool = withBlade();
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.1f, 0});
    tool.move(fromFront, {0.2f, 0});
    const std::array undone{*tool.next()};
    tool.putBack(undone);
    EXPECT_TRUE(tool.beginsStroke());
    EXPECT_EQ(toVector(tool.next()->to[0]), toVector(undone[0].to[0]));
    EXPECT_TRUE(tool.next()->isCarried);
}

} // namespace
} // namespace sinew::viewer
