// Tests of strokes over many steps through a moving body, and of the resulting pieces.
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <numeric>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::Sweep;

namespace {

constexpr float spacing = 0.05f;
constexpr std::uint32_t cells = 6;

Scene movingCube(const Vector3d& velocity, const Vector3d& turning = Vector3d::Zero()) {
    Scene scene{.name = "moving cube", .gravity = {0, 0, 0}};
    addLattice(scene, {.origin = {0, 0, 0},
                       .cells = {cells, cells, cells},
                       .spacing = spacing,
                       .youngModulus = 1e5f,
                       .isCuttable = true});
    const Vector3d centre = Vector3d::Constant(0.5 * cells * double{spacing});
    for (Particle& particle : scene.particles)
        particle.velocity =
            test::toFloats(velocity + turning.cross(test::toVector(particle.position) - centre));
    return scene;
}

// Moves a blade along y through the body along x in the plane z = height, from `beyond` cells before the body
// to `beyond` cells behind it. The `steps` steps have equal lengths in the body's frame.
Status stroke(CutBody& body, int steps, double height, const Vector3d& perStep, double beyond = 0.5) {
    const double low = -beyond * double{spacing}, high = (cells + beyond) * double{spacing};
    Sweep sweep;
    Status status;
    std::vector<Vec3> last;
    for (int s = 0; s <= steps; ++s) {
        const Vector3d shift = s * perStep;
        const double x = low + (high - low) * s / steps;
        sweep.from = last;
        sweep.to = {test::toFloats(Vector3d(x, low, height) + shift),
                    test::toFloats(Vector3d(x, high, height) + shift)};
        sweep.isCarried = s > 1;
        last = sweep.to;
        if (s > 0) status = body.cut(sweep);
    }
    return status;
}

} // namespace

// The body moves 0.02 to 0.3 cells a step, along the stroke, across it, and both. 28 steps over 7 cells make
// every fourth step end on a column of particles.
TEST(Stroke, Of30StepsThroughAMovingBodyLeavesTwoPieces) {
    struct Case {
        Vector3d cellsAStep;
        double height; // height of the blade [cells]
        int steps;
    };
    const Case cases[] = {{{0, 0, 0}, 3, 28},     {{0, 0, 0}, 2.5, 30},      {{0.02, 0, 0}, 3, 28},
                          {{-0.1, 0, 0}, 3, 28},  {{0.3, 0, 0}, 2.5, 28},    {{0, 0, 0.02}, 2.5, 28},
                          {{0, 0, 0.3}, 2.5, 30}, {{-0.2, 0, 0.2}, 2.6, 28}, {{0.1, 0.3, -0.1}, 2.4, 30}};
    for (const Case& each : cases) {
        const Vector3d way = double{spacing} * each.cellsAStep;
        CutBody body(movingCube(way * 60));
        const Status status = stroke(body, each.steps, each.height * double{spacing}, way);
        EXPECT_EQ(status.pieces, 2u) << each.cellsAStep.transpose() << " cells a step, height "
                                     << each.height;
        EXPECT_EQ(body.oneSided(), 0u);
        EXPECT_EQ(body.pieces(), body.expectedPieces());
    }
}

// The blade is fixed in the world, with equal `from` and `to`, and the body moves onto it.
TEST(Stroke, OfABladeThatABodyMovesOntoCutsIt) {
    const double way = 0.2 * double{spacing};
    CutBody body(movingCube(Vector3d(-way * 60, 0, 0)));
    const auto x = static_cast<float>(-0.5 * double{spacing}), z = 2.5f * spacing;
    const Sweep still{.from = {{x, -1, z}, {x, 1, z}}, .to = {{x, -1, z}, {x, 1, z}}, .isCarried = true};
    Status status;
    for (int s = 0; s < 45; ++s) status = body.cut(still);
    EXPECT_EQ(status.pieces, 2u);
}

// In a rotating body, every link sees the blade's old edge at a different place.
TEST(Stroke, ThroughATurningBodyLeavesNoLinkBetweenTwoLargePieces) {
    for (const double turns : {0.5, 2.0}) { // rad/s
        CutBody body(movingCube(Vector3d::Zero(), Vector3d(turns, 0.5 * turns, turns)));
        const Status status = stroke(body, 30, 2.6 * double{spacing}, Vector3d::Zero(), 3);
        std::vector<std::uint32_t> sizes = body.pieceSizes();
        std::ranges::sort(sizes, std::greater<>());
        EXPECT_GE(status.pieces, 2u);
        EXPECT_GT(sizes[1], 60u) << "of 343";
        EXPECT_GE(sizes[0] + sizes[1], 338u) << "and hardly a piece of debris";
    }
}

