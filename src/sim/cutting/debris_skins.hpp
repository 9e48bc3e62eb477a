// Hides fragments (debris.hpp) in the skins. Skins that are clipped, and those of sheets, have separate
// pieces; the list of skins collapses the vertices of removed ones to a point. Other skins stretch over cuts;
// for them the triangles that depend on removed particles are collapsed in the index buffers.
#pragma once

#include "sim/model/state.hpp"

namespace sinew::sim::cutting {

struct Cut;

struct DebrisSkins {
    /// Triangles of skins that are not clipped, in StepProgram::skinIndices, and the particles they depend
    /// on.
    BufferId triangles, holders;
    std::uint32_t triangleCount = 0;
    BufferId vertexSlots; ///< by vertex of the other skins
    std::uint32_t vertexCount = 0;
};

/// Adds the buffers, after those of the surface of cuts and of the pieces of sheets.
DebrisSkins addDebrisSkins(ProgramBuilder& program, const Scene& scene, const Cut& cut,
                           const StateLayout& layout);

/// Appends the hiding of triangles, after fragments were found.
void addTriangleHiding(ProgramBuilder& program, const DebrisSkins& skins);

/// Appends the hiding of vertices to the list of skins, after the surface of cuts and the pieces of sheets.
void addVertexHiding(ProgramBuilder& program, const Cut& cut);

} // namespace sinew::sim::cutting
