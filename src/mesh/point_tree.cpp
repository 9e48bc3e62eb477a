// Ranges are split at their median along x, y and z in turn. A query clips its segment at each plane, so that
// a long segment visits only the ranges along it.
#include "mesh/point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sinew::mesh {
namespace {

constexpr std::size_t leafSize = 8;

float coordinate(sim::Vec3 point, int axis) {
    return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

} // namespace

struct PointTree::Query {
    Vector3 a, b;
    double radius = 0;
    std::vector<std::uint32_t>& found;
};

OnSegment nearestOnSegment(const Vector3& a, const Vector3& b, const Vector3& point) {
    const Vector3 along = b - a;
    const double squared = along.squaredNorm();
    const double at = squared > 0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0;
    return {(a + at * along - point).norm(), at};
}

PointTree::PointTree(const std::vector<sim::Vec3>& positions, const std::vector<std::uint32_t>& vertices) {
    points_.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) points_.push_back({positions[vertex], vertex});
    build(0, points_.size(), 0);
}

void PointTree::build(std::size_t first, std::size_t count, int axis) {
    if (count <= leafSize) return;
    const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(first);
    const std::size_t half = count / 2;
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                     begin + static_cast<std::ptrdiff_t>(count), [axis](const Point& p, const Point& q) {
                         return std::tuple{coordinate(p.position, axis), p.vertex} <
                                std::tuple{coordinate(q.position, axis), q.vertex};
                     });
    build(first, half, (axis + 1) % 3);
    build(first + half + 1, count - half - 1, (axis + 1) % 3);
}

void PointTree::findNear(const Vector3& a, const Vector3& b, double radius,
                         std::vector<std::uint32_t>& found) const {
    visit(0, points_.size(), 0, 0, 1, {a, b, radius, found});
}

/// `from` and `to` bound the part of the segment that can be near the range.
void PointTree::visit(std::size_t first, std::size_t count, int axis, double from, double to,
                      const Query& query) const {
    const auto test = [&](const Point& point) {
        if (nearestOnSegment(query.a, query.b, toVector(point.position)).distance <= query.radius)
            query.found.push_back(point.vertex);
    };
    if (count <= leafSize) {
        for (std::size_t i = first; i < first + count; ++i) test(points_[i]);
        return;
    }
    const std::size_t half = count / 2;
    test(points_[first + half]);
    const double plane = coordinate(points_[first + half].position, axis);
    const double start = query.a[axis], step = query.b[axis] - query.a[axis];
    // The parts of the segment on either side of `plane`, widened by the radius.
    double lowFrom = from, lowTo = to, highFrom = from, highTo = to;
    const double toHigh = plane + query.radius - start, toLow = plane - query.radius - start;
    if (step > 0) {
        lowTo = std::min(to, toHigh / step);
        highFrom = std::max(from, toLow / step);
    } else if (step < 0) {
        lowFrom = std::max(from, toHigh / step);
        highTo = std::min(to, toLow / step);
    } else {
        if (toHigh < 0) lowTo = -1;
        if (toLow > 0) highTo = -1;
    }
    if (lowFrom <= lowTo) visit(first, half, (axis + 1) % 3, lowFrom, lowTo, query);
    if (highFrom <= highTo)
        visit(first + half + 1, count - half - 1, (axis + 1) % 3, highFrom, highTo, query);
}

} // namespace sinew::mesh
