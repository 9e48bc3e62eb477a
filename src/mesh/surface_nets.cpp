// Surface nets: one vertex in each cell whose corners differ in sign, one quad around each grid edge whose
// ends differ in sign.
#include "mesh/surface_nets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sinew::mesh {
namespace {

using Index3 = std::array<std::uint32_t, 3>;

constexpr int smoothingRounds = 4;
constexpr std::uint32_t noVertex = std::numeric_limits<std::uint32_t>::max();

/// Values of the function on the corners of a grid of cells.
struct Samples {
    Vector3 origin;
    double spacing = 0;
    Index3 corners{};
    std::vector<double> values;

    std::size_t index(Index3 corner) const {
        return corner[0] + corners[0] * (corner[1] + std::size_t{corners[1]} * corner[2]);
    }
    Vector3 position(Index3 corner) const {
        return origin + spacing * Vector3(corner[0], corner[1], corner[2]);
    }
};

template <typename Visit> void forEach(Index3 count, const Visit& visit) {
    for (std::uint32_t k = 0; k < count[2]; ++k)
        for (std::uint32_t j = 0; j < count[1]; ++j)
            for (std::uint32_t i = 0; i < count[0]; ++i) visit(Index3{i, j, k});
}

Samples sample(const ImplicitFunction& function, const Eigen::AlignedBox3d& box, double spacing) {
    Samples samples{.origin = box.min(), .spacing = spacing};
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        samples.corners[axis] = static_cast<std::uint32_t>(std::ceil(box.sizes()[axis] / spacing)) + 1;
    samples.values.reserve(std::size_t{samples.corners[0]} * samples.corners[1] * samples.corners[2]);
    forEach(samples.corners,
            [&](Index3 corner) { samples.values.push_back(function(samples.position(corner))); });
    return samples;
}

Index3 cornerOf(Index3 cell, unsigned corner) {
    return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
}

/// Corners of one cell at which the surface touches itself: a face whose diagonals differ, or a cell of which
/// only two opposite corners differ from the rest. Returns the outside corners among them, as bits.
unsigned touchingCorners(unsigned inside) {
    constexpr std::array<unsigned, 6> lowCorner{0, 1, 0, 2, 0, 4};
    constexpr std::array<std::array<unsigned, 2>, 6> faceAxes{
        {{2, 4}, {2, 4}, {1, 4}, {1, 4}, {1, 2}, {1, 2}}};
    for (std::size_t face = 0; face < 6; ++face) {
        const auto [u, v] = faceAxes[face];
        const unsigned corner = lowCorner[face];
        const unsigned diagonal = 1u << corner | 1u << (corner | u | v);
        const unsigned other = 1u << (corner | u) | 1u << (corner | v);
        if ((inside & (diagonal | other)) == diagonal) return other;
        if ((inside & (diagonal | other)) == other) return diagonal;
    }
    for (unsigned corner = 0; corner < 4; ++corner) {
        const unsigned opposite = 1u << corner | 1u << (7 - corner);
        if (inside == opposite || inside == (~opposite & 0xffu)) return ~inside & 0xffu;
    }
    return 0;
}

/// Fills corners until the surface touches itself nowhere: only then is the net a manifold. Filling alone
/// terminates, and the vertices are moved back onto the function's surface later.
void separate(Samples& samples) {
    const Index3 cells{samples.corners[0] - 1, samples.corners[1] - 1, samples.corners[2] - 1};
    for (bool isChanged = true; isChanged;) {
        isChanged = false;
        forEach(cells, [&](Index3 cell) {
            unsigned inside = 0;
            for (unsigned corner = 0; corner < 8; ++corner)
                inside |= samples.values[samples.index(cornerOf(cell, corner))] < 0 ? 1u << corner : 0;
            const unsigned candidates = touchingCorners(inside);
            if (candidates == 0) return;
            double* nearest = nullptr;
            for (unsigned corner = 0; corner < 8; ++corner)
                if (double& value = samples.values[samples.index(cornerOf(cell, corner))];
                    (candidates >> corner & 1) != 0 && (nearest == nullptr || value < *nearest))
                    nearest = &value;
            *nearest = -1e-3 * samples.spacing;
            isChanged = true;
        });
    }
}

/// Mean of the points where the function changes sign on the cell's edges. Returns their number.
int meanCrossing(const Samples& samples, Index3 cell, Vector3& mean) {
    int count = 0;
    mean = Vector3::Zero();
    for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned axis = 0; axis < 3; ++axis) {
            if ((corner >> axis & 1) != 0) continue;
            const Index3 from = cornerOf(cell, corner), to = cornerOf(cell, corner | 1u << axis);
            const double a = samples.values[samples.index(from)], b = samples.values[samples.index(to)];
            if ((a < 0) == (b < 0)) continue;
            mean += samples.position(from) + a / (a - b) * (samples.position(to) - samples.position(from));
            ++count;
        }
    mean /= std::max(count, 1);
    return count;
}

