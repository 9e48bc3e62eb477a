// Tests of generated shapes: they are closed, deterministic and of the promised size.
#include "mesh/generate.hpp"

#include "meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

using namespace sinew::mesh;

namespace {

long eulerNumber(const TriangleMesh& mesh) {
    return static_cast<long>(mesh.positions.size()) - static_cast<long>(mesh.triangles.size()) / 2;
}

} // namespace

TEST(Generate, MakesClosedManifoldsOfTheRightGenusAtAnyResolution) {
    const std::map<std::string_view, long> eulerNumbers{
        {"organ", 2}, {"sphere", 2}, {"torus_knot", 0}, {"slab_with_hole", 0}, {"tube", 0}};
    for (const auto& [name, euler] : eulerNumbers)
        for (const std::uint32_t resolution : {8, 9, 11, 14, 19, 27, 40, 64}) {
            const TriangleMesh mesh = generate(name, resolution);
            const MeshReport report = inspect(mesh);
            EXPECT_TRUE(report.defects.isClosed()) << name << " " << resolution;
            EXPECT_EQ(report.defects.flippedEdges, 0u) << name << " " << resolution;
            EXPECT_EQ(report.defects.degenerateTriangles, 0u) << name << " " << resolution;
            EXPECT_EQ(eulerNumber(mesh), euler) << name << " " << resolution;
            EXPECT_GT(report.volume, 0) << name << " " << resolution;
        }
}

TEST(Generate, MakesClothOpen) {
    const MeshReport report = inspect(generate("cloth", 20));
    EXPECT_EQ(report.defects.boundaryEdges, 80u);
    EXPECT_NEAR(report.area, 1, 1e-6);
}

TEST(Generate, ConvergesToASphere) {
    const double exact = 4 * std::numbers::pi / 3 * std::pow(0.15, 3);
    const double coarse = exact - inspect(generate("sphere", 32)).volume;
    const double fine = exact - inspect(generate("sphere", 64)).volume;
    EXPECT_NEAR(coarse / fine, 4, 0.1);
    EXPECT_LT(fine / exact, 2e-3);
}

// Pappus's theorem: the profile is two half circles and the rectangle between them, with its centre 0.046 m
// from the axis.
TEST(Generate, ConvergesToATube) {
    const double rim = 0.014, profile = std::numbers::pi * rim * rim + 2 * rim * (0.3 - 2 * rim);
    const double exact = 2 * std::numbers::pi * 0.046 * profile;
    const double coarse = exact - inspect(generate("tube", 64)).volume;
    const double fine = exact - inspect(generate("tube", 128)).volume;
    EXPECT_NEAR(coarse / fine, 4, 0.4);
    EXPECT_LT(fine / exact, 2e-3);
}

TEST(Generate, MakesTrianglesOfAboutOneSize) {
    for (const Shape& shape : shapes()) {
        const TriangleMesh mesh = generate(shape.name, 48);
        double shortest = 1, longest = 0;
        for (const auto& triangle : mesh.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const double length =
                    (toVector(mesh.positions[triangle[i]]) - toVector(mesh.positions[triangle[(i + 1) % 3]]))
                        .norm();
                shortest = std::min(shortest, length);
                longest = std::max(longest, length);
            }
        EXPECT_LT(longest / shortest, 12) << shape.name;
    }
}

TEST(Generate, FitsTheSizesItsDescriptionsName) {
    for (const Shape& shape : shapes()) {
        const MeshReport report = inspect(generate(shape.name, 64));
        const double longest =
            std::max({double{report.high.x - report.low.x}, double{report.high.y - report.low.y},
                      double{report.high.z - report.low.z}});
        EXPECT_NEAR(longest, shape.name == "cloth" ? 1 : 0.3, 0.025) << shape.name;
    }
}

TEST(Generate, MakesTheSameBytesEveryTime) {
    for (const Shape& shape : shapes()) {
        const TriangleMesh a = generate(shape.name, 24), b = generate(shape.name, 24);
        EXPECT_EQ(a.triangles, b.triangles);
        ASSERT_EQ(a.positions.size(), b.positions.size());
        for (std::size_t i = 0; i < a.positions.size(); ++i)
            EXPECT_EQ((toVector(a.positions[i]) - toVector(b.positions[i])).norm(), 0);
        EXPECT_EQ(a.name, shape.name);
    }
}

TEST(Generate, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW(generate("teapot", 32), std::invalid_argument);
    EXPECT_THROW(generate("organ", 7), std::invalid_argument);
    EXPECT_THROW(generate("organ", 257), std::invalid_argument);
}
