// Casts rays inward from points spread evenly over the surface.
#include "mesh/walls.hpp"

#include "mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::mesh {
namespace {

constexpr std::size_t samples = 2000;
constexpr double parallel = 0.7; ///< cosine

struct Corners {
    Vector3 a, b, c;
    Vector3 normal() const { return (b - a).cross(c - a); } ///< its length is twice the area
};

Corners cornersOf(const TriangleMesh& mesh, std::size_t triangle) {
    const auto [a, b, c] = mesh.triangles[triangle];
    return {toVector(mesh.positions[a]), toVector(mesh.positions[b]), toVector(mesh.positions[c])};
}

/// A point of a triangle, from two numbers in [0, 1).
Vector3 pointOf(const Corners& corners, double u, double v) {
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return corners.a + u * (corners.b - corners.a) + v * (corners.c - corners.a);
}

double fraction(double value) {
    return value - std::floor(value);
}

/// Distance through the body from a point of a triangle to the opposite side; infinite if that side is not
/// parallel.
double through(const TriangleMesh& mesh, const TriangleTree& tree, std::uint32_t triangle,
               const Vector3& point) {
    const Vector3 inward = -cornersOf(mesh, triangle).normal().normalized();
    const TriangleTree::Hit hit = tree.firstHit(point, inward, triangle);
    if (!std::isfinite(hit.distance)) return hit.distance;
    const Vector3 opposite = cornersOf(mesh, hit.triangle).normal().normalized();
    return inward.dot(opposite) > parallel ? hit.distance : std::numeric_limits<double>::infinity();
}

} // namespace

double wallThickness(const TriangleMesh& given, double share) {
    const TriangleMesh mesh = orient(given);
    std::vector<Vector3> positions;
    for (const Vec3& position : mesh.positions) positions.push_back(toVector(position));
    const TriangleTree tree(positions, mesh.triangles);
    double area = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) area += cornersOf(mesh, i).normal().norm();
    std::vector<double> found;
    double passed = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Corners corners = cornersOf(mesh, i);
        passed += corners.normal().norm();
        for (; static_cast<double>(found.size()) + 0.5 < samples * passed / area;) {
            const auto number = static_cast<double>(found.size());
            // fractions of multiples of these two numbers fill a square evenly
            const Vector3 point =
                pointOf(corners, fraction(number * 0.7548776662), fraction(number * 0.5698402910));
            found.push_back(through(mesh, tree, i, point));
        }
    }
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(found.size()));
    if (rank >= found.size()) return std::numeric_limits<double>::infinity();
    std::ranges::nth_element(found, found.begin() + static_cast<std::ptrdiff_t>(rank));
    return found[rank];
}

} // namespace sinew::mesh
