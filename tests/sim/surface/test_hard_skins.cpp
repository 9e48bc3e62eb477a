// Tests of the two skins that are hardest to cut, with planes in general position: a knot four cells thick
// with close strands, and an organ with notches. All invariants are checked after each cut.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/cutting/stroke_check.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutPlane;
using test::StrokeCheck;
using test::StrokeResult;
using test::sweepOf;
using Part = test::ClosedSurface::Part;

namespace {

constexpr int planes = 10;

struct Shape {
    const char* name;
    std::uint32_t detail, resolution;
    std::size_t holes = 0; ///< if larger than 0, one of so many triangles is missing
};
constexpr Shape shapes[] = {{"torus_knot", 48, 18}, {"organ", 32, 14}};

Scene sceneOf(const Shape& shape) {
    Scene scene{.name = shape.name, .gravity = {0, 0, 0}};
    mesh::MeshBody body{.name = shape.name, .youngModulus = 1e5f, .isCuttable = true};
    body.voxels.resolution = shape.resolution;
    mesh::TriangleMesh mesh = mesh::generate(shape.name, shape.detail);
    for (std::size_t t = mesh.triangles.size(); shape.holes > 0 && t-- > 0;)
        if (t % shape.holes == 0)
            mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    mesh::addMesh(scene, mesh, body);
    return scene;
}

// Random planes of any direction, within half of the body's size around its middle.
class RandomPlanes {
public:
    explicit RandomPlanes(const Shape& shape) {
        for (const Vec3& x : mesh::generate(shape.name, shape.detail).positions)
            box_.extend(test::toVector(x));
    }
    CutPlane next() {
        const auto between = [&] { return static_cast<double>(numbers_()) / 2147483648.0 - 1; };
        const auto inCube = [&] {
            const double x = between(), y = between(), z = between();
            return Vector3d(x, y, z);
        };
        const Vector3d middle = box_.center() + box_.sizes().cwiseProduct(inCube()) / 4;
        Vector3d normal = inCube();
        while (normal.norm() > 1 || normal.norm() < 0.1) normal = inCube();
        return {middle, normal.normalized()};
    }

private:
    Eigen::AlignedBox3d box_;
    std::mt19937 numbers_{20251};
};

struct Cuts {
    double area = 0, section = 0, rim = 0; ///< in cells
    double error() const { return area / section - 1; }
    double errorAtRim() const { return (area - section) / rim; }
};

// Areas of one plane's cut through the uncut body.
Cuts cutOnce(StrokeCheck& check, const ClosedSurface& uncut, const CutPlane& plane, const std::string& what) {
    check.body().runner().reset();
    check.run(1);
    StrokeResult result = check.stroke(sweepOf(plane, 1, 3).blade(), what);
    check.checkSurface(result, what);
    const double spacing = check.body().spacing();
    const auto [section, rim] = uncut.section(plane);
    const Cuts cuts{ClosedSurface(check.body()).area(Part::inside) / 2 / (spacing * spacing),
                    section / (spacing * spacing), rim / spacing};
    std::printf("%-24s %5zu live links, %2u pieces, %2zu crowded edges, volume %+.1e, section %5.1f cells^2, "
                "area %+.2f %%, %+.3f cells along the rim\n",
                what.c_str(), result.live, result.status.pieces, result.crowdedEdges, result.volumeError,
                cuts.section, 100 * cuts.error(), cuts.errorAtRim());
    return cuts;
}

} // namespace

// Whether the area is within 5 % of the swept one, or within 0.05 cells along its rim. Triangles beside
// notches are inverted and count twice, and a body four cells thick is nearly all rim.
bool isNear(const Cuts& cuts) {
    return std::abs(cuts.area - cuts.section) < std::max(0.05 * cuts.section, 0.05 * cuts.rim);
}

TEST(HardSkins, HoldByTenPlanesEach) {
    for (const Shape& shape : shapes) {
        RandomPlanes random(shape);
        StrokeCheck check(sceneOf(shape), {.substeps = 2}, true);
        const ClosedSurface uncut(check.body());
        for (int p = 0; p < planes; ++p) {
            const std::string what = std::string(shape.name) + ", plane " + std::to_string(p + 1);
            const Cuts cuts = cutOnce(check, uncut, random.next(), what);
            EXPECT_TRUE(isNear(cuts)) << what;
        }
    }
}

