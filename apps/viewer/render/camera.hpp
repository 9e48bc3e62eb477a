// An orbit camera: it looks at a target from a distance and two angles, and never rolls.
#pragma once

#include "viewer/render/geometry.hpp"

#include <limits>
#include <optional>

namespace sinew::viewer {

struct Camera {
    Vector3 target = Vector3::Zero(); ///< [m]
    float distance = 2;               ///< from the eye to the target [m]
    float azimuth = 0.6f;             ///< angle of the eye around y, 0 = on the +z side [rad]
    float elevation = 0.27f;          ///< angle of the eye above the target's level [rad]
    float fieldOfView = 0.7f;         ///< vertical [rad]
    float lowestEye = -std::numeric_limits<float>::infinity(); ///< the eye stays above this height [m]
    float shift = 0; ///< of the target to the right of the picture's middle [picture heights]; the lens is
                     ///< shifted, not turned, so that perspective stays the same
    bool operator==(const Camera&) const = default;
};

Vector3 eye(const Camera& camera);
/// Height of the picture at the target's depth [m].
float pictureHeight(const Camera& camera);
Matrix4 viewMatrix(const Camera& camera);

/// World to clip space for a picture of aspect ratio `aspect` (width / height), up to `reach` from the eye
/// [m].
Matrix4 clipMatrix(const Camera& camera, float aspect, float reach);

/// The camera at `eye` that looks at `target`; `fieldOfView` in degrees, as in scene files.
Camera lookingFrom(const Vector3& eye, const Vector3& target, float fieldOfView);

struct Ray {
    Vector3 origin = Vector3::Zero(), direction = Vector3::UnitZ(); ///< [m], unit length
    bool operator==(const Ray&) const = default;
};

/// The ray from the eye through `pointer` (x right, y down, from the picture's middle, in picture heights).
Ray rayThrough(const Camera& camera, const Vector2& pointer);

/// The point where the ray meets the plane through `point` with unit `normal`, which points away from the
/// eye. Empty at the plane's horizon and behind it.
std::optional<Vector3> meet(const Ray& ray, const Vector3& point, const Vector3& normal);

/// Orbits the target by a drag of (x right, y down) picture heights.
Camera orbited(Camera camera, const Vector2& drag);

/// Moves the target so that points at its depth follow a drag of (x, y) picture heights.
Camera panned(Camera camera, const Vector2& drag);

/// Multiplies the distance by `factor`. The point at the target's depth under `pointer` (x right, y down,
/// from the picture's middle, in picture heights) keeps its place.
Camera zoomed(Camera camera, float factor, const Vector2& pointer);

/// Makes `point` the target at its present depth, so that it moves to the picture's middle. No change if it
/// lies behind the eye.
Camera centered(Camera camera, const Vector3& point);

/// Keeps the direction of view and fits `box` into the picture with a small margin.
Camera framing(Camera camera, const Box& box, float aspect);

/// Keeps target and direction of a camera that was chosen for a wide picture (16 : 9), and moves it back
/// until `box` fits between the sides of a narrower one, or all that the wide picture shows between its own.
Camera fitted(Camera camera, const Box& box, float aspect);

} // namespace sinew::viewer
