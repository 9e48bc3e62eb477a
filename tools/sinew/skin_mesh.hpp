// A skin with the positions of its vertices as a mesh to export or to measure.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <span>

namespace sinew::tools {

/// Vertices that hang on one particle are one again (creases and the two sides of a cloth split them for the
/// sake of their normals), and of two triangles back to back the first stays.
mesh::TriangleMesh skinMesh(const sim::Skin& skin, std::span<const sim::Vec3> vertices);

/// Where a skin's vertices are when every particle is where the scene has it.
std::vector<sim::Vec3> skinVertices(const sim::Scene& scene, const sim::Skin& skin);

} // namespace sinew::tools
