// Tests of edge-edge contacts on the device.
#include "common/layout.h"
#include "sim/collision/face_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/growing_run.hpp"
#include "sim/scenes.hpp"
#include "sinew/simulation.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float thickness = 0.01f;
constexpr double reach = 0.02;

struct Outcome {
    int worst = 0, end = 0;
    double speed = 0;
};

Outcome outcomeOf(const Scene& scene, const Settings& settings, int steps) {
    test::Runner runner(scene, settings);
    Outcome outcome;
    for (int step = 0; step < steps; ++step) {
        const Status status = runner.run(1);
        EXPECT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step << ": " << status.contactRoom;
        if (status.contactRoom > 0) return outcome;
        if (step % 10 == 9)
            outcome.worst = std::max(outcome.worst, test::intersections(scene, runner.positions()));
    }
    outcome.end = test::intersections(scene, runner.positions());
    outcome.speed = test::rms(runner.velocities());
    return outcome;
}

// Two triangles, each with an edge that crosses one of the other: the lower edge lies along x at height 0,
// the upper one along z at `height`. The corners of the lower triangle have `lowerMass` [kg]; with 0 they
// never move.
Scene crossedEdges(float lowerMass, float height, float speed) {
    Scene scene;
    scene.gravity = {};
    const auto add = [&](const Vec3& x, float mass, float down) {
        scene.particles.push_back({.position = x,
                                   .velocity = {0, -down, 0},
                                   .inverseMass = mass > 0 ? 1 / mass : 0,
                                   .radius = thickness});
    };
    for (const Vec3& x : {Vec3{-0.9f, 0, 0.02f}, Vec3{1.1f, 0, -0.03f}, Vec3{0, -2, 0.1f}})
        add(x, lowerMass, 0);
    for (const Vec3& x : {Vec3{0.1f, 0, -1}, Vec3{-0.05f, 0, 0.8f}, Vec3{0, 2, 0}})
        add({x.x, x.y + height, x.z}, 1, speed);
    scene.faces = {{{0, 1, 2}, thickness}, {{3, 4, 5}, thickness}};
    return scene;
}

Vector3d momentumOf(const Scene& scene, const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i)
        if (scene.particles[i].inverseMass > 0) sum += v[i] / double{scene.particles[i].inverseMass};
    return sum;
}

// Relative velocity and position of the crossing points: upper edge minus lower edge.
struct Apart {
    Vector3d speed, way; // [m/s], [m]
};

Apart apart(const std::vector<Vector3d>& x, const std::vector<Vector3d>& v) {
    const auto cross = [](const Vector3d& p, const Vector3d& q) { return p.x() * q.z() - p.z() * q.x(); };
    const Vector3d d = x[1] - x[0], e = x[4] - x[3], r = x[3] - x[0];
    const double s = cross(r, e) / cross(d, e), t = cross(r, d) / cross(d, e);
    return {v[3] + t * (v[4] - v[3]) - v[0] - s * (v[1] - v[0]), x[3] + t * e - x[0] - s * d};
}

// Number of edge contacts of the last substep; both edges of a contact count.
std::size_t edgesTouching(test::Runner& runner) {
    const auto read = [&]<typename T>(const char* label, T) {
        const auto& buffers = runner.simulation().program().buffers;
        for (std::uint32_t b = 0; b < buffers.size(); ++b)
            if (buffers[b].label == label) return test::queue().download<T>(runner.simulation().view({b}));
        return std::vector<T>();
    };
    const auto directions = read("edges.directions", layout::vec4{});
    std::size_t touching = 0;
    for (const layout::ListRange& list : read("edges.lists", layout::ListRange{}))
        for (std::uint32_t s = 0; s < list.count; ++s) touching += directions[list.first + s].w > 0 ? 1 : 0;
    return touching;
}

} // namespace

// Restitution 0 and more: momentum is conserved, and the crossing points part by Newton's law of impact.
TEST(EdgeContacts, PartAsRestitutionHasItAndKeepMomentum) {
    for (const float e : {0.0f, 0.5f, 1.0f}) {
        Scene scene = crossedEdges(2, 0.1f, 1);
        scene.contacts.restitution = e;
        test::Runner runner(scene, {.substeps = 16});
        const Vector3d before = momentumOf(scene, runner.velocities());
        for (int step = 0; step < 8; ++step) ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const Apart parting = apart(runner.positions(), runner.velocities());
        EXPECT_NEAR(parting.speed.y(), double{e}, 0.01) << "restitution " << e;
        EXPECT_GE(parting.way.y(), 0.99 * reach);
        EXPECT_LE((momentumOf(scene, runner.velocities()) - before).norm(), 1e-5);
    }
}

