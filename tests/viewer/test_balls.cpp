// Tests of the selection of bodies without a skin, which are drawn as balls. No device is needed.
#include "viewer/render/balls.hpp"

#include "sinew/bodies.hpp"
#include "viewer/render/geometry.hpp"

#include <gtest/gtest.h>

#include <map>

namespace sinew::viewer {
namespace {

Vector3 at(const BallMesh& ball, std::uint32_t i) {
    return Vector3(ball.corners[i][0], ball.corners[i][1], ball.corners[i][2]);
}

} // namespace

TEST(BallMesh, IsAClosedBallOfRadiusOneTurnedOutwards) {
    for (const std::uint32_t cuts : {0u, 1u, 2u}) {
        const BallMesh ball = makeBall(cuts);
        EXPECT_EQ(ball.triangles.size(), 20u << 2 * cuts);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const auto& [i, j, k] : ball.triangles) {
            for (const auto& edge : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}}) ++edges[edge];
            EXPECT_GT((at(ball, j) - at(ball, i)).cross(at(ball, k) - at(ball, i)).dot(at(ball, i)), 0);
        }
        for (const auto& [edge, count] : edges) {
            EXPECT_EQ(count, 1);
            EXPECT_TRUE(edges.contains({edge.second, edge.first}));
        }
        for (std::uint32_t i = 0; i < ball.corners.size(); ++i) EXPECT_NEAR(at(ball, i).norm(), 1, 1e-6);
    }
}

TEST(Balls, ShowBodiesWithoutASkinAndNoOthers) {
    sim::Scene scene;
    sim::addCloth(scene, {.size = {3, 3}, .spacing = 0.1f, .radius = 0.05f});
    EXPECT_TRUE(ballsOf(scene).ranges.empty());
    sim::addChain(scene, {.particles = 5, .length = 1});
    sim::addParticles(scene, {.count = {2, 2, 2}, .radius = 0.05f, .color = {0.1f, 0.2f, 0.3f}});
    const BallList list = ballsOf(scene);
    ASSERT_EQ(list.ranges.size(), 2u);
    EXPECT_EQ(list.ranges[0].first, 9u);
    EXPECT_EQ(list.ranges[0].count, 5u);
    EXPECT_EQ(list.ranges[1].first, 14u);
    EXPECT_EQ(list.ranges[1].color.z, 0.3f);
    ASSERT_EQ(list.radii.size(), scene.particles.size());
    EXPECT_FLOAT_EQ(list.radii[9], 0.1f) << "0.4 of a link";
    EXPECT_EQ(list.radii[14], 0.05f) << "as they touch";
}

TEST(Balls, MakeALongChainATubeThatCanBeSeen) {
    sim::Scene scene;
    sim::addChain(scene, {.particles = 100, .length = 1});
    const BallList list = ballsOf(scene);
    EXPECT_NEAR(list.radii[0], 0.012f, 1e-4f) << "more than 0.4 of a link";
    EXPECT_LT(allBallsOf(scene).radii[0], 0.02f);
}

} // namespace sinew::viewer
