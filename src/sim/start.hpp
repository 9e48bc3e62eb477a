// How bodies are when a simulation begins: turned, moving, spinning.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

struct Start {
    Vec3 velocity;       ///< of the centre of mass [m/s]
    Vec3 spin;           ///< angular velocity about the centre of mass [rad/s]
    Quaternion rotation; ///< about the middle of the body's bounding box
};

/// Turns each of scene.bodies from `firstBody` on, and sets the velocities of its particles, each body about
/// its own middle and centre of mass. Held particles are turned and stay at rest; centres of mass are those
/// of the particles that move. Links keep their lengths at rest, and loose particles their distances.
void start(Scene& scene, std::size_t firstBody, const Start& how);

} // namespace sinew::sim