// The tangential impulse of an impact is friction times its normal impulse, because both directions act on
// equal masses. Static friction stops the sliding completely.
TEST(EdgeContacts, SlideAndHoldByTheirFriction) {
    for (const float mass : {0.0f, 2.0f})
        for (const float holding : {0.0f, 3.0f}) {
            Scene scene = crossedEdges(mass, 0.1f, 1);
            for (std::size_t i = 3; i < 6; ++i) scene.particles[i].velocity.x = 1;
            scene.contacts.friction = 0.3f;
            scene.contacts.staticFriction = holding;
            test::Runner runner(scene, {.substeps = 16});
            const Vector3d before = momentumOf(scene, runner.velocities());
            for (int step = 0; step < 8; ++step) ASSERT_EQ(runner.run(1).nonFinite, 0u);
            const auto x = runner.positions(), v = runner.velocities();
            const Vector3d blow = v[3] + v[4] + v[5] - Vector3d(3, -3, 0); // each corner has 1 kg
            const double along = apart(x, v).speed.x();
            std::printf(
                "edges, lower corners of %.0f kg, static friction %.0f: %.5f of the blow, then %.5f m/s\n",
                double{mass}, double{holding}, -blow.x() / blow.y(), along);
            EXPECT_GE(blow.y(), 0.3) << "they have met";
            if (holding == 0)
                EXPECT_NEAR(-blow.x() / blow.y(), 0.3, 0.003);
            else
                EXPECT_NEAR(along, 0, 0.005);
            if (mass > 0) {
                EXPECT_LE((momentumOf(scene, v) - before).norm(), 1e-5);
            }
        }
}

// Speeds up to 150 thicknesses a substep, against moving and fixed edges.
TEST(EdgeContacts, StopEdgesThatAreFasterThanTheirThickness) {
    for (const float mass : {0.0f, 100.0f})
        for (const float speed : {5.0f, 60.0f, 300.0f, 1000.0f}) {
            Scene scene = crossedEdges(mass, 0.037f * speed, speed);
            test::Runner runner(scene, {.substeps = 4});
            const double before = test::kineticEnergy(scene, runner.velocities());
            for (int step = 0; step < 4; ++step) ASSERT_EQ(runner.run(1).nonFinite, 0u);
            const double distance = apart(runner.positions(), runner.velocities()).way.y();
            EXPECT_GE(distance, 0.9 * reach) << speed << " m/s, corners of " << mass << " kg";
            EXPECT_LT(test::kineticEnergy(scene, runner.velocities()), before) << "inelastic";
        }
}

// Without gravity, resting bodies keep their positions exactly, asleep or not, so the motion after the impact
// must equal that without sleep.
TEST(EdgeContacts, WakeWhatTheyTouch) {
    Scene scene = crossedEdges(2, 0.8f, 1);
    scene.contacts.friction = 0.3f;
    test::Runner slept(scene, {.substeps = 8, .sleeps = true}), awake(scene, {.substeps = 8});
    bool slumbered = false, woke = false;
    for (int step = 0; step < 60; ++step) {
        const Status status = slept.run(1);
        awake.run(1);
        slumbered = slumbered || status.sleeping == 3;
        woke = woke || (slumbered && status.sleeping == 1); // the opposite corner sleeps on
        ASSERT_EQ(slept.positions(), awake.positions()) << "step " << step;
        ASSERT_EQ(slept.velocities(), awake.velocities()) << "step " << step;
    }
    EXPECT_TRUE(slumbered && woke);
}

TEST(EdgeContacts, LetEdgesPassBesideEachOther) {
    Scene scene = crossedEdges(0, 0.5f, 40);
    for (std::size_t i = 3; i < 6; ++i) scene.particles[i].position.x += 1.2f;
    test::Runner runner(scene, {.substeps = 8});
    runner.run(2);
    for (const Vector3d& v : runner.velocities()) EXPECT_TRUE(v.y() == 0 || std::abs(v.y() + 40) < 1e-3);
}

