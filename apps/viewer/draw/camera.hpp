// An orbit camera: it looks at a target from a distance and two angles, and never rolls.
#pragma once

#include "viewer/draw/geometry.hpp"

#include <limits>
#include <optional>

namespace sinew::viewer {

struct Camera {
    Vector3 target = Vector3::Zero(); ///< [m]
    float distance = 2;               ///< of the eye from the target [m]
    float azimuth = 0.6f;             ///< of the eye around y, 0 = on the +z side [rad]
    float elevation = 0.27f;          ///< of the eye above the target's level [rad]
    float fieldOfView = 0.7f;         ///< vertical [rad]
    float lowestEye = -std::numeric_limits<float>::infinity(); ///< the eye stays above this height [m]
    bool operator==(const Camera&) const = default;
};

Vector3 eye(const Camera& camera);
Matrix4 viewMatrix(const Camera& camera);

/// World to clip space for a picture `aspect` (width / height) wide; shows what lies within `reach` of the
/// eye [m].
Matrix4 clipMatrix(const Camera& camera, float aspect, float reach);

/// The camera at `eye` that looks at `target`; `fieldOfView` in degrees as in scene files.
Camera lookingFrom(const Vector3& eye, const Vector3& target, float fieldOfView);

struct Ray {
    Vector3 origin = Vector3::Zero(), direction = Vector3::UnitZ(); ///< [m], unit length
    bool operator==(const Ray&) const = default;
};

/// From the eye through `pointer` (x right, y down, from the picture's middle, in picture heights).
Ray rayThrough(const Camera& camera, const Vector2& pointer);

/// Where it meets a plane with this unit normal, which points away from the eye; nothing at the plane's
/// horizon and behind it.
std::optional<Vector3> meet(const Ray& ray, const Vector3& point, const Vector3& normal);

/// Turns around the target by a drag of (x to the right, y down) picture heights.
Camera orbited(Camera camera, const Vector2& drag);

/// Moves the target so that what lies at its depth follows a drag of (x, y) picture heights.
Camera panned(Camera camera, const Vector2& drag);

/// Multiplies the distance by `factor`. What lies at the target's depth under `pointer` (x right, y down,
/// from the picture's middle, in picture heights) stays there.
Camera zoomed(Camera camera, float factor, const Vector2& pointer);

/// Turns around `point` from now on, which comes to the picture's middle from as far away as it is. Only
/// where it is before the eye.
Camera centered(Camera camera, const Vector3& point);

/// The same direction of view, with all of `box` in the picture and little around it.
Camera framing(Camera camera, const Box& box, float aspect);

} // namespace sinew::viewer
