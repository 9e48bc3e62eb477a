// A hash map of the columns that contain particles, so that a scene may have any width.
#include "sim/stiffness/columns.hpp"

#include <algorithm>

namespace sinew::sim::stiffness {

using collision::Vector;

Columns::Columns(const Scene& scene, const std::vector<Vector>& places,
                 std::span<const std::uint32_t> particles, const Vector& down)
    : places_(places), frame_(collision::frameOf(down)) {
    std::vector<float> lengths;
    for (const DistanceConstraint& c : scene.distances) lengths.push_back(c.restLength);
    if (!lengths.empty()) {
        const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), middle, lengths.end());
        if (*middle > 0) width_ = double{*middle};
    }
    for (const std::uint32_t i : particles) {
        const Vector at = onMap(places[i]);
        columns_[{std::llround(at[1]), std::llround(at[2])}].push_back(i);
    }
}

Vector Columns::onMap(const Vector& place) const {
    return {collision::dot(place, frame_[0]), collision::dot(place, frame_[1]) / width_,
            collision::dot(place, frame_[2]) / width_};
}

bool Columns::meets(const std::array<Vector, 3>& corners, double x, double y, double& depth) {
    const auto& [a, b, c] = corners;
    const double area = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
    if (area == 0) return false;
    std::array<double, 3> shares;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector &p = corners[(k + 1) % 3], &q = corners[(k + 2) % 3];
        const double ex = (p[2] - q[2]) / area, ey = (q[1] - p[1]) / area;
        shares[k] = (x - p[1]) * ex + (y - p[2]) * ey;
        if (shares[k] < -0.5 * (std::abs(ex) + std::abs(ey))) return false;
        sum += shares[k] = std::max(0.0, shares[k]);
    }
    depth = (shares[0] * a[0] + shares[1] * b[0] + shares[2] * c[0]) / sum;
    return true;
}

} // namespace sinew::sim::stiffness