// For an open mesh, the cut surface is the one wrapped around it.
TEST(HardSkins, OfOpenMeshesHoldByTenPlanes) {
    const Shape shape{"organ", 32, 14, 9};
    RandomPlanes random(shape);
    StrokeCheck check(sceneOf(shape), {.substeps = 2}, true);
    const ClosedSurface uncut(check.body());
    for (int p = 0; p < planes; ++p) {
        const std::string what = "open organ, plane " + std::to_string(p + 1);
        const Cuts cuts = cutOnce(check, uncut, random.next(), what);
        EXPECT_TRUE(isNear(cuts)) << what;
    }
}

// For bodies half as fine again, 5 % suffices.
TEST(HardSkins, OfFinerBodiesHoldWithinFivePercent) {
    for (Shape shape : shapes) {
        RandomPlanes random(shape);
        shape.resolution = shape.resolution * 3 / 2;
        StrokeCheck check(sceneOf(shape), {.substeps = 2}, true);
        const ClosedSurface uncut(check.body());
        for (int p = 0; p < planes; ++p) {
            const std::string what = std::string("finer ") + shape.name + ", plane " + std::to_string(p + 1);
            const Cuts cuts = cutOnce(check, uncut, random.next(), what);
            EXPECT_LT(std::abs(cuts.error()), 0.05) << what;
        }
    }
}

// Length inside the body of the line where two planes meet.
double lengthBetween(const ClosedSurface& uncut, const CutPlane& a, const CutPlane& b) {
    const Vector3d along = a.normal.cross(b.normal);
    if (along.norm() < 1e-6) return 0;
    Eigen::Matrix3d rows;
    rows << a.normal.transpose(), b.normal.transpose(), along.transpose();
    const Vector3d point = rows.inverse() * Vector3d(a.normal.dot(a.point), b.normal.dot(b.point), 0);
    const Vector3d way = 10 * along.normalized(); // longer than any body [m]
    return uncut.chord(point - way, point + way, uncut.rest()).length;
}

// Ten successive cuts through one body. Cuts nearer than a cell share cells, so near a crossing line, up to a
// cell beside it, the cut may differ from the blade.
TEST(HardSkins, HoldByTenPlanesThatCross) {
    for (const Shape& shape : shapes) {
        RandomPlanes random(shape);
        StrokeCheck check(sceneOf(shape), {.substeps = 2}, true);
        const ClosedSurface uncut(check.body());
        const double spacing = check.body().spacing();
        std::vector<CutPlane> done;
        Cuts cuts;
        double crossing = 0; // in cells
        StrokeResult result;
        for (int p = 0; p < planes; ++p) {
            const CutPlane plane = random.next();
            const std::string what = std::string(shape.name) + ", planes up to " + std::to_string(p + 1);
            result = check.stroke(sweepOf(plane, 1, 3).blade(), what);
            check.checkSurface(result, what);
            const auto [section, rim] = uncut.section(plane);
            cuts.section += section / (spacing * spacing);
            cuts.rim += rim / spacing;
            for (const CutPlane& other : done) crossing += lengthBetween(uncut, plane, other) / spacing;
            done.push_back(plane);
            cuts.area = ClosedSurface(check.body()).area(Part::inside) / 2 / (spacing * spacing);
            std::printf("%-32s %3u pieces, %3zu parts, %3zu crowded edges of %6zu triangles, volume %+.1e, "
                        "area %+.2f %%, %+.3f cells along rims of %.0f, crossings %.0f\n",
                        what.c_str(), result.status.pieces, result.parts, result.crowdedEdges,
                        result.triangles, result.volumeError, 100 * cuts.error(), cuts.errorAtRim(), cuts.rim,
                        crossing);
            EXPECT_LT(std::abs(cuts.area - cuts.section), 0.05 * cuts.rim + 0.1 * cuts.section) << what;
        }
    }
}
