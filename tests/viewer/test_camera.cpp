// Tests of camera motions through the matrix that the shaders use.
#include "viewer/render/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sinew::viewer {
namespace {

constexpr float aspect = 16.0f / 9;

// x and y in [-1, 1] inside the picture, with y down; z is the depth.
Vector3 project(const Camera& camera, const Vector3& point) {
    const Eigen::Vector4f clip = clipMatrix(camera, aspect, 100) * point.homogeneous();
    return clip.head<3>() / clip.w();
}

Camera someCamera() {
    return lookingFrom({1.2f, 0.8f, 1.6f}, {0.1f, 0.3f, -0.2f}, 40);
}

TEST(Camera, LooksFromTheEyeAtTheTarget) {
    const Camera camera = someCamera();
    EXPECT_LT((eye(camera) - Vector3(1.2f, 0.8f, 1.6f)).norm(), 1e-5f);
    const Vector3 middle = project(camera, {0.1f, 0.3f, -0.2f});
    EXPECT_NEAR(middle.x(), 0, 1e-5f);
    EXPECT_NEAR(middle.y(), 0, 1e-5f);
}

TEST(Camera, ShowsUpAsUpAndRightAsRight) {
    Camera camera; // on the +z side
    camera.azimuth = 0;
    EXPECT_LT(project(camera, {0, 0.1f, 0}).y(), 0) << "Vulkan's y points down";
    EXPECT_GT(project(camera, {0.1f, 0, 0}).x(), 0);
}

TEST(Camera, DepthGrowsAwayFromTheEye) {
    Camera camera;
    camera.azimuth = camera.elevation = 0;
    const float front = project(camera, {0, 0, 1}).z(), back = project(camera, {0, 0, -5}).z();
    EXPECT_GT(front, 0);
    EXPECT_GT(back, front);
    EXPECT_LT(back, 1);
}

TEST(Camera, FieldOfViewIsVertical) {
    Camera camera;
    camera.azimuth = camera.elevation = 0;
    const float top = camera.distance * std::tan(camera.fieldOfView / 2);
    EXPECT_NEAR(project(camera, {0, top, 0}).y(), -1, 1e-5f);
    EXPECT_FLOAT_EQ(pictureHeight(camera), 2 * top);
    EXPECT_NEAR(project(camera, {top * aspect, 0, 0}).x(), 1, 1e-5f);
}

TEST(Camera, OrbitKeepsDistanceAndTarget) {
    const Camera before = someCamera(), after = orbited(before, {0.37f, -0.11f});
    EXPECT_FLOAT_EQ(after.distance, before.distance);
    EXPECT_EQ(after.target, before.target);
    EXPECT_NEAR((eye(after) - after.target).norm(), before.distance, 1e-5f);
    EXPECT_GT((eye(after) - eye(before)).norm(), 0.1f);
}

TEST(Camera, OrbitTurnsTheSceneWithTheHand) {
    Camera camera;
    camera.azimuth = camera.elevation = 0;
    const Vector3 nearPoint(0, 0, 0.5f); // between target and eye
    EXPECT_GT(project(orbited(camera, {0.1f, 0}), nearPoint).x(), 0) << "dragged to the right";
    EXPECT_GT(project(orbited(camera, {0, 0.1f}), nearPoint).y(), 0) << "dragged down";
}

TEST(Camera, OrbitNeverReachesThePole) {
    Camera camera = someCamera();
    for (const float down : {1.0f, -1.0f}) {
        for (int i = 0; i < 50; ++i) camera = orbited(camera, {0.3f, down});
        EXPECT_LT(std::abs(camera.elevation), 1.5708f);
        EXPECT_TRUE(clipMatrix(camera, aspect, 100).allFinite());
    }
}

TEST(Camera, EyeStaysAboveTheGround) {
    Camera camera = someCamera();
    camera.lowestEye = 0.05f;
    for (int i = 0; i < 40; ++i)
        camera = zoomed(panned(orbited(camera, {0.1f, -0.4f}), {0.05f, -0.2f}), 0.95f, {0.1f, 0.4f});
    EXPECT_GE(eye(camera).y(), 0.05f - 1e-4f);
}

TEST(Camera, PanCarriesTheTargetsDepthWithTheHand) {
    const Camera before = someCamera();
    const Camera after = panned(before, {0.25f, -0.1f}); // in picture heights, each half a clip unit
    const Vector3 moved = project(after, before.target);
    EXPECT_NEAR(moved.x(), 2 * 0.25f / aspect, 1e-4f);
    EXPECT_NEAR(moved.y(), 2 * -0.1f, 1e-4f);
}

TEST(Camera, ZoomKeepsWhatIsUnderThePointer) {
    const Camera before = someCamera();
    const Vector2 pointer(0.4f, -0.2f);
    const Vector3 point = panned(before, -pointer).target; // the point under the pointer
    ASSERT_NEAR(project(before, point).x(), 2 * pointer.x() / aspect, 1e-4f);
    const Camera after = zoomed(before, 0.5f, pointer);
    EXPECT_NEAR(after.distance, 0.5f * before.distance, 1e-5f);
    EXPECT_NEAR(project(after, point).x(), 2 * pointer.x() / aspect, 1e-3f);
    EXPECT_NEAR(project(after, point).y(), 2 * pointer.y(), 1e-3f);
}

TEST(Camera, FramingContainsTheBoundsFromEverySide) {
    const Box box(Vector3(-0.3f, 0, -1.1f), Vector3(0.5f, 0.4f, 0.2f));
    for (float azimuth = -3; azimuth < 3; azimuth += 0.7f)
        for (const float elevation : {-0.9f, 0.0f, 0.4f, 1.3f}) {
            Camera camera;
            camera.azimuth = azimuth;
            camera.elevation = elevation;
            camera = framing(camera, box, aspect);
            float widest = 0;
            for (int corner = 0; corner < 8; ++corner) {
                const Vector3 at = project(camera, box.corner(static_cast<Box::CornerType>(corner)));
                widest = std::max({widest, std::abs(at.x()), std::abs(at.y())});
                EXPECT_GT(at.z(), 0);
            }
            EXPECT_LE(widest, 1) << "nothing is cut off";
            EXPECT_GE(widest, 0.7f) << "little room is wasted";
        }
}

TEST(Camera, AShiftMovesThePictureAndTheRaysButKeepsPerspective) {
    const Camera straight = someCamera();
    Camera shifted = straight;
    shifted.shift = -0.22f; // [picture heights]
    for (const Vector3& point :
         {Vector3(0.1f, 0.3f, -0.2f), Vector3(0.4f, 0.1f, 0.3f), Vector3(-0.5f, 0.2f, 0)}) {
        const Vector3 before = project(straight, point), after = project(shifted, point);
        EXPECT_NEAR(after.x() - before.x(), 2 * shifted.shift / aspect, 1e-5f) << "at every depth";
        EXPECT_NEAR(after.y(), before.y(), 1e-5f);
        EXPECT_NEAR(after.z(), before.z(), 1e-5f);
        const Ray ray = rayThrough(shifted, {0.5f * aspect * after.x(), 0.5f * after.y()});
        EXPECT_LT((point - ray.origin).cross(ray.direction).norm(), 1e-4f) << "picked where it is drawn";
    }
    const Vector2 pointer(-0.35f, 0.1f);
    const Vector3 under =
        *meet(rayThrough(shifted, pointer), shifted.target, (shifted.target - eye(shifted)).normalized());
    const Vector3 kept = project(zoomed(shifted, 0.6f, pointer), under);
    EXPECT_NEAR(kept.x(), 2 * pointer.x() / aspect, 1e-3f) << "the wheel zooms to the pointer";
    EXPECT_NEAR(kept.y(), 2 * pointer.y(), 1e-3f);
}

TEST(Camera, OfAFileIsMovedBackUntilANarrowPictureShowsTheBodies) {
    const Box box(Vector3(-0.4f, 0, -0.3f), Vector3(0.4f, 0.4f, 0.3f));
    const Camera camera = lookingFrom({0.9f, 0.6f, 1.2f}, {0, 0.15f, 0}, 40);
    EXPECT_EQ(fitted(camera, box, 16.0f / 9), camera);
    EXPECT_EQ(fitted(camera, Box(Vector3(-0.1f, 0, -0.1f), Vector3(0.1f, 0.2f, 0.1f)), 1), camera)
        << "it shows them as it is";
    for (const float narrow : {0.8f, 0.65f}) {
        const auto widest = [&](const Camera& seen) {
            float most = 0;
            for (int corner = 0; corner < 8; ++corner) {
                const Vector3 at = box.corner(static_cast<Box::CornerType>(corner));
                const Eigen::Vector4f clip = clipMatrix(seen, narrow, 100) * at.homogeneous();
                most = std::max(most, std::abs(clip.x() / clip.w()));
            }
            return most;
        };
        const Camera back = fitted(camera, box, narrow);
        EXPECT_GT(widest(camera), 1) << "narrow enough to need it";
        EXPECT_LE(widest(back), 1);
        EXPECT_GT(widest(back), 0.9f);
        EXPECT_EQ(back.target, camera.target);
    }
    const Box wide(Vector3(-9, 0, -9), Vector3(9, 1, 9)); // a file may show a part of a scene
    EXPECT_FLOAT_EQ(fitted(camera, wide, 1).distance, camera.distance * 16 / 9);
}

TEST(Camera, FramingOfOnePointStaysFinite) {
    const Camera camera = framing(Camera{}, Box(Vector3(1, 2, 3)), aspect);
    EXPECT_TRUE(clipMatrix(camera, aspect, 100).allFinite());
    EXPECT_EQ(camera.target, Vector3(1, 2, 3));
}

TEST(Camera, TurnsAroundAPointFromWhereItIsAndLooksTheSameWay) {
    Camera camera;
    camera.target = {0.3f, 0.4f, -0.1f};
    const Vector3 point(0.1f, 0.6f, 0.5f);
    const Camera around = centered(camera, point);
    EXPECT_EQ(around.target, point);
    EXPECT_EQ(around.azimuth, camera.azimuth);
    EXPECT_EQ(around.elevation, camera.elevation);
    const auto depth = [&](const Camera& seen) { return -(viewMatrix(seen) * point.homogeneous()).z(); };
    EXPECT_NEAR(depth(around), depth(camera), 1e-5f) << "as large as before";
    EXPECT_EQ(centered(camera, 2 * eye(camera) - camera.target), camera) << "a point behind the eye";
}

} // namespace
} // namespace sinew::viewer
