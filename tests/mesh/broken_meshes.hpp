// Meshes with faults, and helpers for their repair.
#pragma once

#include "mesh/repair.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sinew::mesh::test {

inline const TriangleMesh unitBox = box({0, 0, 0}, {1, 1, 1});

struct Result {
    TriangleMesh mesh;
    Repairs report;
    MeshDefects defects;
    double volume() const { return inspect(mesh).volume; }
};

inline Result repaired(const TriangleMesh& mesh, Repair how = Repair::close) {
    Result result;
    result.mesh = repair(weld(mesh, result.defects), how, result.defects, result.report);
    return result;
}

inline void expectClosed(const Result& result, double volume, double share = 1e-3) {
    EXPECT_TRUE(result.defects.isClosed()) << openText(result.report);
    EXPECT_EQ(result.defects.flippedEdges, 0u);
    EXPECT_NEAR(result.volume(), volume, std::abs(volume) * share);
    EXPECT_EQ(result.report.openEdges, 0u);
}

/// Gives every triangle its own vertices, moved by up to `noise` along each axis.
inline TriangleMesh soup(const TriangleMesh& mesh, double noise, std::uint64_t seed = 1) {
    TriangleMesh result = unwelded(mesh);
    Random random(seed);
    for (Vec3& p : result.positions)
        for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z})
            p.*axis = static_cast<float>(double{p.*axis} + noise * (2 * random.unit() - 1));
    return result;
}

/// Splits only `triangle`, at a new vertex on the edge that starts at its corner `corner`. Its neighbour
/// keeps the edge.
inline void addJunction(TriangleMesh& mesh, std::size_t triangle, std::size_t corner, double at) {
    const auto [a, b, c] =
        std::array{mesh.triangles[triangle][corner], mesh.triangles[triangle][(corner + 1) % 3],
                   mesh.triangles[triangle][(corner + 2) % 3]};
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(
        toVec3((1 - at) * toVector(mesh.positions[a]) + at * toVector(mesh.positions[b])));
    mesh.triangles[triangle] = {a, middle, c};
    mesh.triangles.push_back({middle, b, c});
}

inline TriangleMesh without(const TriangleMesh& mesh, const std::set<std::size_t>& triangles) {
    std::vector<bool> isKept(mesh.triangles.size(), true);
    for (const std::size_t triangle : triangles) isKept[triangle] = false;
    return keep(mesh, isKept);
}

} // namespace sinew::mesh::test
