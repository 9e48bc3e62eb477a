// Tests that an incision of the scene that the viewer starts with is seen once the body is at rest: the roll
// stretches the upper side, and its rims part.
#include "scenes/load.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cstdio>
#include <set>

using namespace sinew;
using Eigen::Vector3d;
using test::ClosedSurface;
using test::CutBody;

namespace {

constexpr double at = 0.03, halfLength = 0.05; // place of the incision along x, and its half length [m]

// Height of the skin where the incision is made [m].
double topOf(const ClosedSurface& surface) {
    double top = -1;
    for (const Vector3d& point : surface.drawn())
        if (std::abs(point.x() - at) < 0.01 && std::abs(point.z()) < 0.01) top = std::max(top, point.y());
    return top;
}

// Corners of the inside that triangles beside the cut or of the skin have too.
std::vector<std::uint32_t> rimOf(const ClosedSurface& surface) {
    std::set<std::uint32_t> ofInside, ofOutside;
    for (const ClosedSurface::Triangle& triangle : surface.triangles())
        (triangle.part == ClosedSurface::Part::inside ? ofInside : ofOutside)
            .insert(triangle.points.begin(), triangle.points.end());
    std::vector<std::uint32_t> rim;
    std::ranges::set_intersection(ofInside, ofOutside, std::back_inserter(rim));
    return rim;
}

// The widest gap between the two sides of the rim that were one before the cut [m].
double gapeOf(const ClosedSurface& surface, double cell) {
    const std::vector<std::uint32_t> rim = rimOf(surface);
    double widest = 0;
    for (const std::uint32_t a : rim)
        for (const std::uint32_t b : rim)
            if ((surface.rest()[a] - surface.rest()[b]).norm() < 0.05 * cell)
                widest = std::max(widest, (surface.drawn()[a] - surface.drawn()[b]).norm());
    return widest;
}

} // namespace

// Measured on lavapipe, a second and a half after the cut, for the depths below: 0.9, 4.9, 22 and 63 mm. A
// millimetre is two pixels of the first picture in a window of 1280 x 720.
TEST(Incision, OfTheFirstSceneGapesAtRest) {
    struct Expected {
        double depth, least; // [m]
    };
    scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/organ_draped.toml");
    loaded.settings.contactRoom = 64;
    CutBody body(loaded.scene, loaded.settings);
    body.runner().run(120);
    const double top = topOf(ClosedSurface(body));
    ASSERT_GT(top, 0.15);
    double last = 0;
    for (const Expected expected : {Expected{0.005, 0.0005}, {0.01, 0.003}, {0.02, 0.015}, {0.05, 0.04}}) {
        CutBody incised(loaded.scene, loaded.settings);
        incised.runner().takeOver(body.runner());
        EXPECT_EQ(gapeOf(ClosedSurface(incised), incised.spacing()), 0) << "nothing is cut";
        const auto edge = [&](double y) {
            return std::vector<sim::Vec3>{test::toFloats({at, y, -halfLength}),
                                          test::toFloats({at, y, halfLength})};
        };
        const std::vector<sim::Vec3> from = edge(0.4), to = edge(top - expected.depth);
        const sim::Status status = incised.runner().cut({.from = from, .to = to});
        incised.runner().run(90);
        const double gape = gapeOf(ClosedSurface(incised), incised.spacing());
        std::printf("%2.0f mm deep: %u links, gapes by %.2f mm\n", 1000 * expected.depth, status.linksCut,
                    1000 * gape);
        EXPECT_GE(gape, expected.least) << expected.depth;
        EXPECT_GT(gape, last) << "a deeper one gapes wider";
        last = gape;
    }
}
