// Triangles that stick out of a surface or stand within a volume and that no wall needs.
#include "mesh/repair_steps.hpp"

namespace sinew::mesh {
namespace {

/// How many edges of each triangle are open, and how many are crowded (three triangles and more).
struct EdgeCounts {
    std::vector<std::uint8_t> open, crowded;
};

EdgeCounts countEdgesOf(const TriangleMesh& mesh) {
    EdgeCounts counts{std::vector<std::uint8_t>(mesh.triangles.size()),
                      std::vector<std::uint8_t>(mesh.triangles.size())};
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        if (sides.size() == 1) ++counts.open[sides.front().triangle];
        if (sides.size() > 2)
            for (const HalfEdge& side : sides) ++counts.crowded[side.triangle];
    });
    return counts;
}

} // namespace

std::size_t removeLeftovers(TriangleMesh& mesh) {
    const EdgeCounts counts = countEdgesOf(mesh);
    const auto sticksOut = [&](std::uint32_t triangle) {
        return counts.open[triangle] == 2 && counts.crowded[triangle] == 1;
    };
    std::vector<bool> isKept(mesh.triangles.size(), true);
    std::size_t count = 0;
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        const auto loose =
            static_cast<std::size_t>(std::ranges::count_if(sides, sticksOut, &HalfEdge::triangle));
        if (sides.size() < 3 || sides.size() - loose != 2) return;
        for (const HalfEdge& side : sides)
            if (sticksOut(side.triangle)) {
                isKept[side.triangle] = false;
                ++count;
            }
    });
    if (count > 0) mesh = keep(mesh, isKept);
    return count;
}

} // namespace sinew::mesh