TEST(EdgeContacts, KeepACoarseClothOutOfABoxOfTriangles) {
    for (const float spacing : {0.15f, 0.1f}) {
        const Outcome outcome =
            outcomeOf(test::clothOnBox(spacing), {.substeps = 16, .contactRoom = 96}, 120);
        std::printf(
            "cloth on box, spacing %.2f m: %d edges through faces at worst, %d at the end; v rms %.4f m/s\n",
            double{spacing}, outcome.worst, outcome.end, outcome.speed);
        EXPECT_EQ(outcome.end, 0);
    }
}

TEST(EdgeContacts, KeepTwoCoarseSheetsApartThatCross) {
    for (const float spacing : {0.15f, 0.1f}) {
        const Outcome outcome =
            outcomeOf(test::crossedSheets(spacing), {.substeps = 16, .contactRoom = 96}, 120);
        std::printf("crossed sheets, spacing %.2f m: %d edges through faces at worst, %d at the end; v rms "
                    "%.4f m/s\n",
                    double{spacing}, outcome.worst, outcome.end, outcome.speed);
        EXPECT_EQ(outcome.end, 0);
    }
}

// Hard case 17: the ends turn several times and move together, then the strip comes to rest.
TEST(EdgeContacts, KeepATwistedStripOutOfItself) {
    const Scene scene = test::strip(0.01f);
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 160});
    Outcome outcome;
    constexpr int turning = 90, settling = 40;
    constexpr double turns = 1.5;
    for (int step = 1; step <= turning + settling; ++step) {
        const double part = std::min(1.0, step / double{turning});
        const std::vector<Vec3> anchors =
            test::twistedEnds(scene, turns * 2 * std::numbers::pi * part, 0.1 * part);
        const Status status = runner.step(scene.dt, anchors);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << step << ": " << status.contactRoom;
        if (step % 10 == 0)
            outcome.worst = std::max(outcome.worst, test::intersections(scene, runner.positions()));
    }
    outcome.end = test::intersections(scene, runner.positions());
    std::printf("twist by %.1f turns: %d edges through faces at worst, %d at the end; v rms %.4f m/s\n",
                2 * turns, outcome.worst, outcome.end, test::rms(runner.velocities()));
    EXPECT_EQ(outcome.end, 0);
}

TEST(EdgeContacts, EndInTheSameBitsForAnyMarginRoomOrderAndForm) {
    Scene scene = test::crossedSheets(0.1f);
    scene.contacts.restitution = 0.3f;
    constexpr int steps = 25;
    const Settings settings{.substeps = 8, .contactRoom = 96};
    const auto hash = [&](const Settings& asked) { return test::hashOfRun(scene, asked, steps); };
    const std::uint64_t expected = hash(settings);
    Settings narrow = settings, reversed = settings;
    narrow.contactMargin = 0.2f;
    narrow.contactRoom = 128;
    reversed.isReversed = true;
    reversed.forms.usesTexels = false;
    EXPECT_EQ(hash(narrow), expected) << "another margin, more room";
    EXPECT_EQ(hash(reversed), expected) << "reversed, without texels";
}

// Hard case 29, in a scene where edges touch in many steps.
TEST(EdgeContacts, ThatHaveNoRoomAreSaidAndRepeatedToTheSameBits) {
    const Scene scene = test::crossedSheets(0.1f);
    constexpr int steps = 25;
    const std::uint64_t hash = test::hashOfRun(scene, {.substeps = 8, .contactRoom = 96}, steps);
    int touching = 0; // number of steps
    const auto run = test::runGrowing(scene, {.substeps = 8}, steps, [&](test::Runner& runner) {
        touching += edgesTouching(runner) > 0 ? 1 : 0;
    });
    EXPECT_GE(run.growths, 1);
    EXPECT_GE(touching, 3);
    EXPECT_EQ(run.hash, hash);
}

TEST(EdgeContacts, AreAbsentWhereNoTwoEdgesCanMeet) {
    Scene scene;
    addMeshCollider(scene, {.vertices = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}},
                            .triangles = {{0, 1, 2}, {0, 2, 3}},
                            .thickness = thickness});
    scene.particles.push_back({.position = {0, 1, 0}, .radius = thickness});
    EXPECT_FALSE(test::usesKernel(scene, "find_edge_contacts"));
    EXPECT_TRUE(test::usesKernel(scene, "find_face_contacts"));
    EXPECT_TRUE(test::usesKernel(test::crossedSheets(0.15f), "find_edge_contacts"));
}
