// Bodies with mixed skins (whole triangles and their parts), and their drawn triangles read back.
#pragma once

#include "layout.h"
#include "mesh/generate.hpp"
#include "sim/cutting/cut_body.hpp"

#include <map>

namespace sinew::test {

using Triangle = std::array<std::uint32_t, 3>;

constexpr double reach = 3; // extent of blades, beyond all bodies [m]

/// Adds a cuttable body of 14 voxels along its longest side.
void addBody(sim::Scene& scene, const mesh::TriangleMesh& mesh);
void addOrgan(sim::Scene& scene);
sim::Scene organScene(); ///< without gravity

/// Whether the triangle is more than a point.
bool isThere(const Triangle& triangle);
std::vector<Triangle> download(const vk::BufferView& indices);
/// All drawn triangles of mixed skins, by skin.
std::vector<std::vector<Triangle>> drawnOf(const sim::Simulation& simulation);

/// Drawn triangles of the last skin, whose vertices begin at `firstVertex`, with both forms of overlap.
struct Mixed {
    Mixed(const sim::Simulation& simulation, const sim::Skin& skin, std::uint32_t firstVertex = 0);
    /// Whether all parts of a whole triangle are drawn, except those replaced by pieces.
    bool hasAllParts(std::uint32_t whole) const;
    std::size_t count() const;

    std::vector<Triangle> wholes, parts, left; ///< left: without overlap
    std::map<std::uint32_t, std::vector<std::size_t>> partsOf;
};

/// Vertices of all skins, recorded with this detail and overlap.
std::vector<sim::layout::SkinVertex> drawnBy(Runner& runner, sim::SkinDetail detail,
                                             sim::Overlap overlap = sim::Overlap::none);
Eigen::Vector3d normalOf(const sim::layout::SkinVertex& vertex);
Eigen::Vector3d placeOf(const sim::layout::SkinVertex& vertex);

} // namespace sinew::test
