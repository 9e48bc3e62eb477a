// A tree of boxes over triangles that computes the distance of a point from the surface, and the winding
// number of the surface around the point. Far clusters count as one dipole [Barill et al. 2018, first order],
// so that a query in an open mesh of 1e5 triangles takes microseconds.
#pragma once

#include "mesh/vector3.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace sinew::mesh {

class TriangleTree {
public:
    using Triangles = std::vector<std::array<std::uint32_t, 3>>;

    /// Copies the corners. Indices must be in range; an empty mesh is allowed.
    TriangleTree(const std::vector<Vector3>& positions, const Triangles& triangles);

    /// Generalised winding number: 1 inside a closed surface that is counter-clockwise seen from outside, 0
    /// outside it, in between near the holes of an open one. Approximate: within 0.05 of the exact sum (the
    /// worst case found, in a heap of interlocking parts; 0.01 is usual).
    double windingNumber(const Vector3& point) const;

    /// The nearest triangle.
    struct Nearest {
        double distance = std::numeric_limits<double>::infinity(); ///< infinite for an empty mesh
        std::uint32_t triangle = 0;
    };
    Nearest nearest(const Vector3& point) const;
    double distance(const Vector3& point) const { return nearest(point).distance; }

    /// The first point at which a ray meets a triangle.
    struct Hit {
        double distance = std::numeric_limits<double>::infinity(); ///< infinite if it meets none
        std::uint32_t triangle = 0;
    };
    /// `direction` has length 1. The triangle `ignored` is skipped.
    Hit firstHit(const Vector3& origin, const Vector3& direction, std::uint32_t ignored) const;

    std::size_t bytes() const { return triangles_.size() * sizeof(Corners) + nodes_.size() * sizeof(Node); }

    /// A node of the same tree for a traversal without a stack: depth first, with the next node after its
    /// subtree.
    struct FlatNode {
        Vector3 center, dipole;             ///< dipole: sum of area x normal
        double farSquared = 0;              ///< square of the distance beyond which it counts as a dipole
        std::uint32_t next = 0;             ///< equal to the number of nodes at the end
        std::uint32_t first = 0, count = 0; ///< triangles of a leaf, in order(); count 0 = inner node
    };
    std::vector<FlatNode> flatten() const;
    /// Indices of the triangles in the order of the leaves.
    std::vector<std::uint32_t> order() const;

private:
    struct Node {
        Eigen::AlignedBox3d box;
        Vector3 center = Vector3::Zero();   ///< mean of the triangles' centres, weighted by area
        Vector3 dipole = Vector3::Zero();   ///< sum of area x normal
        double radius = 0;                  ///< radius of a ball around `center` that contains the box
        std::uint32_t first = 0, count = 0; ///< triangles of a leaf; count 0 = inner node
        std::uint32_t right = 0;            ///< second child of an inner node; the first is the next node
    };
    struct Corners {
        Vector3 a, b, c;
        std::uint32_t triangle = 0;
    };

    void build(std::uint32_t first, std::uint32_t count);
    Node summarise(std::uint32_t first, std::uint32_t count) const;

    std::vector<Corners> triangles_;
    std::vector<Node> nodes_; ///< depth first, root first
};

/// Winding number of one triangle around a point: its solid angle over 4 pi.
double windingOfTriangle(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point);

/// The point of a triangle nearest to `point`. Degenerate triangles count as their edges.
Vector3 nearestPoint(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point);

} // namespace sinew::mesh
