// Compares all pairs, without a search structure.
#include "sim/cutting/cut_gaps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace sinew::test {

using Eigen::Vector3d;
using namespace sim;

namespace {

double distanceTo(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
}

} // namespace

double distanceTo(const Vector3d& p, const std::array<Vector3d, 3>& x) {
    const Vector3d n = (x[1] - x[0]).cross(x[2] - x[0]);
    bool isInside = true;
    double nearest = 1e9;
    for (std::size_t c = 0; c < 3; ++c) {
        const Vector3d &a = x[c], &b = x[(c + 1) % 3];
        nearest = std::min(nearest, distanceTo(p, a, b));
        isInside = isInside && n.dot((b - a).cross(p - a)) >= 0;
    }
    return isInside ? std::abs(n.dot(p - x[0])) / n.norm() : nearest;
}

double deepest(double voxel, const std::vector<Vector3d>& x, const std::vector<Triangle>& surface,
               const std::function<bool(std::uint32_t, const Triangle&)>& areApart) {
    double least = 1e9;
    for (const Triangle& t : surface) {
        const std::array<Vector3d, 3> corners{x[t[0]], x[t[1]], x[t[2]]};
        for (std::uint32_t i = 0; i < x.size(); ++i)
            if ((x[i] - corners[0]).norm() < 4 * voxel && areApart(i, t))
                least = std::min(least, distanceTo(x[i], corners));
    }
    return (voxel - least) / voxel;
}

// Triangles of all squares with an intact cell on one side only.
std::vector<Triangle> surfaceOf(const CutBody& body) {
    std::set<std::array<std::uint32_t, 2>> links;
    for (const test::LiveLink& link : body.links())
        links.insert({std::min(link.a, link.b), std::max(link.a, link.b)});
    const Grid& grid = body.scene().grids[0];
    const std::array<int, 3> cells{static_cast<int>(grid.nodes[0]) - 1, static_cast<int>(grid.nodes[1]) - 1,
                                   static_cast<int>(grid.nodes[2]) - 1};
    using Cell = std::array<int, 3>;
    const auto corner = [&](const Cell& cell, unsigned k) {
        return body.particleAt(static_cast<std::uint32_t>(cell[0]) + (k & 1),
                               static_cast<std::uint32_t>(cell[1]) + (k >> 1 & 1),
                               static_cast<std::uint32_t>(cell[2]) + (k >> 2));
    };
    const auto isWhole = [&](const Cell& cell) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (cell[axis] < 0 || cell[axis] >= cells[axis]) return false;
        if (grid.fill[static_cast<std::size_t>(cell[0] + cells[0] * (cell[1] + cells[1] * cell[2]))] == 0)
            return false;
        for (unsigned high = 1; high < 8; ++high)
            for (unsigned low = 0; low < high; ++low) {
                if ((low & high) != low) continue;
                const std::uint32_t a = corner(cell, low), b = corner(cell, high);
                if (!links.contains({std::min(a, b), std::max(a, b)})) return false;
            }
        return true;
    };
    std::vector<Triangle> surface;
    for (int z = -1; z < cells[2]; ++z)
        for (int y = -1; y < cells[1]; ++y)
            for (int x = -1; x < cells[0]; ++x)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const Cell below{x, y, z};
                    Cell above = below;
                    ++above[axis];
                    const bool isBelow = isWhole(below), isAbove = isWhole(above);
                    if (isBelow == isAbove) continue;
                    const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, n = 1u << axis;
                    const Cell& cell = isBelow ? below : above;
                    const unsigned first = isBelow ? n : 0;
                    const std::uint32_t a = corner(cell, first), b = corner(cell, first | u),
                                        c = corner(cell, first | u | v), d = corner(cell, first | v);
                    surface.push_back(isBelow ? Triangle{a, b, c} : Triangle{a, c, b}); // u x v is the axis
                    surface.push_back(isBelow ? Triangle{a, c, d} : Triangle{a, d, c});
                }
    return surface;
}

} // namespace sinew::test
