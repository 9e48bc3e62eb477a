// Bodies with mixed skins, and what is drawn of them read back.
#pragma once

#include "layout.h"
#include "mesh/generate.hpp"
#include "sim/cutting/cut_body.hpp"

#include <map>

namespace sinew::test {

using Triangle = std::array<std::uint32_t, 3>;

constexpr double reach = 3; // of blades [m]: beyond every body

/// A body of 14 voxels that may be cut.
void addBody(sim::Scene& scene, const mesh::TriangleMesh& mesh);
void addOrgan(sim::Scene& scene);
sim::Scene organScene(); ///< without gravity

/// Not shrunk to a point.
bool isThere(const Triangle& triangle);
std::vector<Triangle> download(const vk::BufferView& indices);
/// Every triangle that is drawn of mixed skins, by skin.
std::vector<std::vector<Triangle>> drawnOf(const sim::Simulation& simulation);

/// What is drawn of the last skin, whose vertices begin with `firstVertex`, with either form of overlap.
struct Mixed {
    Mixed(const sim::Simulation& simulation, const sim::Skin& skin, std::uint32_t firstVertex = 0);
    /// Those of a whole triangle that no pieces stand for.
    bool hasAllParts(std::uint32_t whole) const;
    std::size_t count() const;

    std::vector<Triangle> wholes, parts, left; ///< left: as they are without overlap
    std::map<std::uint32_t, std::vector<std::size_t>> partsOf;
};

/// Vertices of all skins as they are recorded so.
std::vector<sim::layout::SkinVertex> drawnBy(Runner& runner, sim::SkinDetail detail,
                                             sim::Overlap overlap = sim::Overlap::none);
Eigen::Vector3d normalOf(const sim::layout::SkinVertex& vertex);
Eigen::Vector3d placeOf(const sim::layout::SkinVertex& vertex);

} // namespace sinew::test
