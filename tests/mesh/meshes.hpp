// Meshes to test with: small closed ones, and the ways in which files break them.
#pragma once

#include "mesh/triangle_mesh.hpp"
#include "mesh/vector3.hpp"

#include <cstdint>

namespace sinew::mesh::test {

/// An axis-aligned box, 12 triangles.
TriangleMesh box(Vec3 low, Vec3 high);

TriangleMesh moved(TriangleMesh mesh, Vec3 offset);
TriangleMesh scaled(TriangleMesh mesh, float factor);
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// Every triangle gets vertices of its own, as STL stores them.
TriangleMesh unwelded(const TriangleMesh& mesh);

/// Without the triangles whose centre lies above `height`: a hole.
TriangleMesh openedAbove(const TriangleMesh& mesh, float height);

/// Every `step`th triangle turned over.
TriangleMesh withFlipped(TriangleMesh mesh, std::size_t step);

/// Winding number by the plain sum over all triangles.
double windingNumber(const TriangleMesh& mesh, const Vector3& point);

/// A generator of equal numbers in [0, 1) on every machine.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint32_t next() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<std::uint32_t>(state_ >> 33);
    }
    double unit() { return next() / 2147483648.0; }

private:
    std::uint64_t state_;
};

} // namespace sinew::mesh::test