struct Net {
    std::vector<Vector3> positions;
    std::vector<std::array<std::uint32_t, 4>> quads; ///< counter-clockwise seen from outside
};

Net makeNet(const Samples& samples) {
    Net net;
    std::vector<std::uint32_t> vertices(samples.values.size(), noVertex); // vertex of the cell above a corner
    forEach({samples.corners[0] - 1, samples.corners[1] - 1, samples.corners[2] - 1}, [&](Index3 cell) {
        Vector3 mean;
        if (meanCrossing(samples, cell, mean) == 0) return;
        vertices[samples.index(cell)] = static_cast<std::uint32_t>(net.positions.size());
        net.positions.push_back(mean);
    });
    forEach(samples.corners, [&](Index3 corner) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (corner[axis] + 1 == samples.corners[axis] || corner[u] == 0 || corner[v] == 0) continue;
            Index3 next = corner;
            ++next[axis];
            const bool isInside = samples.values[samples.index(corner)] < 0;
            if (isInside == (samples.values[samples.index(next)] < 0)) continue;
            const auto vertexAt = [&](std::uint32_t du, std::uint32_t dv) {
                Index3 cell = corner;
                cell[u] -= du, cell[v] -= dv;
                return vertices[samples.index(cell)];
            };
            std::array<std::uint32_t, 4> quad{vertexAt(1, 1), vertexAt(0, 1), vertexAt(0, 0), vertexAt(1, 0)};
            if (!isInside) std::swap(quad[1], quad[3]);
            net.quads.push_back(quad);
        }
    });
    return net;
}

Vector3 gradient(const ImplicitFunction& function, const Vector3& x, double step) {
    Vector3 slope;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Vector3 offset = step * Vector3::Unit(axis);
        slope[axis] = (function(x + offset) - function(x - offset)) / (2 * step);
    }
    return slope;
}

/// A Newton step onto the zero set, no longer than half a cell.
Vector3 projected(const ImplicitFunction& function, const Vector3& x, double spacing) {
    const Vector3 slope = gradient(function, x, 1e-3 * spacing);
    const Vector3 move = -function(x) * slope / std::max(slope.squaredNorm(), 1e-12);
    return x + move * std::min(1.0, spacing / 2 / std::max(move.norm(), 1e-300));
}

/// Moves vertices half way to the mean of their neighbours and back onto the surface.
void smooth(Net& net, const ImplicitFunction& function, double spacing) {
    for (int round = 0; round < smoothingRounds; ++round) {
        std::vector<Vector3> sum(net.positions.size(), Vector3::Zero());
        std::vector<int> count(net.positions.size(), 0);
        for (const auto& quad : net.quads)
            for (std::size_t corner = 0; corner < 4; ++corner) {
                const std::uint32_t next = quad[(corner + 1) % 4];
                sum[quad[corner]] += net.positions[next];
                sum[next] += net.positions[quad[corner]];
                ++count[quad[corner]], ++count[next];
            }
        for (std::size_t i = 0; i < net.positions.size(); ++i) {
            const Vector3 moved = (net.positions[i] + sum[i] / count[i]) / 2;
            net.positions[i] = projected(function, projected(function, moved, spacing), spacing);
        }
    }
}

} // namespace

TriangleMesh isosurface(const ImplicitFunction& function, const Eigen::AlignedBox3d& box, double spacing) {
    Samples samples = sample(function, box, spacing);
    separate(samples);
    Net net = makeNet(samples);
    smooth(net, function, spacing);
    TriangleMesh mesh;
    for (const Vector3& position : net.positions) mesh.positions.push_back(toVec3(position));
    for (const auto& [a, b, c, d] : net.quads) { // along the shorter diagonal
        const bool isFirst = (net.positions[a] - net.positions[c]).squaredNorm() <=
                             (net.positions[b] - net.positions[d]).squaredNorm();
        mesh.triangles.push_back(isFirst ? std::array{a, b, c} : std::array{a, b, d});
        mesh.triangles.push_back(isFirst ? std::array{a, c, d} : std::array{b, c, d});
    }
    return mesh;
}

} // namespace sinew::mesh
