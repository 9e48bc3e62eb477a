// The keys friction, static_friction, restitution and rest_contact of a body: what its particles are like to
// touch.
#pragma once

#include "scenes/section.hpp"

namespace sinew::scenes {

/// 0 where it is missing, which stands for as much as friction.
float staticFrictionOf(const Section& section);

/// Whether rest_contact is "keep", else "part". Throws SceneError for any other word.
bool isRestKept(const Section& section);

/// Gives the particles from `first` on the surface that `body` asks for, and Particle::keepsRest; without its
/// keys, those of [contacts]. Throws SceneError where they touch nothing.
void addSurface(LoadedScene& loaded, const Section& body, std::size_t first);

} // namespace sinew::scenes
