// Warnings of what a scene has in vain.
#pragma once

#include "scenes/load.hpp"
#include "scenes/section.hpp"

namespace sinew::scenes {

/// Warns of planes, colliders and mesh colliders that nothing can touch: no particle moves, or none that does
/// touches meshes. `top` names them.
void warnOfUntouched(LoadedScene& loaded, const Section& top);

} // namespace sinew::scenes
