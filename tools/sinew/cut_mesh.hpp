// Drawn skins as meshes to export or to measure, one per piece.
#pragma once

#include "app/drawn.hpp"
#include "mesh/export_gltf.hpp"

#include <optional>

namespace sinew::tools {

/// The rest of skin `index`, with cut surfaces, joined by points: one mesh per piece of the body, ordered by
/// the particles that the pieces are named after, and numbered from 1 if there are several. The two sides of
/// a cut stay apart even at the same place; edges with four triangles are split. Empty if that skin is not
/// cut.
std::optional<std::vector<mesh::TriangleMesh>> cutMeshes(const sim::Scene& scene, std::size_t index,
                                                         const app::Drawn& drawn);

/// Skin `index` as drawn, with normals, one mesh per piece; a single mesh if nothing is cut.
std::vector<mesh::ShadedMesh> shadedPieces(const sim::Scene& scene, std::size_t index,
                                           const app::Drawn& drawn);

/// Joins all pieces to one mesh.
mesh::TriangleMesh joined(std::span<const mesh::TriangleMesh> pieces, const std::string& name);

} // namespace sinew::tools
