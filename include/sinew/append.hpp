// Scenes as parts of a larger one: their lists behind those of the other scene, with shifted indices.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <cstdint>

namespace sinew::sim {

/// A number of elements in each list of a scene: the length of its lists, or a place in them.
struct SINEW_API SceneCounts {
    std::uint32_t particles = 0, distances = 0, bends = 0, attachments = 0, tethers = 0, fixed = 0,
                  planes = 0, colliders = 0, driven = 0, faces = 0, bodies = 0, grids = 0, skins = 0,
                  holds = 0;
};

SINEW_API SceneCounts countsOf(const Scene& scene);

/// Appends all lists of `part` to those of `scene`, and returns where they begin. Surfaces of particles
/// (ContactSettings::surfaces) that the scene lacks are appended too; everything else that holds for a whole
/// scene, such as gravity, remains that of `scene`. Throws std::length_error if a list would have more than
/// 2^32 - 1 elements.
SINEW_API SceneCounts append(Scene& scene, const Scene& part);

} // namespace sinew::sim
