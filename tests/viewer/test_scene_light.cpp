// Tests of the scene's bounds, and of the volume that the shadow maps cover.
#include "viewer/render/scene_light.hpp"

#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::viewer {
namespace {

Vector3 transform(const layout::mat4& matrix, const Vector3& point) {
    const Eigen::Vector4f clip = Eigen::Map<const Matrix4>(matrix.columns) * point.homogeneous();
    return clip.head<3>() / clip.w();
}

sim::Scene droppedBlock() {
    sim::Scene scene;
    sim::addLattice(scene, {.origin = {1, 0.5f, -2}, .cells = {2, 3, 4}, .spacing = 0.1f});
    scene.planes.push_back({.offset = -0.25f});
    return scene;
}

TEST(Document, HasAGroundOnlyWhereAPlaneFacesUp) {
    sim::Scene scene;
    EXPECT_FALSE(groundHeight(scene));
    scene.planes.push_back({.normal = {1, 0, 0}, .offset = 3});
    EXPECT_FALSE(groundHeight(scene));
    scene.planes.push_back({.offset = -0.5f});
    scene.planes.push_back({.offset = 0.25f});
    EXPECT_EQ(groundHeight(scene), 0.25f) << "the highest is the one that bodies reach";
}

TEST(Document, ReachesFromTheBodyDownToTheGround) {
    const Box bounds = sceneBounds(droppedBlock());
    EXPECT_FLOAT_EQ(bounds.min().y(), -0.25f);
    EXPECT_FLOAT_EQ(bounds.max().y(), 0.8f);
    EXPECT_FLOAT_EQ(bounds.sizes().x(), 0.2f);
}

TEST(Document, LeavesRoomForClothToSwingDown) {
    sim::Scene scene;
    sim::addCloth(scene, {.origin = {0, 1, 0}, .size = {11, 11}, .spacing = 0.1f, .pinned = {0, 10}});
    EXPECT_LE(sceneBounds(scene).min().y(), 0.0f);
    EXPECT_GE(sceneBounds(scene).min().y(), -0.5f);
}

TEST(Document, OfAnEmptySceneIsFinite) {
    const layout::FrameParams params = frameParams(lightFor(sim::Scene{}, Camera{}), Camera{}, 1.5f);
    EXPECT_TRUE(Eigen::Map<const Matrix4>(params.clipFromWorld.columns).allFinite());
    EXPECT_TRUE(Eigen::Map<const Matrix4>(params.shadowFromWorld.columns).allFinite());
}

TEST(SceneLight, ShadowMapHoldsTheWholeScene) {
    const SceneLight light = lightFor(droppedBlock(), Camera{});
    const layout::FrameParams params = frameParams(light, Camera{}, 1.5f);
    for (int corner = 0; corner < 8; ++corner) {
        const Vector3 at =
            transform(params.shadowFromWorld, light.bounds.corner(static_cast<Box::CornerType>(corner)));
        EXPECT_LE(std::abs(at.x()), 1.001f);
        EXPECT_LE(std::abs(at.y()), 1.001f);
        EXPECT_GE(at.z(), -0.001f);
        EXPECT_LE(at.z(), 1.001f);
    }
}

TEST(SceneLight, DepthGrowsAwayFromTheLight) {
    const SceneLight light = lightFor(droppedBlock(), Camera{});
    const layout::FrameParams params = frameParams(light, Camera{}, 1.5f);
    const Vector3 center = light.bounds.center();
    EXPECT_LT(transform(params.shadowFromWorld, center + 0.1f * light.toLight).z(),
              transform(params.shadowFromWorld, center).z());
}

TEST(SceneLight, FloorMapHoldsTheShadowsOfTheScene) {
    const SceneLight light = lightFor(droppedBlock(), Camera{});
    const layout::FrameParams params = frameParams(light, Camera{}, 1.5f);
    for (int corner = 0; corner < 8; ++corner) {
        Vector3 at = light.bounds.corner(static_cast<Box::CornerType>(corner));
        at -= (at.y() - *light.ground) / light.toLight.y() * light.toLight; // its shadow on the ground
        EXPECT_LE(std::abs(at.x() - params.floor.x), params.floor.z / 2);
        EXPECT_LE(std::abs(at.z() - params.floor.y), params.floor.z / 2);
    }
}

TEST(SceneLight, PlanMapMeasuresHeightAboveTheGround) {
    const SceneLight light = lightFor(droppedBlock(), Camera{});
    const layout::FrameParams params = frameParams(light, Camera{}, 1.5f);
    EXPECT_NEAR(transform(params.planFromWorld, {1, -0.25f, -2}).z(), 0, 1e-5f);
    EXPECT_NEAR(transform(params.planFromWorld, {1, 0.25f, -2}).z(), 0.5f / params.floor.w, 1e-5f);
}

TEST(SceneLight, DoesNotMoveWithTheBodies) {
    const SceneLight light = lightFor(droppedBlock(), Camera{});
    Camera moved = orbited(Camera{}, {0.3f, 0.1f});
    const layout::FrameParams a = frameParams(light, Camera{}, 1.5f), b = frameParams(light, moved, 1.5f);
    EXPECT_TRUE(
        std::equal(a.shadowFromWorld.columns, a.shadowFromWorld.columns + 16, b.shadowFromWorld.columns));
}

TEST(FrameParams, ViewRaysOfTheSkyGoWhereTheShiftedPictureShowsThem) {
    Camera camera;
    camera.shift = -0.3f;
    const layout::FrameParams params = frameParams(lightFor(droppedBlock(), camera), camera, 1.5f);
    const auto vector = [](const layout::vec4& v) { return Vector3(v.x, v.y, v.z); };
    const Vector2 clip(0.4f, -0.7f);
    const Vector3 ray =
        vector(params.rayForward) + clip.x() * vector(params.rayRight) + clip.y() * vector(params.rayUp);
    const Vector3 seen = rayThrough(camera, {0.5f * 1.5f * clip.x(), 0.5f * clip.y()}).direction;
    EXPECT_LT((ray.normalized() - seen).norm(), 1e-5f);
}

TEST(Grid, SpacingIsARoundNumber) {
    EXPECT_FLOAT_EQ(gridSpacing(1), 0.2f);
    EXPECT_FLOAT_EQ(gridSpacing(0.6f), 0.1f);
    EXPECT_FLOAT_EQ(gridSpacing(30), 5);
}

} // namespace
} // namespace sinew::viewer
