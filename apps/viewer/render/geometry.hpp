// Vectors, matrices and boxes of the viewer. y points up; matrices are column-major and multiply column
// vectors.
#pragma once

#include "sinew/scene.hpp"

#include <Eigen/Geometry>

#include <optional>

namespace sinew::viewer {

using Vector2 = Eigen::Vector2f;
using Vector3 = Eigen::Vector3f;
using Matrix4 = Eigen::Matrix4f;
using Box = Eigen::AlignedBox3f; ///< [m]

/// World to view: the eye at the origin looking down -z. `up` must not be parallel to the line of sight.
Matrix4 lookAt(const Vector3& eye, const Vector3& target, const Vector3& up);

/// View to Vulkan clip space (y down, depth 0 at `near`, 1 at `far`). `fieldOfView` is vertical [rad].
Matrix4 perspective(float fieldOfView, float aspect, float near, float far);

/// View to clip space for a box given in view space: x and y to [-1, 1], depth 0 at its high z (nearest), 1
/// at its low.
Matrix4 orthographic(const Box& box);

/// The box around `box` after `transform` (affine).
Box transformed(const Box& box, const Matrix4& transform);

/// The box around the scene's particles, with their radii, at the start. A scene without particles gives the
/// box of one point, the origin.
Box particleBounds(const sim::Scene& scene);

/// Height of the highest boundary plane that faces straight up [m].
std::optional<float> groundHeight(const sim::Scene& scene);

/// The box in which bodies are expected: their box at the start, joined with the colliders, with where they
/// would land on the ground, and with how far they can hang down from fixed particles.
Box sceneBounds(const sim::Scene& scene);

} // namespace sinew::viewer
