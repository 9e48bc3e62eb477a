// A tree of boxes over triangles that answers two questions about a point: how far the surface is, and how
// often the surface winds around it. Far clusters count as one dipole [Barill et al. 2018, first order], so
// that an open mesh of 1e5 triangles answers in microseconds.
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

    /// Copies what it needs. Indices must be in range; an empty mesh is allowed.
    TriangleTree(const std::vector<Vector3>& positions, const Triangles& triangles);

    /// Generalised winding number: 1 inside a closed surface seen counter-clockwise from outside, 0 outside
    /// it, in between near the holes of an open one. Approximate: within 0.05 of the exact
    /// sum (the worst met, in a heap of interlocking parts; 0.01 is usual).
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
        double distance = std::numeric_limits<double>::infinity(); ///< infinite where it meets none
        std::uint32_t triangle = 0;
    };
    /// `direction` has length 1. The triangle `ignored` is not met.
    Hit firstHit(const Vector3& origin, const Vector3& direction, std::uint32_t ignored) const;

    std::size_t bytes() const { return triangles_.size() * sizeof(Corners) + nodes_.size() * sizeof(Node); }

    /// The same tree for a walk without a stack: depth first, each node with the one that follows all it
    /// holds.
    struct FlatNode {
        Vector3 center, dipole;             ///< dipole: sum of area x normal
        double farSquared = 0;              ///< square of the distance from where on it counts as a dipole
        std::uint32_t next = 0;             ///< equal to the number of nodes at the end
        std::uint32_t first = 0, count = 0; ///< of a leaf, in order(); count 0 = inner node
    };
    std::vector<FlatNode> flatten() const;
    /// Which triangle stands where.
    std::vector<std::uint32_t> order() const;

private:
    struct Node {
        Eigen::AlignedBox3d box;
        Vector3 center = Vector3::Zero();   ///< mean of the triangles' centres, weighted by area
        Vector3 dipole = Vector3::Zero();   ///< sum of area x normal
        double radius = 0;                  ///< of a ball around `center` that holds the box
        std::uint32_t first = 0, count = 0; ///< triangles of a leaf; count 0 = inner node
        std::uint32_t right = 0; ///< second child of an inner node; the first one follows it directly
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
