// A balanced tree of points that finds all points within a distance of a segment.
#pragma once

#include "mesh/vector3.hpp"

#include <cstdint>
#include <vector>

namespace sinew::mesh {

class PointTree {
public:
    /// Copies the positions of `vertices`.
    PointTree(const std::vector<sim::Vec3>& positions, const std::vector<std::uint32_t>& vertices);

    /// Appends to `found` the vertices whose distance to the segment from `a` to `b` is at most `radius`, in
    /// the order of the tree, which is the same on every run. `a` may equal `b`.
    void findNear(const Vector3& a, const Vector3& b, double radius, std::vector<std::uint32_t>& found) const;

private:
    struct Point {
        sim::Vec3 position;
        std::uint32_t vertex = 0;
    };
    struct Query;

    void build(std::size_t first, std::size_t count, int axis);
    void visit(std::size_t first, std::size_t count, int axis, double from, double to,
               const Query& query) const;

    std::vector<Point> points_; ///< the median of a range is in its middle
};

/// Distance from `point` to the segment from `a` to `b`, and the parameter of the nearest point: 0 at `a`, 1
/// at `b`.
struct OnSegment {
    double distance = 0, at = 0;
};
OnSegment nearestOnSegment(const Vector3& a, const Vector3& b, const Vector3& point);

} // namespace sinew::mesh
