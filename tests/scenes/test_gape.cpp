// Tests that an incision of the scene that the viewer starts with is seen once the body is at rest: the roll
// stretches the upper side, and its rims part. They are smooth, though the body gapes while a slow blade cuts
// it.
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

namespace {

// A stroke of an upright blade: the path of the upper end of its edge, and the height of the lower one [m].
struct Stroke {
    Vector3d from, to;
    double bottom;
    double most = 0; // cells rms
    Vector3d along() const { return (to - from).normalized(); }
    Vector3d across() const { return Vector3d(along().z(), 0, -along().x()); }
};

void play(CutBody& body, const Stroke& stroke, int steps) {
    const auto edge = [&](int step) -> std::vector<sim::Vec3> {
        const Vector3d top = stroke.from + (stroke.to - stroke.from) * step / steps;
        return {test::toFloats(top), test::toFloats({top.x(), stroke.bottom, top.z()})};
    };
    for (int s = 1; s <= steps; ++s) body.cut({.from = edge(s - 1), .to = edge(s), .isCarried = s > 1});
}

// How far points of the rim at rest lie beside the parabola through those within a cell and a half along the
// stroke [cells]: the way of a blade through a body that gapes is not straight at rest, but smooth.
double roughnessOf(const ClosedSurface& surface, const Stroke& stroke, double cell) {
    std::vector<std::array<double, 2>> points; // along and across
    for (const std::uint32_t p : rimOf(surface)) {
        const Vector3d x = surface.rest()[p] / cell;
        points.push_back({stroke.along().dot(x), stroke.across().dot(x)});
    }
    double square = 0;
    for (const auto& [along, across] : points) {
        Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
        Vector3d right = Vector3d::Zero();
        for (const auto& [other, place] : points) {
            const double way = other - along;
            if (std::abs(way) > 1.5) continue;
            const Vector3d row(1, way, way * way);
            normal += row * row.transpose();
            right += row * place;
        }
        square += std::pow(across - normal.ldlt().solve(right)[0], 2);
    }
    return std::sqrt(square / static_cast<double>(points.size()));
}

} // namespace

// Regression test. Links die as a whole, so the skin before a slow blade parts before the blade is there, and
// what hung on the wrong side of its path was carried away: rims had teeth, 0.058, 0.068 and 0.050 cells rms.
// Later, edges of the skin with an end that had moved onto the blade were parted where the blade had met
// them, between their first ends: 0.053, 0.032 and 0.035.
TEST(Incision, OfASlowStrokeHasSmoothRims) {
    scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/organ_draped.toml");
    loaded.settings.contactRoom = 64;
    CutBody body(loaded.scene, loaded.settings);
    body.runner().run(90);
    for (const Stroke& stroke : {Stroke{{0, 0.4, -0.07}, {0, 0.4, 0.07}, 0.165, 0.038},
                                 Stroke{{0.03, 0.4, -0.05}, {0.03, 0.4, 0.05}, 0.15, 0.035},
                                 Stroke{{-0.05, 0.4, 0.05}, {0.06, 0.4, -0.055}, 0.165, 0.038}}) {
        CutBody incised(loaded.scene, loaded.settings);
        incised.runner().takeOver(body.runner());
        play(incised, stroke, 40);
        const ClosedSurface surface(incised);
        ASSERT_GT(rimOf(surface).size(), 100u);
        const double roughness = roughnessOf(surface, stroke, incised.spacing());
        std::printf("%.4f cells rms\n", roughness);
        EXPECT_LT(roughness, stroke.most);
    }
}

namespace {

// How far a point is from the plane of an upright blade [m].
double distanceFrom(const Stroke& stroke, const Vector3d& x) {
    return std::abs(stroke.across().dot(x - stroke.from));
}

// Rim points that are further than that from their nearest ones of `later` [cells], of those away from a
// stroke.
struct Change {
    std::size_t count = 0;
    double square = 0, most = 0;
};

Change changeOf(const ClosedSurface& before, const ClosedSurface& later, const Stroke& stroke, double cell) {
    Change change;
    const std::vector<std::uint32_t> rim = rimOf(later);
    for (const std::uint32_t p : rimOf(before)) {
        if (distanceFrom(stroke, before.drawn()[p]) < 1.5 * cell) continue;
        double nearest = 1e9;
        for (const std::uint32_t q : rim)
            nearest = std::min(nearest, (later.rest()[q] - before.rest()[p]).norm() / cell);
        ++change.count;
        change.square += nearest * nearest;
        change.most = std::max(change.most, nearest);
    }
    return change;
}

} // namespace

// Regression test. A later stroke that crosses an incision meets the gap between its rims too. It parted the
// edges across that gap anew, so that the older rim had teeth along all of its length: its points moved by
// 0.038 cells rms, 0.23 at most, for fast strokes, and by 0.014 and 0.13 for slow ones.
TEST(Incision, KeepsItsRimsWhereALaterStrokeCrossesIt) {
    scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/organ_draped.toml");
    loaded.settings.contactRoom = 64;
    const Stroke first{{0, 0.4, -0.07}, {0, 0.4, 0.07}, 0.165};
    const Stroke second{{-0.05, 0.4, 0.05}, {0.06, 0.4, -0.055}, 0.165};
    CutBody body(loaded.scene, loaded.settings);
    body.runner().run(90);
    for (const int steps : {1, 40}) {
        CutBody incised(loaded.scene, loaded.settings);
        incised.runner().takeOver(body.runner());
        play(incised, first, steps);
        incised.runner().run(20);
        const ClosedSurface before(incised);
        play(incised, second, steps);
        const ClosedSurface later(incised);
        EXPECT_EQ(later.openEdges(), 0u);
        const Change change = changeOf(before, later, second, incised.spacing());
        std::printf("%2d steps: %zu points moved by %.4f cells rms, %.3f at most\n", steps, change.count,
                    std::sqrt(change.square / static_cast<double>(change.count)), change.most);
        EXPECT_GT(change.count, 50u);
        EXPECT_LT(change.most, 0.02);
    }
}
