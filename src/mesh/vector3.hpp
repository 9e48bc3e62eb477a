// Double-precision vectors for the geometry inside sinew_mesh; never part of its interface.
#pragma once

#include "sinew/scene.hpp"

#include <Eigen/Geometry>

namespace sinew::mesh {

using Vector3 = Eigen::Vector3d;

inline Vector3 toVector(sim::Vec3 v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

inline sim::Vec3 toVec3(const Vector3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

} // namespace sinew::mesh
