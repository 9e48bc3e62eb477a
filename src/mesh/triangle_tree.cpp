// The tree is built by median splits along the longest side of the box of the triangles' centres. Solid
// angles: van Oosterom and Strackee (1983). Nearest point: by Voronoi regions of the triangle, after Ericson,
// Real-Time Collision Detection, 5.1.5.
#include "mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sinew::mesh {
namespace {

constexpr std::uint32_t leafSize = 8;
/// Distance in radii beyond which a cluster counts as a dipole: the error of its contribution is then below
/// (1/farFactor)^2.
constexpr double farFactor = 2;
constexpr int deepestStack = 64; ///< median splits of 2^32 triangles are at most 32 deep

/// Distance along a ray to a box: 0 from inside, infinite if the ray misses it.
double distanceToBox(const Eigen::AlignedBox3d& box, const Vector3& origin, const Vector3& direction) {
    double begin = 0, end = std::numeric_limits<double>::infinity();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis])
                return std::numeric_limits<double>::infinity();
            continue;
        }
        const double low = (box.min()[axis] - origin[axis]) / direction[axis],
                     high = (box.max()[axis] - origin[axis]) / direction[axis];
        begin = std::max(begin, std::min(low, high));
        end = std::min(end, std::max(low, high));
    }
    return begin <= end ? begin : std::numeric_limits<double>::infinity();
}

/// Distance along a ray to a triangle, after Moeller and Trumbore (1997); infinite if the ray misses it.
double distanceAlong(const Vector3& origin, const Vector3& direction, const Vector3& a, const Vector3& b,
                     const Vector3& c) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const Vector3 ab = b - a, ac = c - a, across = direction.cross(ac), offset = origin - a;
    const double determinant = ab.dot(across);
    if (determinant == 0) return none;
    const Vector3 turned = offset.cross(ab);
    const double u = offset.dot(across) / determinant, v = direction.dot(turned) / determinant,
                 distance = ac.dot(turned) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && distance >= 0 ? distance : none;
}

} // namespace

double windingOfTriangle(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point) {
    const Vector3 x = a - point, y = b - point, z = c - point;
    const double lengthX = x.norm(), lengthY = y.norm(), lengthZ = z.norm();
    const double numerator = x.dot(y.cross(z));
    const double denominator =
        lengthX * lengthY * lengthZ + x.dot(y) * lengthZ + y.dot(z) * lengthX + z.dot(x) * lengthY;
    if (numerator == 0) return 0; // in the plane: no solid angle, or a half turn that belongs to neither side
    return std::atan2(numerator, denominator) / (2 * std::numbers::pi);
}

Vector3 nearestPoint(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point) {
    const Vector3 ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double areaC = d1 * d4 - d3 * d2, areaB = d5 * d2 - d1 * d6, areaA = d3 * d6 - d5 * d4;
    if (areaC <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
    if (areaB <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
    if (areaA <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    return a + (ab * areaB + ac * areaC) / (areaA + areaB + areaC);
}

TriangleTree::TriangleTree(const std::vector<Vector3>& positions, const Triangles& triangles) {
    triangles_.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles)
        triangles_.push_back(
            {positions[a], positions[b], positions[c], static_cast<std::uint32_t>(triangles_.size())});
    nodes_.reserve(triangles.size() / 2 + 1);
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

TriangleTree::Node TriangleTree::summarise(std::uint32_t first, std::uint32_t count) const {
    Node node{.first = first, .count = count};
    double area = 0;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const auto& [a, b, c, triangle] = triangles_[i];
        node.box.extend(a).extend(b).extend(c);
        const Vector3 normal = (b - a).cross(c - a) / 2;
        node.dipole += normal;
        node.center += normal.norm() * (a + b + c) / 3;
        area += normal.norm();
    }
    node.center = area > 0 ? Vector3(node.center / area) : Vector3(node.box.center());
    for (std::uint32_t i = first; i < first + count; ++i)
        for (const Vector3& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c})
            node.radius = std::max(node.radius, (corner - node.center).norm());
    return node;
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t index = nodes_.size();
    nodes_.push_back(summarise(first, count));
    if (count <= leafSize) return;
    Eigen::AlignedBox3d centers;
    for (std::uint32_t i = first; i < first + count; ++i)
        centers.extend(Vector3(triangles_[i].a + triangles_[i].b + triangles_[i].c));
    Eigen::Index axis = 0;
    centers.sizes().maxCoeff(&axis);
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [axis](const Corners& p, const Corners& q) {
        return p.a[axis] + p.b[axis] + p.c[axis] < q.a[axis] + q.b[axis] + q.c[axis];
    });
    nodes_[index].count = 0;
    build(first, count / 2);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    build(first + count / 2, count - count / 2);
}

