// Skins on the device: vertices from particles or lattice cells, then smooth normals. Recorded only when the
// scene is drawn.
#pragma once

#include "common/layout.h"
#include "sim/model/feature.hpp"

namespace sinew::sim::surface {

/// Triangles of all skins, three indices each, skin after skin.
std::vector<std::uint32_t> joinIndices(const std::vector<Skin>& skins);

/// The triangles around each of the first `vertexCount` vertices, for skin_normals.
struct VertexFans {
    BufferId fans, triangles;
};
VertexFans uploadFans(ProgramBuilder& program, const std::vector<std::uint32_t>& indices,
                      std::uint32_t vertexCount, const std::string& name);

/// Appends the skin passes, and those of whole skins if some were split, and sets the program's skin buffers;
/// nothing if the scene has no skins. Skins are consecutive in one vertex and one index buffer, in the order
/// of the scene.
void addSkins(Build& build);

/// Bound vertices, and marks of those beside a cut.
struct WholeVertices {
    BufferId hung = unbound, marks = unbound;
};

/// Appends smooth normals: of `push.count` vertices, or of so many bound vertices of whole triangles.
void addNormals(ProgramBuilder& program, BufferId indices, const VertexFans& fans,
                const layout::WholePush& push, const WholeVertices& wholes = {});

} // namespace sinew::sim::surface
