// Tests of the conversion of pointer strokes to blade sweeps, without a device.
#include "viewer/tools/cut_tool.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::viewer {
namespace {

const Camera fromFront{.distance = 3, .azimuth = 0, .elevation = 0};
const Box document(Vector3(-0.5f, -0.5f, -0.5f), Vector3(0.5f, 0.5f, 0.5f));

Vector3 toVector(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

CutTool withBlade() {
    CutTool tool(document);
    tool.toggle();
    return tool;
}

TEST(CutTool, CutsNothingUntilItIsTakenUp) {
    CutTool tool(document);
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.2f, 0});
    EXPECT_FALSE(tool.next());
}

TEST(CutTool, SweepsFromBeforeTheSceneToBehindItAndEachGoesOnWhereTheLastEnded) {
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

TEST(CutTool, EndsAStrokeBesideTheSceneAndBeginsAnotherWhereItComesBack) {
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

TEST(CutTool, CutsNoChordWhereAStrokeLeftTheScene) {
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

TEST(CutTool, CutsWhatWasSweptWhenItIsPutAway) {
    CutTool tool = withBlade();
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.1f, 0});
    tool.toggle();
    tool.move(fromFront, {0.2f, 0});
    EXPECT_FALSE(tool.isDown());
    EXPECT_FALSE(tool.path().empty());
    EXPECT_TRUE(tool.next());
    EXPECT_FALSE(tool.next());
    EXPECT_FALSE(tool.isCutting());
    EXPECT_TRUE(tool.path().empty());
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

// A wall across the view that ends on the right.
struct Wall {
    float z = 0.2f, end = 10;
    std::optional<Pick> under(const Ray& ray) const {
        const Vector3 at = ray.origin + (z - ray.origin.z()) / ray.direction.z() * ray.direction;
        return at.x() < end ? std::optional(Pick{.point = at}) : std::nullopt;
    }
};

CutTool withDepth(float depth) {
    CutTool tool = withBlade();
    tool.setDepth(depth);
    return tool;
}

void answerAll(CutTool& tool, const Wall& wall) {
    while (tool.question()) tool.answer(wall.under(*tool.question()));
}

std::vector<Sweep> cutsOf(CutTool& tool) {
    std::vector<Sweep> sweeps;
    while (const auto sweep = tool.next()) sweeps.push_back(*sweep);
    return sweeps;
}

// Depth along the ray through both ends of an edge.
float below(const Wall& wall, const std::array<sim::Vec3, 2>& edge) {
    const Vector3 from = eye(fromFront), end = toVector(edge[1]);
    const Ray ray{from, (end - from).normalized()};
    return (end - wall.under(ray)->point).dot(ray.direction);
}

TEST(CutTool, EndsAsDeepBelowTheSurfaceAsItIsSet) {
    const Wall wall;
    CutTool tool = withDepth(0.1f);
    tool.press(fromFront, {-0.1f, 0});
    tool.move(fromFront, {0, 0.02f});
    EXPECT_FALSE(tool.next()) << "nothing is cut until it is known where the surface is";
    EXPECT_TRUE(tool.isCutting());
    answerAll(tool, wall);
    tool.move(fromFront, {0.1f, 0.02f});
    tool.release();
    answerAll(tool, wall);
    const std::vector<Sweep> sweeps = cutsOf(tool);
    ASSERT_EQ(sweeps.size(), 2u);
    EXPECT_FALSE(sweeps[0].isCarried);
    EXPECT_TRUE(sweeps[1].isCarried);
    for (const Sweep& sweep : sweeps)
        for (const auto& edge : {sweep.from, sweep.to}) {
            EXPECT_NEAR(below(wall, edge), 0.1f, 1e-4f);
            EXPECT_GT(edge[0].z, 0.5f) << "before the stage";
        }
    EXPECT_FALSE(tool.isCutting());
    EXPECT_TRUE(tool.path().empty());
}

TEST(CutTool, GoesEvenlyBetweenPlacesWhoseSurfaceIsKnown) {
    CutTool tool = withDepth(0.1f);
    tool.press(fromFront, {0, 0});
    for (int i = 1; i <= 4; ++i) tool.move(fromFront, {0.02f * static_cast<float>(i), 0});
    tool.answer(Wall{.z = 0.3f}.under(*tool.question()));
    tool.answer(Wall{.z = 0.1f}.under(*tool.question()));
    EXPECT_FALSE(tool.question()) << "of the first place and the newest alone";
    const std::vector<Sweep> sweeps = cutsOf(tool);
    ASSERT_EQ(sweeps.size(), 4u);
    EXPECT_NEAR(below({.z = 0.3f}, sweeps[0].from), 0.1f, 1e-4f);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(sweeps[i].to[1].z, 0.2f - 0.05f * static_cast<float>(i + 1), 2e-3f) << i;
}

TEST(CutTool, KeepsTheDepthOfTheLastSurfaceBesideIt) {
    const Wall wall{.end = 0.15f};
    CutTool tool = withDepth(0.1f);
    tool.press(fromFront, {0, 0});
    answerAll(tool, wall);
    for (int i = 1; i <= 10; ++i) tool.move(fromFront, {0.01f * static_cast<float>(i), 0});
    tool.release();
    answerAll(tool, wall);
    const std::vector<Sweep> sweeps = cutsOf(tool);
    ASSERT_EQ(sweeps.size(), 10u);
    for (const Sweep& sweep : sweeps) EXPECT_NEAR(sweep.to[1].z, 0.1f, 5e-3f);
}

TEST(CutTool, CutsAllTheWayFromBesideABody) {
    const Wall wall{.end = 0};
    CutTool tool = withDepth(0.1f);
    tool.press(fromFront, {0.2f, 0});
    answerAll(tool, wall);
    for (int i = 1; i <= 20; ++i) {
        tool.move(fromFront, {0.2f - 0.02f * static_cast<float>(i), 0});
        if (i % 3 == 0) answerAll(tool, wall);
    }
    tool.release();
    answerAll(tool, wall);
    const std::vector<Sweep> sweeps = cutsOf(tool);
    ASSERT_FALSE(sweeps.empty());
    EXPECT_GT(sweeps.front().from[0].x, 0) << "from where nothing is";
    for (std::size_t i = 1; i < sweeps.size(); ++i)
        EXPECT_EQ(toVector(sweeps[i].from[1]), toVector(sweeps[i - 1].to[1]));
    EXPECT_NEAR(below(wall, sweeps.back().to), 0.1f, 1e-4f);
}

TEST(CutTool, CutsNothingToADepthWhereNothingIs) {
    CutTool tool = withDepth(0.1f);
    tool.press(fromFront, {0, 0});
    for (int i = 1; i <= 300; ++i) {
        tool.move(fromFront, {0.3f * std::sin(static_cast<float>(i)), 0});
        answerAll(tool, {.end = -10});
    }
    tool.release();
    answerAll(tool, {.end = -10});
    EXPECT_TRUE(cutsOf(tool).empty());
    EXPECT_FALSE(tool.isCutting());
    EXPECT_TRUE(tool.path().empty());
}

// For any order of presses, moves and answers, each stroke begins once, and every answer is used.
TEST(CutTool, FindsAnEndWhateverIsAnswered) {
    std::uint32_t state = 1;
    const auto random = [&] {
        return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f;
    };
    CutTool tool = withDepth(0.05f);
    std::vector<Sweep> sweeps;
    for (int i = 0; i < 5000; ++i) {
        const Vector2 at(random() - 0.5f, 0.5f * random() - 0.25f);
        if (const float what = random(); what < 0.05f)
            tool.press(fromFront, at);
        else if (what < 0.1f)
            tool.release();
        else if (what < 0.12f)
            tool.deepen(random() < 0.5f ? -3.0f : 3.0f);
        else if (what < 0.6f)
            tool.move(fromFront, at);
        else if (tool.question())
            tool.answer(Wall{.end = 0.6f * random() - 0.3f}.under(*tool.question()));
        if (random() < 0.3f)
            if (const auto sweep = tool.next()) sweeps.push_back(*sweep);
    }
    tool.release();
    answerAll(tool, {});
    for (const Sweep& sweep : cutsOf(tool)) sweeps.push_back(sweep);
    EXPECT_FALSE(tool.isCutting());
    ASSERT_GT(sweeps.size(), 500u);
    for (std::size_t i = 1; i < sweeps.size(); ++i) {
        EXPECT_TRUE(!sweeps[i].isCarried || toVector(sweeps[i].from[1]) == toVector(sweeps[i - 1].to[1]))
            << i;
    }
}

TEST(CutTool, GetsDeeperByTheWheelUntilItGoesThrough) {
    CutTool tool = withBlade();
    EXPECT_FALSE(tool.depth());
    tool.deepen(1);
    EXPECT_FALSE(tool.depth()) << "nothing is deeper than through";
    tool.deepen(-1);
    EXPECT_EQ(tool.depth(), tool.depths().most);
    tool.deepen(-1000);
    EXPECT_EQ(tool.depth(), tool.depths().least);
    tool.deepen(1);
    EXPECT_GT(tool.depth(), tool.depths().least);
    tool.deepen(1000);
    EXPECT_FALSE(tool.depth());
}

TEST(CutTool, ThatGoesThroughFromNowOnWaitsForNothing) {
    CutTool tool = withDepth(0.1f);
    tool.press(fromFront, {0, 0});
    tool.move(fromFront, {0.1f, 0});
    tool.setDepth(std::nullopt);
    EXPECT_FALSE(tool.question());
    const auto sweep = tool.next();
    ASSERT_TRUE(sweep);
    EXPECT_LT(sweep->to[1].z, -0.5f) << "behind the stage";
}

// The depth is drawn to scale at the surface.
TEST(CutTool, ShowsItsDepthAtThePointer) {
    CutTool tool = withDepth(0.1f);
    tool.move(fromFront, {0, 0});
    EXPECT_TRUE(tool.gauge().empty()) << "where the surface is, nobody knows yet";
    ASSERT_TRUE(tool.preview());
    tool.answerPreview(Wall{}.under(*tool.preview()));
    ASSERT_EQ(tool.gauge().size(), 2u);
    const float enlarged = (fromFront.distance - 0.2f) / (tool.gauge()[0] - eye(fromFront)).norm();
    const Vector3 shown = enlarged * (tool.gauge()[1] - tool.gauge()[0]);
    EXPECT_LT((shown - Vector3(0, -0.1f, 0)).norm(), 1e-4f) << "downwards";
    tool.move(fromFront, {0, 0});
    EXPECT_FALSE(tool.preview()) << "it is known";
    for (int step = 0; step < 20; ++step) tool.stepTaken();
    tool.move(fromFront, {0, 0});
    EXPECT_TRUE(tool.preview()) << "it may have moved";
    tool.setDepth(std::nullopt);
    EXPECT_TRUE(tool.gauge().empty());
    tool.toggle();
    EXPECT_FALSE(tool.preview());
}

} // namespace
} // namespace sinew::viewer
