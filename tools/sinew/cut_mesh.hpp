// What is drawn of a skin as meshes to export or to measure, piece by piece.
#pragma once

#include "app/drawn.hpp"
#include "mesh/export_gltf.hpp"

#include <optional>

namespace sinew::tools {

/// What is left of skin `index` of the scene, the pieces beside cuts and the inside, joined point by point: a
/// mesh for each piece of the body, in the order of the particles that they are named after, numbered from 1
/// where there are several. Both sides of a cut stay apart where they lie on each other, and edges with four
/// triangles are split. None where that skin is not cut.
std::optional<std::vector<mesh::TriangleMesh>> cutMeshes(const sim::Scene& scene, std::size_t index,
                                                         const app::Drawn& drawn);

/// Skin `index` as it is drawn, with normals, likewise; where nothing is cut, whole.
std::vector<mesh::ShadedMesh> shadedPieces(const sim::Scene& scene, std::size_t index,
                                           const app::Drawn& drawn);

/// All of them in one.
mesh::TriangleMesh joined(std::span<const mesh::TriangleMesh> pieces, const std::string& name);

} // namespace sinew::tools
