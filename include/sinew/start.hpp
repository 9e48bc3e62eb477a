// Initial motion of bodies: rotation, velocity, spin.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim {

struct SINEW_API Start {
    Vec3 velocity;       ///< of the centre of mass [m/s]
    Vec3 spin;           ///< angular velocity about the centre of mass [rad/s]
    Quaternion rotation; ///< about the middle of the body's bounding box
};

/// Rotates each of scene.bodies from `firstBody` on, and sets the velocities of its particles, each body
/// about its own middle and centre of mass. Fixed particles are rotated and stay at rest; the centre of mass
/// is that of the moving particles. Links keep their rest lengths, and loose particles their distances.
SINEW_API void start(Scene& scene, std::size_t firstBody, const Start& how);

} // namespace sinew::sim
