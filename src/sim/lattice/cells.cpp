// Detects collapsed cells by the areas spanned by their mean edges, like the kernel.
#include "sim/lattice/cells.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::lattice {

namespace {

using Edge = std::array<double, 3>;

double component(const Vec3& v, std::size_t axis) {
    return double{axis == 0 ? v.x : axis == 1 ? v.y : v.z};
}

// Edge k of the mean edges, times four.
Edge sumOfEdges(const Cell& cell, const std::vector<Vec3>& positions, std::size_t k) {
    Edge edge{};
    for (std::size_t corner = 0; corner < 8; ++corner)
        for (std::size_t axis = 0; axis < 3; ++axis)
            edge[axis] += (corner >> k & 1 ? 1 : -1) * component(positions[cell.corners[corner]], axis);
    return edge;
}

double areaBetween(const Edge& a, const Edge& b) {
    return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 16;
}

bool isCollapsed(const Cell& cell, const std::vector<Vec3>& positions, double spacing) {
    const Edge x = sumOfEdges(cell, positions, 0), y = sumOfEdges(cell, positions, 1),
               z = sumOfEdges(cell, positions, 2);
    const double most = std::max({areaBetween(x, y), areaBetween(y, z), areaBetween(z, x)});
    return !(most > 1e-6 * spacing * spacing);
}

// A hash in [-1, 1), equal on every machine [splitmix64].
float hashed(std::uint64_t index) {
    std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<float>((z ^ (z >> 31)) >> 40) / 8388608.0f - 1;
}

} // namespace

std::vector<Vec3> startingPositions(const Scene& scene, std::span<const float> inverseMass) {
    std::vector<Vec3> positions;
    positions.reserve(scene.particles.size());
    for (const Particle& particle : scene.particles) positions.push_back(particle.position);
    const std::vector<Vec3> given = positions;
    for (const Grid& grid : scene.grids) {
        if (!hasCellVolumes(grid)) continue;
        const float spacing = grid.restLength[0], reach = 1e-3f * spacing;
        forEachCell(grid, [&](const Cell& cell) {
            if (!isCollapsed(cell, given, double{spacing})) return;
            for (const std::uint32_t corner : cell.corners) {
                if (inverseMass[corner] == 0) continue;
                const std::uint64_t first = 3 * std::uint64_t{corner};
                positions[corner] = {given[corner].x + reach * hashed(first),
                                     given[corner].y + reach * hashed(first + 1),
                                     given[corner].z + reach * hashed(first + 2)};
            }
        });
    }
    return positions;
}

} // namespace sinew::sim::lattice
