// Private buffers of a simulation, for hosts that draw its inner state between steps: live links, hash grids,
// contact lists. Elements are those of shaders/glsl/common/layout.h in the sources, which is no public
// header; they may change with any version.
#pragma once

#include "sinew/export.hpp"
#include "sinew/simulation.hpp"

#include <string>
#include <vector>

namespace sinew::sim {

/// Order of the particles in private buffers.
struct SINEW_API ParticleSlots {
    std::vector<std::uint32_t> slot; ///< by particle
    std::size_t count = 0;           ///< slots; some hold no particle
};
/// That order in every simulation of a valid scene with these settings.
SINEW_API ParticleSlots particleSlots(const Scene& scene, const Settings& settings);

/// By particle, a word: 0xfffffffe, a value that no other has, if the particle is part of a removed fragment.
/// Valid as Simulation::positions() is.
SINEW_API vk::BufferView removedParticles(const Simulation& simulation);

/// The hash grid of a contact search, as last built.
struct SINEW_API InspectedGrid {
    std::string name; ///< "grid" of particles, "faces.grid" of points, "edges.grid" of edges
    /// First entry in `sorted` by slot of the table, then the entry count; bits of a position and an index,
    /// ordered by slot; capacity of `sorted`.
    vk::BufferView bounds, starts, sorted;
    std::uint32_t count = 0; ///< elements that `sorted` may have
    std::uint32_t cells = 0; ///< slots of the table
};

/// Contact lists, as last built; a view is empty if the scene has no such contacts.
struct SINEW_API InspectedContacts {
    vk::BufferView pairs, pairLists;     ///< particles near a particle
    vk::BufferView faces;                ///< layout::ContactFace, between slots
    vk::BufferView facePairs, faceLists; ///< faces near a particle
    vk::BufferView edges;                ///< layout::ContactEdge, between slots
    vk::BufferView edgePairs, edgeLists; ///< edges near an edge
    std::uint32_t edgeCount = 0;
};

/// The vertices of a sheet's skin along cuts.
struct SINEW_API InspectedSheet {
    vk::BufferView vertices; ///< layout::SheetVertex
    std::uint32_t first = 0; ///< index in Simulation::skinVertices()
};

struct SINEW_API InspectedBuffers {
    std::uint32_t particles = 0;
    vk::BufferView liveLinks;    ///< by slot: bits of the live links of a grid; empty if nothing can be cut
    vk::BufferView wholeIndices; ///< of all skins while nothing is cut; empty without skins
    std::vector<InspectedGrid> grids;   ///< one for each contact search that uses a grid
    std::vector<InspectedSheet> sheets; ///< one for each cuttable sheet with a skin
    InspectedContacts contacts;
};
/// The views are valid as long as the simulation. Contents are those of the newest recorded step, visible as
/// Simulation::positions() are. Allocates; reads nothing from the device.
SINEW_API InspectedBuffers inspect(const Simulation& simulation);

} // namespace sinew::sim
