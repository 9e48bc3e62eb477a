// Notation of Schwarz and Seidel, section 3: d1 and d2 are the plane's values at the critical point and at
// the corner opposite to it; each edge test shifts the projected edge to the cell corner farthest inside it.
#include "mesh/hull.hpp"

#include <algorithm>

namespace sinew::mesh {
namespace {

constexpr double hair = 1e-9; ///< [cells]; far above the rounding of coordinates below 1e5, negligible in use

} // namespace

CellOverlap::CellOverlap(const Vector3& a, const Vector3& b, const Vector3& c)
    : low_(a.cwiseMin(b).cwiseMin(c)), high_(a.cwiseMax(b).cwiseMax(c)), normal_((b - a).cross(c - a)) {
    const Vector3 corner = Vector3::Constant(-hair); // corner of the enlarged cell, relative to the cell
    const double size = 1 + 2 * hair;
    const Vector3 critical = corner + size * Vector3((normal_.array() > 0).cast<double>());
    const Vector3 opposite = corner + size * Vector3((normal_.array() <= 0).cast<double>());
    planeNear_ = normal_.dot(critical - a);
    planeFar_ = normal_.dot(opposite - a);

    const std::array<Vector3, 3> corners{a, b, c};
    std::size_t next = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double side = normal_[axis] < 0 ? -1 : 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3 &from = corners[i], &to = corners[(i + 1) % 3];
            EdgeTest& test = edges_[next++];
            test = {
                .normalU = -(to[v] - from[v]) * side, .normalV = (to[u] - from[u]) * side, .u = u, .v = v};
            test.offset = -(test.normalU * from[u] + test.normalV * from[v]) +
                          std::max(test.normalU * -hair, test.normalU * (1 + hair)) +
                          std::max(test.normalV * -hair, test.normalV * (1 + hair));
        }
    }
}

bool CellOverlap::touches(const Vector3& cell) const {
    const double plane = normal_.dot(cell);
    if ((plane + planeNear_) * (plane + planeFar_) > 0) return false;
    return std::ranges::all_of(edges_, [&](const EdgeTest& test) {
        return test.normalU * cell[test.u] + test.normalV * cell[test.v] + test.offset >= 0;
    });
}

std::array<Eigen::Array3i, 2> CellOverlap::range() const {
    return {(low_.array() - hair).floor().cast<int>(), (high_.array() + hair).floor().cast<int>()};
}

} // namespace sinew::mesh
