// Tests of the meshes of walls. No device is needed.
#include "viewer/render/walls.hpp"

#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

sim::Scene balls() {
    sim::Scene scene;
    sim::addParticles(scene, {.center = {0, 1, 0}, .count = {8, 8, 8}, .radius = 0.05f});
    scene.planes.push_back({});
    return scene;
}

sim::Scene boxOf(float half) {
    sim::Scene scene = balls();
    for (const sim::Vec3& normal :
         {sim::Vec3{1, 0, 0}, sim::Vec3{-1, 0, 0}, sim::Vec3{0, 0, 1}, sim::Vec3{0, 0, -1}})
        scene.planes.push_back({.normal = normal, .offset = -half});
    return scene;
}

Vector3 vectorOf(const sim::layout::vec4& v) {
    return {v.x, v.y, v.z};
}

Box boundsOf(const ColliderMesh& mesh) {
    Box box;
    for (const auto& vertex : mesh.vertices) box.extend(vectorOf(vertex.position));
    return box;
}

const Box region(Vector3(-2, 0, -2), Vector3(2, 3, 2));

} // namespace

TEST(Walls, OfALevelFloorAreNone) {
    EXPECT_TRUE(wallsOf(balls(), region).isEmpty());
    sim::Scene lid = balls();
    lid.planes.push_back({.normal = {0, -1, 0}, .offset = -4});
    EXPECT_TRUE(wallsOf(lid, region).isEmpty());
}

TEST(Walls, OfABoxMeetInItsCornersAndFaceInwards) {
    const sim::Scene scene = boxOf(0.6f);
    const WallMesh mesh = wallsOf(scene, region);
    EXPECT_EQ(mesh.sides.indices.size(), 4 * 2 * 3u);
    const Box box = boundsOf(mesh.sides);
    EXPECT_LT((box.min() - Vector3(-0.6f, 0, -0.6f)).norm(), 1e-5f);
    EXPECT_NEAR(box.max().x(), 0.6f, 1e-5f);
    EXPECT_NEAR(box.max().z(), 0.6f, 1e-5f);
    const float filled = 512 * 4.18879f * 0.05f * 0.05f * 0.05f / (1.2f * 1.2f); // by the balls' volume alone
    EXPECT_GT(box.max().y(), filled / 0.64f) << "it holds them at rest";
    EXPECT_LT(box.max().y(), particleBounds(scene).max().y()) << "they fall into it";
    for (const ColliderMesh* part : {&mesh.sides, &mesh.bars})
        for (std::size_t i = 0; i < part->indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) { return part->vertices[part->indices[i + k]]; };
            const Vector3 a = vectorOf(corner(0).position), b = vectorOf(corner(1).position),
                          c = vectorOf(corner(2).position);
            EXPECT_GT((b - a).cross(c - a).normalized().dot(vectorOf(corner(0).normal)), 0.99f);
        }
    EXPECT_LT(boundsOf(mesh.bars).exteriorDistance(box), 1e-6f);
    EXPECT_LT((boundsOf(mesh.bars).sizes() - box.sizes()).cwiseAbs().maxCoeff(), 0.05f) << "bars are thin";
}

TEST(Walls, WithoutNeighboursEndWithTheScene) {
    sim::Scene scene = balls();
    scene.planes.push_back({.normal = {0.6f, 0.8f, 0}, .offset = -0.4f}); // a slope
    const WallMesh mesh = wallsOf(scene, region);
    ASSERT_FALSE(mesh.isEmpty());
    const Box box = boundsOf(mesh.sides);
    EXPECT_NEAR(box.min().z(), -4, 1e-4f);
    EXPECT_NEAR(box.max().z(), 4, 1e-4f);
    EXPECT_GE(box.min().y(), -1e-5f);
    for (const auto& vertex : mesh.sides.vertices)
        EXPECT_NEAR(vectorOf(vertex.position).dot(Vector3(0.6f, 0.8f, 0)), -0.4f, 1e-4f);
    scene.planes.back().offset = -9; // beyond the scene
    EXPECT_TRUE(wallsOf(scene, region).isEmpty());
}

} // namespace sinew::viewer
