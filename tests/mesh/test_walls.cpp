// Tests of wall thickness: plates, shells and tubes have one; wedges and solid bodies have no thin one.
#include "mesh/walls.hpp"

#include "mesh/generate.hpp"
#include "mesh/triangle_tree.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {} // namespace

TEST(WallThickness, OfAPlateIsItsThickness) {
    EXPECT_NEAR(wallThickness(box({-0.2f, 0, -0.2f}, {0.2f, 0.006f, 0.2f}), 0.05), 0.006, 1e-8);
    EXPECT_NEAR(wallThickness(box({-0.2f, 5, -0.2f}, {0.2f, 5.006f, 0.2f}), 0.05), 0.006, 1e-6);
    EXPECT_NEAR(wallThickness(inverted(box({0, 0, 0}, {4, 0.1f, 3})), 0.05), 0.1, 1e-6)
        << "whichever way round";
    EXPECT_NEAR(wallThickness(box({0, 0, 0}, {1, 1, 1}), 0.05), 1, 1e-6);
}

TEST(WallThickness, OfAShellIsThatBetweenItsTwoSurfaces) {
    const TriangleMesh outer = box({0, 0, 0}, {1, 1, 1});
    EXPECT_NEAR(wallThickness(joined(outer, inverted(box({0.1f, 0.1f, 0.1f}, {0.9f, 0.9f, 0.9f}))), 0.05),
                0.1, 1e-6);
    const TriangleMesh ball = generate("sphere", 64);
    const double radius = double{inspect(ball).high.x};
    EXPECT_NEAR(wallThickness(joined(ball, inverted(scaled(ball, 0.9f))), 0.05), 0.1 * radius, 0.01 * radius);
    EXPECT_NEAR(wallThickness(ball, 0.05), 2 * radius, 0.1 * radius);
}

TEST(WallThickness, LooksAtTheThinnestShareOfTheSurface) {
    // A cube of 1 m beside a fin of 0.02 m, with two sides of 0.16 m^2 each of 6.33 m^2 in all.
    const TriangleMesh mesh = joined(box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {2.02f, 0.4f, 0.4f}));
    EXPECT_NEAR(wallThickness(mesh, 0.03), 0.02, 1e-6);
    EXPECT_NEAR(wallThickness(mesh, 0.08), 1, 1e-6);
}

TEST(WallThickness, IsInfiniteWhereNoSideIsOpposite) {
    const TriangleMesh tetrahedron{.name = "",
                                   .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                   .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    EXPECT_TRUE(std::isinf(wallThickness(tetrahedron, 0.05))) << "its edges are wedges, not walls";
    TriangleMesh sheet{.name = "", .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
    EXPECT_TRUE(std::isinf(wallThickness(sheet, 0.05)));
    EXPECT_TRUE(std::isinf(wallThickness(TriangleMesh{}, 0.05)));
}

TEST(TriangleTree, FindsWhatARayMeetsFirst) {
    const TriangleMesh mesh = generate("torus_knot", 24);
    std::vector<Vector3> positions;
    for (const Vec3& x : mesh.positions) positions.push_back(toVector(x));
    const TriangleTree tree(positions, mesh.triangles);
    const auto unit = [](Random& random) { return 2 * random.unit() - 1; };
    Random random(3);
    std::size_t hits = 0;
    for (int ray = 0; ray < 300; ++ray) {
        const Vector3 origin(unit(random), unit(random), unit(random));
        const Vector3 aim = positions[random.next() % positions.size()] +
                            0.02 * Vector3(unit(random), unit(random), unit(random));
        const Vector3 direction = (aim - origin).normalized();
        double nearest = INFINITY; // by definition: the ray passes the plane within three sides
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vector3 normal = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
            const double along = normal.dot(positions[a] - origin) / normal.dot(direction);
            const Vector3 point = origin + along * direction;
            const auto isWithin = [&](std::uint32_t from, std::uint32_t to) {
                return (positions[to] - positions[from]).cross(point - positions[from]).dot(normal) >= 0;
            };
            if (along >= 0 && isWithin(a, b) && isWithin(b, c) && isWithin(c, a))
                nearest = std::min(nearest, along);
        }
        const TriangleTree::Hit hit = tree.firstHit(origin, direction, noObject);
        ASSERT_EQ(std::isinf(hit.distance), std::isinf(nearest)) << ray;
        if (std::isinf(nearest)) continue;
        EXPECT_NEAR(hit.distance, nearest, 1e-9) << ray;
        EXPECT_GE(tree.firstHit(origin, direction, hit.triangle).distance, hit.distance);
        ++hits;
    }
    EXPECT_GT(hits, 50u);
}
