// Tests of a rope of voxels that is tied in an overhand knot and pulled at both ends: its strands never pass
// each other, and the knot holds what pulls at it. The host judges by the knot's determinant, which changes
// if one strand goes through another, and by the distances of strands.
#include "sim/collision/face_scenes.hpp"
#include "sim/cutting/cut_gaps.hpp"
#include "sim/cutting/faced_bodies.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/holds.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::Triangle;
using Line = std::vector<Vector3d>; // points in order

namespace {

constexpr double voxel = double{test::facedSpacing};
constexpr std::uint32_t width = 2;            // of the rope, in cells
constexpr double thick = (width + 1) * voxel; // between strands that touch side by side [m]
constexpr std::uint32_t heldLayers = 3;       // of each end
constexpr double speed = 1.5;                 // of each end [m/s]

// Appends points that go on from the last one, turn level and aside, to the end's own side, and end straight.
void addLead(Line& line, double radius, double length) {
    constexpr double step = 0.02 * voxel;
    Vector3d at = line.back(), way = at - line[line.size() - 2];
    const double side = at.x() < 0 ? -1 : 1;
    way.z() = 0;
    way.normalize();
    const Eigen::AngleAxisd turn(-side * step / radius, Vector3d::UnitZ());
    while (std::abs(way.y()) > 0.01) line.push_back(at += step * (way = turn * way));
    way = {side, 0, 0};
    for (double gone = 0; gone < length; gone += step) line.push_back(at += step * way);
}

// The middle line of a rope in an overhand knot that is wide open: a trefoil without the tip of a lobe.
Line openKnot() {
    constexpr double lobe = 1.5 * thick, height = 0.95 * thick, pi = std::numbers::pi;
    constexpr double first = pi / 3 + 0.62, last = pi / 3 + 2 * pi - 0.62; // the tip is at pi / 3
    constexpr int pieces = 4000;
    Line line;
    for (int n = 0; n <= pieces; ++n) {
        const double t = first + (last - first) * n / pieces;
        const Vector3d p(lobe * (std::sin(t) + 2 * std::sin(2 * t)),
                         lobe * (std::cos(t) - 2 * std::cos(2 * t)), -height * std::sin(3 * t));
        line.emplace_back(Eigen::AngleAxisd(pi / 3, Vector3d::UnitZ()) * p); // the tip is at the top
    }
    for (int end = 0; end < 2; ++end) {
        addLead(line, 1.5 * lobe, 5 * voxel);
        std::ranges::reverse(line);
    }
    return line;
}

// Points a voxel apart along a line of far shorter pieces.
Line layersAlong(const Line& line) {
    Line layers{line.front()};
    double gone = 0;
    for (std::size_t n = 1; n < line.size(); ++n) {
        gone += (line[n] - line[n - 1]).norm();
        if (gone < voxel) continue;
        gone -= voxel;
        layers.push_back(line[n]);
    }
    return layers;
}

struct Rope {
    Scene scene;
    std::uint32_t layers = 0;
    std::vector<std::uint32_t> layerOf; // a particle

    Line middle(const Line& x) const {
        Line line(layers, Vector3d::Zero());
        for (std::size_t i = 0; i < layerOf.size(); ++i)
            line[layerOf[i]] += x[i] / ((width + 1) * (width + 1));
        return line;
    }
};

// The ends go `travel` [m] each.
Rope knottedRope(double travel, bool touches) {
    const Line line = layersAlong(openKnot());
    Rope rope{.scene = {.name = "knot", .damping = 2}, .layers = static_cast<std::uint32_t>(line.size())};
    Scene& scene = rope.scene;
    scene.gravity = {};
    scene.contacts.friction = 0.3f;
    Lattice lattice = test::facedLattice({width, width, rope.layers - 1}, 1e5f, false);
    if (!touches) lattice.radius = 0;
    const LatticeCorners corners = addLattice(scene, lattice);
    rope.layerOf.resize(scene.particles.size());
    Vector3d way = (line[1] - line[0]).normalized(), up = Vector3d::UnitZ();
    for (std::uint32_t k = 0; k < rope.layers; ++k) {
        const Vector3d next =
            (line[std::min(k + 1, rope.layers - 1)] - line[std::max(k, 1u) - 1]).normalized();
        up = Eigen::Quaterniond::FromTwoVectors(way, next) * up; // without twist
        way = next;
        for (std::uint32_t j = 0; j <= width; ++j)
            for (std::uint32_t i = 0; i <= width; ++i) {
                const std::uint32_t p = corners.at(i, j, k);
                rope.layerOf[p] = k;
                scene.particles[p].position = test::toFloats(
                    line[k] + voxel * ((i - width / 2.0) * up.cross(way) + (j - width / 2.0) * up));
            }
    }
    if (touches) addSurfaceFaces(scene, scene.grids[0]);
    for (const bool isFirst : {true, false}) {
        std::vector<std::uint32_t> end;
        for (std::uint32_t i = 0; i < rope.layerOf.size(); ++i)
            if (isFirst ? rope.layerOf[i] < heldLayers : rope.layerOf[i] + heldLayers >= rope.layers)
                end.push_back(i);
        const double side = (isFirst ? line.front() : line.back()).x() < 0 ? -1 : 1;
        scene.holds.push_back({isFirst ? "first" : "last", end});
        drive(scene, end,
              {{0, {}},
               {static_cast<float>(travel / speed), {.position = test::toFloats({side * travel, 0, 0})}}});
    }
    return rope;
}

// A crossing in a picture of a line: where the line passes under itself, and where it is above that.
struct Crossing {
    double under, over; // places along the line [pieces]
};

std::vector<Crossing> crossingsOf(const Line& line) {
    const Eigen::Quaterniond view = Eigen::Quaterniond(0.93, 0.21, -0.13, 0.27).normalized(); // any
    Line p;
    for (const Vector3d& x : line) p.push_back(view * x);
    std::vector<Crossing> crossings;
    for (std::size_t a = 0; a + 1 < p.size(); ++a)
        for (std::size_t b = a + 2; b + 1 < p.size(); ++b) {
            Eigen::Matrix2d ways;
            ways << (p[a + 1] - p[a]).head<2>(), (p[b] - p[b + 1]).head<2>();
            if (std::abs(ways.determinant()) < 1e-18) continue;
            const Eigen::Vector2d s = ways.inverse() * (p[b] - p[a]).head<2>();
            if (s.minCoeff() < 0 || s.maxCoeff() >= 1) continue;
            const bool isUnder =
                p[a].z() + s[0] * (p[a + 1] - p[a]).z() < p[b].z() + s[1] * (p[b + 1] - p[b]).z();
            const double atA = static_cast<double>(a) + s[0], atB = static_cast<double>(b) + s[1];
            crossings.push_back(isUnder ? Crossing{atA, atB} : Crossing{atB, atA});
        }
    std::ranges::sort(crossings, {}, &Crossing::under);
    return crossings;
}

// The determinant of the knot that a line makes if its ends are joined far away: 1 without a knot, 3 for an
// overhand knot. Each crossing has an equation between arcs, 2 over = under before + under behind; one arc is
// 0 and one equation follows from the others.
int determinantOf(const Line& line) {
    const std::vector<Crossing> crossings = crossingsOf(line);
    const auto count = static_cast<Eigen::Index>(crossings.size());
    if (count == 0) return 1;
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index c = 0; c < count; ++c) {
        const double over = crossings[static_cast<std::size_t>(c)].over;
        const auto arc = std::ranges::count_if(crossings, [&](const Crossing& u) { return u.under < over; });
        m(c, arc % count) += 2; // the arc behind the last crossing is the one before the first
        m(c, c) -= 1;
        m(c, (c + 1) % count) -= 1;
    }
    return static_cast<int>(std::lround(std::abs(m.topLeftCorner(count - 1, count - 1).determinant())));
}

