// A skin with the positions of its vertices, as a mesh to export or to measure.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <span>

namespace sinew::tools {

/// Joins vertices of one particle (creases and the two sides of a cloth split them for their normals), and
/// keeps only the first of two triangles back to back.
mesh::TriangleMesh skinMesh(const sim::Skin& skin, std::span<const sim::Vec3> vertices);

/// The positions of a skin's vertices for the scene's particle positions.
std::vector<sim::Vec3> skinVertices(const sim::Scene& scene, const sim::Skin& skin);

} // namespace sinew::tools
