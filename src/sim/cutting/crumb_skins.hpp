// Hides fragments (crumbs.hpp) in the skins. Skins that are clipped, and those of sheets, have separate
// pieces; the list of skins collapses the vertices of removed ones to a point. Other skins stretch over cuts;
// for them the triangles that depend on removed particles are collapsed in the index buffers.
#pragma once

#include "sim/compile.hpp"

#include <vector>

namespace sinew::sim::cutting {

struct Cut;

/// Triangles of skins that are not clipped, in the index buffer that draws them.
struct CrumbTriangles {
    BufferId triangles, holders, indices;
    std::uint32_t count = 0;
};
using CrumbSkins = std::vector<CrumbTriangles>;

/// Appends hiding to the list of skins, after the surface of cuts and the pieces of sheets.
CrumbSkins addCrumbSkins(ProgramBuilder& program, const Scene& scene, const Cut& cut,
                         const StateLayout& layout);

/// Appends the hiding of triangles, after fragments were found.
void addTriangleHiding(ProgramBuilder& program, const CrumbSkins& skins);

} // namespace sinew::sim::cutting
