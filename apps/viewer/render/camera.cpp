// Camera motions, as pure functions from camera to camera.
#include "viewer/render/camera.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

constexpr float pi = 3.14159265f;
constexpr float steepest = 1.55f;     // [rad]; at pi / 2 "up" would be undefined
constexpr float turnPerHeight = 3.5f; // [rad]: a drag across the window turns a little more than half round
constexpr float smallestDistance = 1e-3f, largestDistance = 1e5f; // [m]

Vector3 fromTarget(const Camera& camera) {
    const float level = std::cos(camera.elevation);
    return {level * std::sin(camera.azimuth), std::sin(camera.elevation), level * std::cos(camera.azimuth)};
}

// Raises the eye to its lowest height; the target rises with it if the distance is too short.
Camera settled(Camera camera) {
    camera.azimuth = std::remainder(camera.azimuth, 2 * pi);
    camera.distance = std::clamp(camera.distance, smallestDistance, largestDistance);
    camera.target.y() = std::max(camera.target.y(), camera.lowestEye - 0.5f * camera.distance);
    const float rise = (camera.lowestEye - camera.target.y()) / camera.distance;
    const float lowest = std::asin(std::clamp(rise, -1.0f, 1.0f));
    camera.elevation = std::clamp(camera.elevation, std::clamp(lowest, -steepest, steepest), steepest);
    return camera;
}

// The camera's right, up and back in world coordinates, as rows.
Eigen::Matrix3f axes(const Camera& camera) {
    return viewMatrix(camera).block<3, 3>(0, 0);
}

} // namespace

Vector3 eye(const Camera& camera) {
    return camera.target + camera.distance * fromTarget(camera);
}

float pictureHeight(const Camera& camera) {
    return 2 * camera.distance * std::tan(camera.fieldOfView / 2);
}

Matrix4 viewMatrix(const Camera& camera) {
    return lookAt(eye(camera), camera.target, Vector3::UnitY());
}

Matrix4 clipMatrix(const Camera& camera, float aspect, float reach) {
    const float near = std::min(0.02f * camera.distance, 1e-3f * reach);
    Matrix4 clip = perspective(camera.fieldOfView, aspect, near, reach);
    clip(0, 2) = -2 * camera.shift / aspect; // times -1: w is the depth
    return clip * viewMatrix(camera);
}

Camera lookingFrom(const Vector3& eye, const Vector3& target, float fieldOfView) {
    const Vector3 away = eye - target;
    Camera camera;
    camera.target = target;
    camera.distance = std::max(away.norm(), smallestDistance);
    camera.azimuth = std::atan2(away.x(), away.z());
    camera.elevation = std::asin(std::clamp(away.y() / camera.distance, -1.0f, 1.0f));
    camera.fieldOfView = fieldOfView * pi / 180;
    return settled(camera);
}

Ray rayThrough(const Camera& camera, const Vector2& pointer) {
    const Eigen::Matrix3f world = axes(camera);
    const float height = 2 * std::tan(camera.fieldOfView / 2); // of the picture at unit depth
    const Vector3 direction =
        world.transpose() * Vector3(height * (pointer.x() - camera.shift), -height * pointer.y(), -1);
    return {eye(camera), direction.normalized()};
}

std::optional<Vector3> meet(const Ray& ray, const Vector3& point, const Vector3& normal) {
    const float facing = ray.direction.dot(normal);
    if (facing < 0.05f) return std::nullopt;
    return ray.origin + (point - ray.origin).dot(normal) / facing * ray.direction;
}

Camera orbited(Camera camera, const Vector2& drag) {
    camera.azimuth -= turnPerHeight * drag.x();
    camera.elevation += turnPerHeight * drag.y();
    return settled(camera);
}

Camera panned(Camera camera, const Vector2& drag) {
    const Eigen::Matrix3f world = axes(camera);
    camera.target +=
        pictureHeight(camera) * (world.row(1).transpose() * drag.y() - world.row(0).transpose() * drag.x());
    return settled(camera);
}

Camera zoomed(Camera camera, float factor, const Vector2& pointer) {
    const Eigen::Matrix3f world = axes(camera);
    const float before = pictureHeight(camera);
    camera.distance = std::clamp(camera.distance * factor, smallestDistance, largestDistance);
    const float shrunk = before - pictureHeight(camera);
    camera.target += shrunk * (world.row(0).transpose() * (pointer.x() - camera.shift) -
                               world.row(1).transpose() * pointer.y());
    return settled(camera);
}

Camera centered(Camera camera, const Vector3& point) {
    const float depth = (eye(camera) - point).dot(fromTarget(camera));
    if (!(depth > 0)) return camera;
    camera.target = point;
    camera.distance = depth;
    return settled(camera);
}

Camera framing(Camera camera, const Box& box, float aspect) {
    constexpr float margin = 1.12f;
    const float tanY = std::tan(camera.fieldOfView / 2) / margin, tanX = tanY * aspect;
    camera.target = box.center();
    const Eigen::Matrix3f world = axes(camera);
    float distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vector3 at = world * (box.corner(static_cast<Box::CornerType>(corner)) - box.center());
        distance = std::max(distance, at.z() + std::max(std::abs(at.x()) / tanX, std::abs(at.y()) / tanY));
    }
    camera.distance = distance > 0 ? distance : 1;
    return settled(camera);
}

Camera fitted(Camera camera, const Box& box, float aspect) {
    constexpr float margin = 1.05f, wide = 16.0f / 9;
    if (aspect >= wide) return camera;
    const float tanX = std::tan(camera.fieldOfView / 2) / margin * aspect;
    const Eigen::Matrix3f world = axes(camera);
    float needed = camera.distance;
    for (int corner = 0; corner < 8; ++corner) {
        const Vector3 at = world * (box.corner(static_cast<Box::CornerType>(corner)) - camera.target);
        needed = std::max(needed, at.z() + std::abs(at.x()) / tanX);
    }
    camera.distance = std::min(needed, camera.distance * wide / aspect);
    return settled(camera);
}

} // namespace sinew::viewer
