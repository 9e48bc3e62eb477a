// Bodies with split skins, and what is drawn of them read back.
#pragma once

#include "common/layout.h"
#include "mesh/generate.hpp"
#include "sim/cutting/cut_body.hpp"

namespace sinew::test {

using Triangle = std::array<std::uint32_t, 3>;

constexpr double reach = 3; // extent of blades, beyond all bodies [m]

/// Adds a cuttable body of 14 voxels along its longest side.
void addBody(sim::Scene& scene, const mesh::TriangleMesh& mesh);
void addOrgan(sim::Scene& scene);
sim::Scene organScene(); ///< without gravity

/// Whether the triangle is more than a point.
bool isThere(const Triangle& triangle);
/// The triangles that are drawn of all skins, without those that shrank to a point.
std::vector<Triangle> drawnOf(const sim::Simulation& simulation);

/// Vertices of all skins, recorded with this detail.
std::vector<sim::layout::SkinVertex> drawnBy(Runner& runner, sim::SkinDetail detail);
Eigen::Vector3d normalOf(const sim::layout::SkinVertex& vertex);
Eigen::Vector3d placeOf(const sim::layout::SkinVertex& vertex);

} // namespace sinew::test