double TriangleTree::windingNumber(const Vector3& point) const {
    double winding = 0;
    std::array<std::uint32_t, deepestStack> stack{};
    for (int size = nodes_.empty() ? 0 : 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        const Vector3 offset = node.center - point;
        const double distanceSquared = offset.squaredNorm();
        if (distanceSquared > farFactor * farFactor * node.radius * node.radius) {
            winding += node.dipole.dot(offset) /
                       (distanceSquared * std::sqrt(distanceSquared) * 4 * std::numbers::pi);
        } else if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                winding += windingOfTriangle(triangles_[i].a, triangles_[i].b, triangles_[i].c, point);
        } else {
            stack[size++] = node.right;
            stack[size++] = index + 1;
        }
    }
    return winding;
}

TriangleTree::Nearest TriangleTree::nearest(const Vector3& point) const {
    Nearest found;
    double best = std::numeric_limits<double>::infinity(); // squared
    std::array<std::uint32_t, deepestStack> stack{};
    for (int size = nodes_.empty() ? 0 : 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        if (node.box.squaredExteriorDistance(point) >= best) continue;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto& [a, b, c, triangle] = triangles_[i];
            const double squared = (nearestPoint(a, b, c, point) - point).squaredNorm();
            if (!(squared < best)) continue;
            best = squared;
            found.triangle = triangle;
        }
        if (node.count > 0) continue;
        const bool isRightNearer = nodes_[node.right].box.squaredExteriorDistance(point) <
                                   nodes_[index + 1].box.squaredExteriorDistance(point);
        stack[size++] = isRightNearer ? index + 1 : node.right; // the nearer child is visited first
        stack[size++] = isRightNearer ? node.right : index + 1;
    }
    found.distance = std::sqrt(best);
    return found;
}

TriangleTree::Hit TriangleTree::firstHit(const Vector3& origin, const Vector3& direction,
                                         std::uint32_t ignored) const {
    Hit hit;
    std::array<std::uint32_t, deepestStack> stack{};
    for (int size = nodes_.empty() ? 0 : 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        if (distanceToBox(node.box, origin, direction) >= hit.distance) continue;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto& [a, b, c, triangle] = triangles_[i];
            if (triangle == ignored) continue;
            const double distance = distanceAlong(origin, direction, a, b, c);
            if (distance < hit.distance) hit = {distance, triangle};
        }
        if (node.count > 0) continue;
        stack[size++] = node.right;
        stack[size++] = index + 1;
    }
    return hit;
}

std::vector<TriangleTree::FlatNode> TriangleTree::flatten() const {
    std::vector<FlatNode> flat(nodes_.size());
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        const Node& node = nodes_[i];
        const auto following = static_cast<std::uint32_t>(i + 1);
        flat[i] = {.center = node.center,
                   .dipole = node.dipole,
                   .farSquared = farFactor * farFactor * node.radius * node.radius,
                   .next = node.count > 0 ? following : flat[node.right].next,
                   .first = node.first,
                   .count = node.count};
    }
    return flat;
}

std::vector<std::uint32_t> TriangleTree::order() const {
    std::vector<std::uint32_t> order;
    order.reserve(triangles_.size());
    for (const Corners& corners : triangles_) order.push_back(corners.triangle);
    return order;
}

} // namespace sinew::mesh