double lengthOf(const Line& line) {
    double length = 0;
    for (std::size_t n = 1; n < line.size(); ++n) length += (line[n] - line[n - 1]).norm();
    return length;
}

// Overlap of strands [voxels].
double overlapOf(const Rope& rope, const Line& x) {
    constexpr std::uint32_t apart = 3 * (width + 1); // layers between two strands
    std::vector<Triangle> faces;
    for (const Face& face : rope.scene.faces) faces.push_back(face.particles);
    return test::deepest(voxel, x, faces, [&](std::uint32_t i, const Triangle& t) {
        const std::uint32_t a = rope.layerOf[i], b = rope.layerOf[t[0]];
        return std::max(a, b) - std::min(a, b) > apart;
    });
}

} // namespace

TEST(Knot, TightensAndHoldsWhatPullsAtItsEnds) {
    constexpr double travel = 2.1; // [m]
    const Rope rope = knottedRope(travel, true);
    const int pulled = static_cast<int>(std::ceil(60 * travel / speed));
    test::Runner runner(rope.scene, {.substeps = 24, .contactRoom = 64, .keepsForces = true});
    EXPECT_EQ(determinantOf(rope.middle(runner.positions())), 3);
    double deepest = -9, tension[2] = {0, 0};
    for (int step = 1; step <= pulled + 30; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite, 0u);
        ASSERT_EQ(status.contactRoom, 0u);
        if (step > pulled + 20) { // at rest
            const Impulses impulses = runner.simulation().forces(status.frame);
            for (std::size_t end = 0; end < 2; ++end)
                tension[end] += std::abs(double{impulses.holds[end].linear.x}) * 60 / 10;
        }
        if (step % 6 != 0) continue;
        const Line x = runner.positions();
        ASSERT_EQ(determinantOf(rope.middle(x)), 3) << "step " << step;
        ASSERT_EQ(test::intersections(rope.scene, x), 0) << "step " << step;
        deepest = std::max(deepest, overlapOf(rope, x));
    }
    const Line line = rope.middle(runner.positions());
    const double length = lengthOf(line), ends = (line.back() - line.front()).norm();
    std::printf("%u layers, %.2f m at rest; now %.2f m with ends %.2f m apart, %.1f thicknesses in the knot; "
                "strands overlap by %.3f voxels at most; tension %.0f and %.0f N\n",
                rope.layers, (rope.layers - 1) * voxel, length, ends, (length - ends) / thick, deepest,
                tension[0], tension[1]);
    EXPECT_LT(deepest, 0.1);
    EXPECT_GT(length - ends, 6 * thick) << "the knot is there";
    EXPECT_LT(length - ends, 14 * thick) << "and tight";
    EXPECT_GT(tension[0], 80);
    EXPECT_NEAR(tension[1], tension[0], 0.1 * tension[0]);
}

// The control: the same rope without contacts, of which the judges must say that it passed through itself.
TEST(Knot, ComesUndoneWithoutContacts) {
    const Rope rope = knottedRope(2.6, false);
    test::Runner runner(rope.scene, {.substeps = 24});
    ASSERT_EQ(runner.run(240).nonFinite, 0u);
    const Line line = rope.middle(runner.positions());
    EXPECT_EQ(determinantOf(line), 1);
    EXPECT_LT(lengthOf(line) - (line.back() - line.front()).norm(), thick);
}
