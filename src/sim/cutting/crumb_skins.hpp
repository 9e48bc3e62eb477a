// What is drawn of crumbs (crumbs.hpp): nothing. Skins that are clipped, and those of sheets, fall into
// pieces, of which the vertices shrink to a point when somebody draws. Others stretch over cuts, so of those
// the triangles shrink that hang on what was removed, in the indices that are drawn.
#pragma once

#include "sim/compile.hpp"

#include <vector>

namespace sinew::sim::cutting {

struct Cut;

/// Triangles of skins that are not clipped, in an index buffer that they are drawn from.
struct CrumbTriangles {
    BufferId triangles, holders, indices;
    std::uint32_t count = 0;
};
using CrumbSkins = std::vector<CrumbTriangles>;

/// After the surface of cuts and the pieces of sheets: adds what hides those to the list of skins.
CrumbSkins addCrumbSkins(ProgramBuilder& program, const Scene& scene, const Cut& cut,
                         const StateLayout& layout);

/// After crumbs were found.
void addTriangleHiding(ProgramBuilder& program, const CrumbSkins& skins);

} // namespace sinew::sim::cutting
