// Hides fragments (debris.hpp) in the skins. Skins that are clipped, and those of sheets, have separate
// pieces; the list of skins collapses the vertices of removed ones to a point. Other skins stretch over cuts;
// for them the triangles that depend on removed particles are collapsed in the index buffers.
#pragma once

#include "sim/model/state.hpp"

namespace sinew::sim::cutting {

struct Cut;

/// Triangles of skins that are not clipped, in StepProgram::skinIndices.
struct DebrisTriangles {
    BufferId triangles, holders;
    std::uint32_t count = 0;
};

/// Appends hiding to the list of skins, after the surface of cuts and the pieces of sheets.
DebrisTriangles addDebrisSkins(ProgramBuilder& program, const Scene& scene, const Cut& cut,
                               const StateLayout& layout);

/// Appends the hiding of triangles, after fragments were found.
void addTriangleHiding(ProgramBuilder& program, const DebrisTriangles& stretched);

} // namespace sinew::sim::cutting