namespace {

// Inverse affine motion of the material around each particle, from its live links: from the world to the body
// at rest.
std::vector<Eigen::Affine3d> toRest(const CutBody& body, const std::vector<Vector3d>& x) {
    std::vector<Eigen::Matrix3d> moved(x.size(), Eigen::Matrix3d::Zero()), spread = moved;
    for (const test::LiveLink& link : body.links()) {
        const Vector3d d = body.at(link.b) - body.at(link.a);
        for (const std::uint32_t end : {link.a, link.b}) {
            moved[end] += (x[link.b] - x[link.a]) * d.transpose();
            spread[end] += d * d.transpose();
        }
    }
    std::vector<Eigen::Affine3d> motions;
    for (std::uint32_t i = 0; i < x.size(); ++i) {
        Eigen::Affine3d motion = Eigen::Affine3d::Identity();
        motion.linear() = spread[i] * moved[i].inverse();
        motion.translation() = body.at(i) - motion.linear() * x[i];
        motions.push_back(motion);
    }
    return motions;
}

// A triangle swept by a stroke, in the body at rest.
using Triangle = std::array<Vector3d, 3>;

// Whether a segment crosses the triangle; both ends must be farther than `least` from its plane.
bool crosses(const Vector3d& a, const Vector3d& b, const Triangle& triangle, double least) {
    const auto& [p, q, r] = triangle;
    const Vector3d normal = (q - p).cross(r - p).normalized();
    const double above = normal.dot(a - p), below = normal.dot(b - p);
    if (!(std::min(std::abs(above), std::abs(below)) > least) || above * below > 0) return false;
    const Vector3d at = a + above / (above - below) * (b - a);
    const double u = normal.dot((q - p).cross(at - p)), v = normal.dot((r - q).cross(at - q)),
                 w = normal.dot((p - r).cross(at - r));
    return std::min({u, v, w}) >= 0 || std::max({u, v, w}) <= 0;
}

// Whether an edge that moves evenly from a, b to c, d crosses the segment from p to q.
bool sweeps(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d, const Vector3d& p,
            const Vector3d& q, double least) {
    constexpr int parts = 32; // the path of a twisted edge is not a pair of triangles
    for (int n = 0; n < parts; ++n) {
        const double low = static_cast<double>(n) / parts, high = (n + 1.0) / parts;
        const Vector3d e = a + low * (b - a), f = a + high * (b - a), g = c + low * (d - c),
                       h = c + high * (d - c);
        if (crosses(p, q, {e, f, h}, least) || crosses(p, q, {e, h, g}, least)) return true;
    }
    return false;
}

} // namespace

// Brute force in double over all links and the swept area as the material around each link saw it. There, the
// edge of a step coincides with the start of the next.
TEST(Stroke, ThroughATurningAndMovingBodyLeavesNoLiveLinkThatCrossesItsSweep) {
    for (const double turns : {0.7, 2.5}) { // rotation [rad/s]
        const Vector3d velocity(0.6, -0.3, 0.4);
        CutBody body(movingCube(velocity, Vector3d(turns, 0.5 * turns, -turns)));
        const auto before = body.links();
        constexpr int steps = 30;
        std::vector<std::vector<Eigen::Affine3d>> motions; // by step
        std::vector<std::array<Vector3d, 2>> edges;
        for (int s = 0; s <= steps; ++s) {
            const Vector3d middle = Vector3d::Constant(0.5 * cells * double{spacing}) + s / 60.0 * velocity;
            const double x = (2.0 * s / steps - 1) * 7 * double{spacing};
            edges.push_back({middle + Vector3d(x, -0.4, 0.01), middle + Vector3d(x, 0.4, -0.03)});
            motions.push_back(toRest(body, body.runner().positions()));
            if (s == 0) continue;
            const auto &last = edges[edges.size() - 2], &now = edges.back();
            const Sweep sweep{.from = {test::toFloats(last[0]), test::toFloats(last[1])},
                              .to = {test::toFloats(now[0]), test::toFloats(now[1])},
                              .isCarried = s > 1};
            body.cut(sweep);
            if (s == 1) motions[0] = motions[1]; // the first edge is taken where it is as the step begins
        }
        const auto isCrossed = [&](const test::LiveLink& link) {
            for (std::size_t s = 1; s < edges.size(); ++s) {
                const Eigen::Affine3d &from = motions[s - 1][link.a], &to = motions[s][link.a];
                const Vector3d a = from * edges[s - 1][0], b = from * edges[s - 1][1], c = to * edges[s][0],
                               d = to * edges[s][1];
                if (sweeps(a, b, c, d, body.at(link.a), body.at(link.b), 0.03 * double{spacing})) return true;
            }
            return false;
        };
        const auto after = body.links();
        const auto crossed = std::ranges::count_if(before, isCrossed),
                   left = std::ranges::count_if(after, isCrossed);
        const auto dead = static_cast<std::ptrdiff_t>(before.size() - after.size());
        std::printf("at %.1f rad/s: %td of %zu links crossed, %td dead, %td left\n", turns, crossed,
                    before.size(), dead, left);
        EXPECT_GT(crossed, 200);
        EXPECT_EQ(left, 0);
        EXPECT_LT(static_cast<double>(dead), 1.25 * static_cast<double>(crossed)) << "and hardly others";
        EXPECT_GE(body.runner().run(1).pieces, 2u);
    }
}

TEST(Pieces, FallApartAndKeepMassAndMomentum) {
    Scene scene = movingCube(Vector3d::Zero());
    const double middle = 2.5 * double{spacing};
    for (Particle& particle : scene.particles) // two halves that part once nothing holds them
        particle.velocity = {0, 0, double{particle.position.z} < middle ? -0.5f : 0.5f};
    CutBody body(scene, {.substeps = 8});
    const Sweep sweep = test::sweepOf({Vector3d(0, 0, middle), Vector3d::UnitZ()}, 2, 2);
    EXPECT_EQ(body.cut(sweep).pieces, 2u);
    body.runner().run(59);
    const auto x = body.runner().positions(), v = body.runner().velocities();
    const auto pieces = body.pieces();
    Vector3d momentum = Vector3d::Zero(), expected = Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double mass = 1 / double{scene.particles[i].inverseMass};
        momentum += mass * v[i];
        expected += mass * test::toVector(scene.particles[i].velocity);
        const double gone = pieces[i] == pieces[0] ? -0.5 : 0.5;
        EXPECT_NEAR(x[i].z() - body.at(static_cast<std::uint32_t>(i)).z(), gone, 1e-4) << "particle " << i;
    }
    EXPECT_LE((momentum - expected).norm(), 1e-5 * test::massOf(scene));
}
