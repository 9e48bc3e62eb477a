// Tests of rest distances between particles and faces, and between edges, for different radii and thicknesses
// and on both sides of a solid surface. Distances are those that the contact measures.
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/collision/rest_checks.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "support/full.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float spacing = 0.05f;
const Settings settings{.substeps = 8, .contactRoom = 64};

// A plate of triangles about 0.07 m long in the plane y = 0, from -half to half.
MeshCollider plate(float half, std::uint32_t count, float thickness) {
    MeshCollider mesh{.name = "plate", .thickness = thickness};
    const auto at = [&](std::uint32_t k) {
        return half * (2 * static_cast<float>(k) / static_cast<float>(count) - 1);
    };
    for (std::uint32_t z = 0; z <= count; ++z)
        for (std::uint32_t x = 0; x <= count; ++x) mesh.vertices.push_back({at(x), 0, at(z)});
    for (std::uint32_t z = 0; z < count; ++z)
        for (std::uint32_t x = 0; x < count; ++x) {
            const std::uint32_t a = z * (count + 1) + x, b = a + 1, c = a + count + 1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, c + 1});
        }
    return mesh;
}

std::uint32_t addBall(Scene& scene, const Vec3& position, float radius, float mass = 0.01f) {
    scene.particles.push_back({.position = position, .inverseMass = 1 / mass, .radius = radius});
    scene.particles.back().keepsRest = true;
    return static_cast<std::uint32_t>(scene.particles.size() - 1);
}

// A voxel body with faces, from (0, 0, 0) on; its scene may have loose particles, too.
struct Block {
    Scene scene = weightless();
    std::size_t count = 0; // number of its particles
};

Block block(std::array<std::uint32_t, 3> cells, std::vector<float> fill = {}) {
    Block made;
    addLattice(made.scene, {.name = "block",
                            .cells = cells,
                            .spacing = spacing,
                            .fill = std::move(fill),
                            .youngModulus = 5e6f,
                            .radius = 0.3f * spacing});
    addSurfaceFaces(made.scene, made.scene.grids[0]);
    made.count = made.scene.particles.size();
    return made;
}

// Fixes the lowest layer. (A face with all corners fixed would have two sides.)
void hold(Block& made) {
    for (std::uint32_t i = 0; i < made.count; ++i)
        if (made.scene.particles[i].position.y == 0) made.scene.fixed.push_back({i});
}

// Fixes every other particle, so that every face has a free corner and the body hardly bends.
void holdTightly(Block& made) {
    for (std::uint32_t i = 0; i < made.count; ++i) {
        const Vec3& x = made.scene.particles[i].position;
        if (std::lround((x.x + x.y + x.z) / spacing) % 2 != 0) made.scene.fixed.push_back({i});
    }
}

// Displacement of the body near particle `i` [m]: the mean over the four of its particles in [first, end)
// that were nearest at the start.
Vector3d sagBeside(const Block& made, const std::vector<Vector3d>& x, std::uint32_t i, std::size_t first,
                   std::size_t end) {
    const auto at = [&](std::size_t k) {
        const Vec3& p = made.scene.particles[k].position;
        return Vector3d(double{p.x}, double{p.y}, double{p.z});
    };
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = first; k < end; ++k) near.push_back({(at(k) - at(i)).norm(), k});
    std::ranges::sort(near);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t n = 0; n < 4; ++n) sum += x[near[n].second] - at(near[n].second);
    return sum / 4;
}

Vector3d sagBeside(const Block& made, const std::vector<Vector3d>& x, std::uint32_t i) {
    return sagBeside(made, x, i, 0, made.count);
}

// A block with a step down at x = 3 spacings, to a height of 3 spacings.
Block steps() {
    std::vector<float> fill(6 * 4 * 6, 1.0f);
    for (std::size_t z = 0; z < 6; ++z)
        for (std::size_t x = 3; x < 6; ++x) fill[x + 6 * (3 + 4 * z)] = 0;
    return block({6, 4, 6}, fill);
}

// Depth of a ball near the inner edge of steps(), relative to the sagged body [m]. Below the edge it is the
// distance to the edge, beside the edge that to a face; for a ball that has fallen through, it is the depth
// of the fall.
double depthBehindStep(const Block& made, const std::vector<Vector3d>& all, std::uint32_t ball, double edge) {
    const Vector3d x = all[ball] - sagBeside(made, all, ball);
    const double aside = edge - x.x(), below = edge - x.y();
    return aside > 0 && below > 0 ? std::hypot(aside, below) : std::max(aside, below);
}

} // namespace

TEST(RestOfFaces, KeepsBallsOfAnyRadiusInAMeshWall) {
    for (const float radius : {0.004f, 0.02f, 0.06f}) {
        Scene scene = weightless();
        addMeshCollider(scene, plate(0.5f, 12, 0.01f));
        const float reach = radius + 0.01f;
        float x = -0.4f;
        std::vector<std::uint32_t> balls;
        for (const float part : {0.999f, 0.8f, 0.2f, -0.2f, -0.8f}) {
            balls.push_back(addBall(scene, {x, part * reach, 0.013f}, radius));
            x += 0.17f;
        }
        expectStill(scene, settings, double{radius}, 100,
                    "balls of " + std::to_string(radius) + " m in a wall");
        // The load presses each ball against the wall from its own side.
        for (const float down : {98.1f, -98.1f}) {
            Scene pressed = scene;
            pressed.gravity = {0, -down, 0};
            Runner runner(pressed, settings);
            runner.run(20);
            for (const std::uint32_t ball : balls) {
                const double start = double{scene.particles[ball].position.y},
                             end = runner.positions()[ball].y();
                if (start * double{down} > 0)
                    EXPECT_NEAR(end, start, 5e-3 * double{reach}) << radius << ", from " << start;
                else
                    EXPECT_GT(std::abs(end), 1.0) << "what is on the other side is free";
            }
        }
    }
}

// A ball at 0.2 of its reach inside a wall slides over the wall's faces and keeps this distance.
TEST(RestOfFaces, GoesWithAPointFromFaceToFace) {
    Scene scene = weightless();
    scene.gravity = {0, -9.81f, 0};
    addMeshCollider(scene, plate(0.5f, 12, 0.01f));
    const float reach = 0.03f;
    const std::uint32_t ball = addBall(scene, {-0.3f, 0.8f * reach, 0.013f}, 0.02f);
    scene.particles[ball].velocity = {0.5f, 0, 0.21f};
    Runner runner(scene, settings);
    double lowest = 1, highest = -1, fastest = 0;
    for (int step = 0; step < 60; ++step) {
        runner.run(1);
        const double y = runner.positions()[ball].y() / double{reach};
        lowest = std::min(lowest, y);
        highest = std::max(highest, y);
        fastest = std::max(fastest, std::abs(runner.velocities()[ball].y()));
    }
    std::printf("height from %.4f to %.4f of the reach, %.4f m/s up or down\n", lowest, highest, fastest);
    EXPECT_GT(runner.positions()[ball].x(), 0.15) << "[m]";
    EXPECT_GT(lowest, 0.79);
    EXPECT_LT(highest, 0.81);
    EXPECT_LT(fastest, 0.02) << "nothing is thrown [m/s]";
}

TEST(RestOfFaces, HoldsByFriction) {
    for (const float friction : {0.6f, 0.2f}) {
        Scene scene = weightless();
        scene.contacts.friction = friction;
        scene.gravity = {4, -9, 0}; // a slope of 0.44
        addMeshCollider(scene, plate(0.5f, 12, 0.01f));
        const std::uint32_t ball = addBall(scene, {-0.3f, 0.8f * 0.03f, 0.013f}, 0.02f);
        Runner runner(scene, settings);
        runner.run(30);
        const double way = runner.positions()[ball].x() + 0.3, free = 0.5 * (4 - 9 * double{friction}) * 0.25;
        std::printf("friction %.1f: slid by %.4f m\n", double{friction}, way);
        EXPECT_NEAR(way, std::max(0.0, free), 0.05 * std::max(0.0, free) + 1e-4);
    }
}

TEST(RestOfFaces, PartsByDefaultAndTouchesAsAnyOtherWhenItHasParted) {
    const float reach = 0.03f;
    for (const bool isKept : {false, true}) {
        Scene scene = weightless();
        addMeshCollider(scene, plate(0.5f, 12, 0.01f));
        const std::uint32_t ball = addBall(scene, {0, 0.8f * reach, 0.013f}, 0.02f);
        scene.particles[ball].keepsRest = isKept;
        scene.gravity = {0, -9.81f, 0};
        Runner runner(scene, settings);
        runner.run(60);
        EXPECT_NEAR(runner.positions()[ball].y(), (isKept ? 0.8 : 1.0) * double{reach}, 5e-3 * double{reach});
        for (int step = 0; step < 6; ++step) runner.step({.dt = 1.0f / 60, .gravity = {0, 9.81f, 0}});
        EXPECT_GT(runner.positions()[ball].y(), 1.1 * double{reach}) << "pulled away it is free";
        runner.run(90);
        EXPECT_NEAR(runner.positions()[ball].y(), double{reach}, 5e-3 * double{reach});
    }
}

// Points in front of and behind the surface of a voxel body do not move, and a load does not press them
// deeper, also with negative rest distances. The balls are small, so that the body's particles do not hold
// them.
TEST(RestOfFaces, HoldsWhatLiesBehindTheSurfaceOfSomethingSolid) {
    constexpr float small = 0.004f, reach = 0.3f * spacing + small;
    for (const float part : {0.5f, -0.1f, -0.9f}) {
        Block made = block({6, 4, 6});
        hold(made);
        const float top = 4 * spacing, y = top + part * reach;
        const std::array<Vec3, 3> places{Vec3{2.5f * spacing, y, 2.5f * spacing},
                                         Vec3{3.4f * spacing, y, 3.6f * spacing},
                                         Vec3{1.5f * spacing, y, 4.2f * spacing}};
        std::vector<std::uint32_t> balls;
        for (const Vec3& place : places) balls.push_back(addBall(made.scene, place, small, 1e-3f));
        expectStill(made.scene, settings, double{small}, 100,
                    "balls at " + std::to_string(part) + " of the reach above a surface");
        made.scene.gravity = {0, -98.1f, 0};
        made.scene.damping = 20;
        Runner runner(made.scene, {.substeps = 32, .contactRoom = 64}); // limits the sag of the body
        runner.run(20);
        const auto x = runner.positions();
        for (const std::uint32_t ball : balls) {
            const double deep = double{y} - x[ball].y() + sagBeside(made, x, ball).y();
            std::printf("at %.1f of the reach: %.4f of it deeper under 10 weights\n", double{part},
                        deep / double{reach});
            EXPECT_LT(deep, 0.05 * double{reach})
                << part; // relative to the surface, which bends between its corners
        }
    }
}

// Balls over steps of voxels with an inner edge at (edge, edge) in x and y. A point below the edge may have
// no face straight above it, or one with an equally near neighbour that has the point in front.
TEST(RestOfFaces, HoldsWhatLiesBehindAnInnerEdge) {
    constexpr float small = 0.004f, reach = 0.3f * spacing + small, edge = 3 * spacing, deep = 0.5f * reach;
    for (const float aside : {-1.0f, 0.0f, 0.02f, 0.1f}) { // in multiples of `deep`
        Block made = steps();
        const std::uint32_t ball =
            addBall(made.scene, {edge + aside * deep, edge - deep, 2.5f * spacing}, small, 1e-3f);
        expectStill(made.scene, settings, double{small}, 100,
                    "a ball behind an inner edge, aside by " + std::to_string(aside));
        hold(made);
        made.scene.gravity = {-3, -6, 0};
        made.scene.damping = 5;
        Runner runner(made.scene, settings);
        runner.run(60);
        const double start = aside < 0 ? std::sqrt(2.0) * double{deep} : double{deep};
        const double end = depthBehindStep(made, runner.positions(), ball, double{edge});
        std::printf("behind an inner edge, aside by %.2f of the depth: %.3f of the reach deep at first, %.3f "
                    "under load\n",
                    double{aside}, start / double{reach}, end / double{reach});
        EXPECT_LT(end, 1.03 * start) << aside;
    }
}

// A load presses a point from just in front of both faces of an inner edge to behind it.
TEST(RestOfFaces, HoldsWhatIsPressedBehindAnInnerEdge) {
    constexpr float small = 0.004f, reach = 0.3f * spacing + small, edge = 3 * spacing,
                    front = 0.004f * reach;
    Block made = steps();
    const std::uint32_t ball =
        addBall(made.scene, {edge + front, edge + front, 2.5f * spacing}, small, 1e-3f);
    holdTightly(made);
    made.scene.gravity = {-20, -20, 0};
    made.scene.damping = 5;
    Runner runner(made.scene, settings);
    double deepest = 0;
    for (int step = 0; step < 60; ++step) {
        runner.run(1);
        deepest = std::max(deepest, depthBehindStep(made, runner.positions(), ball, double{edge}));
    }
    std::printf("pressed behind an inner edge: %.4f of the reach deep\n", deepest / double{reach});
    EXPECT_LT(deepest, 0.1 * double{reach});
}

// A ball behind the top of one body and the bottom of another. The body into which a load presses it holds
// it.
TEST(RestOfFaces, HoldsWhatLiesBehindTwoBodies) {
    constexpr float small = 0.004f, reach = 0.3f * spacing + small, top = 3 * spacing, overlap = 0.6f * reach;
    for (const float down : {98.1f, -98.1f}) {
        Block made = block({6, 3, 6});
        const std::size_t lower = made.count;
        addLattice(made.scene, {.name = "upper",
                                .origin = {0.3f * spacing, top - overlap, 0.4f * spacing},
                                .cells = {6, 3, 6},
                                .spacing = spacing,
                                .youngModulus = 5e6f,
                                .radius = 0.3f * spacing});
        addSurfaceFaces(made.scene, made.scene.grids[1]);
        made.count = made.scene.particles.size();
        for (Particle& particle : made.scene.particles) particle.keepsRest = true;
        const float y = top - overlap / 2, highest = top - overlap + 3 * spacing;
        const std::uint32_t ball = addBall(made.scene, {2.6f * spacing, y, 2.7f * spacing}, small, 1e-3f);
        for (std::uint32_t i = 0; i < made.count; ++i) {
            const float height = made.scene.particles[i].position.y;
            if (height == 0 || height > highest - 0.01f) made.scene.fixed.push_back({i});
        }
        made.scene.gravity = {0, -down, 0};
        made.scene.damping = 20;
        Runner runner(made.scene, {.substeps = 32, .contactRoom = 64});
        runner.run(20);
        const auto x = runner.positions();
        const double sag = sagBeside(made, x, ball, down > 0 ? 0 : lower, down > 0 ? lower : made.count).y();
        const double deep = std::abs(x[ball].y() - double{y} - sag);
        std::printf("behind two bodies: %.4f of the reach deeper under a load of %.0f m/s^2\n",
                    deep / double{reach}, double{down});
        EXPECT_LT(deep, 0.1 * double{reach}) << down;
    }
}

// A ball moves to and fro over an edge of a body while pressed against it. Rest distances must stay those at
// load.
TEST(RestOfFaces, DoesNotWearAwayOverAnOuterEdge) {
    constexpr float small = 0.004f, reach = 0.3f * spacing + small, top = 4 * spacing, beside = 6 * spacing;
    for (const float part : {1.2f, 0.8f}) {
        Block made = block({6, 4, 6});
        holdTightly(made);
        const float start = part * reach;
        const double z = 2.7 * double{spacing}; // z stays constant
        const std::uint32_t ball =
            addBall(made.scene, {beside - 0.05f, top + start, 2.7f * spacing}, small, 1e-3f);
        Runner runner(made.scene, {.substeps = 8, .contactRoom = 64});
        const auto outward = [&](const Vector3d& x) {
            const Vector3d off = x - Vector3d(double{beside}, double{top}, x.z());
            if (off.x() < 0) return Vector3d(0, 1, 0);
            if (off.y() < 0) return Vector3d(1, 0, 0);
            return Vector3d(off.normalized());
        };
        const auto go = [&](double speed, double press,
                            int steps) { // moves over the edge if the speed is positive
            for (int step = 0; step < steps; ++step) {
                const Vector3d x = runner.positions()[ball], n = outward(x), along(n.y(), -n.x(), 0);
                const Vector3d v = runner.velocities()[ball];
                const Vector3d g = -press * n + 20 * (speed - v.dot(along)) * along - 5 * v.dot(n) * n -
                                   (200 * (x.z() - z) + 20 * v.z()) * Vector3d::UnitZ();
                runner.step({.dt = 1.0f / 120,
                             .gravity = {static_cast<float>(g.x()), static_cast<float>(g.y()),
                                         static_cast<float>(g.z())}});
            }
        };
        go(0, 100, 20);
        for (int swing = 0; swing < 6; ++swing) go(swing % 2 == 0 ? 0.3 : -0.3, 100, 60);
        go(0.3, 10, 60);
        go(0, 1, 60);
        const Vector3d x = runner.positions()[ball];
        const double gap = x.x() - double{beside}, rest = std::min(1.0, double{part}) * double{reach};
        std::printf("over an outer edge six times: %.4f of the reach beside it, at first %.2f\n",
                    gap / double{reach}, double{part});
        EXPECT_LT(x.y(), double{top} - 0.01) << "it is beside the body";
        EXPECT_NEAR(gap, rest, 0.02 * double{reach});
    }
}

// The ball may leave the body, and is then in front of its surface.
TEST(RestOfFaces, LetsOutWhatLiesBehind) {
    constexpr float small = 0.004f, reach = 0.3f * spacing + small;
    Block made = block({6, 4, 6});
    const float top = 4 * spacing;
    const std::uint32_t ball =
        addBall(made.scene, {2.5f * spacing, top - 0.5f * reach, 2.5f * spacing}, small, 1e-3f);
    hold(made);
    made.scene.gravity = {0, 9.81f, 0};
    made.scene.damping = 5;
    Runner runner(made.scene, {.substeps = 16, .contactRoom = 64});
    runner.run(12);
    EXPECT_GT(runner.positions()[ball].y(), double{top} + double{reach});
    for (int step = 0; step < 60; ++step) runner.step({.dt = 1.0f / 60, .gravity = {0, -9.81f, 0}});
    const auto x = runner.positions();
    const double sag = sagBeside(made, x, ball).y();
    EXPECT_NEAR(x[ball].y() - sag, double{top} + double{reach}, 0.05 * double{reach});
}

// Cloth of different thicknesses that overlaps a body.
TEST(RestOfFaces, KeepsClothInABody) {
    for (const float thickness : {0.01f, 0.03f}) {
        Scene scene = weightless();
        addLattice(scene, {.name = "body", .cells = {6, 3, 6}, .spacing = spacing, .radius = spacing / 2});
        const std::size_t body = scene.particles.size();
        const float reach = thickness / 2 + spacing / 2;
        addCloth(scene, {.origin = {-0.05f, 3 * spacing + 0.8f * reach, -0.05f},
                         .size = {12, 12},
                         .spacing = 0.035f,
                         .membraneStiffness = 50,
                         .thickness = thickness});
        for (std::size_t i = body; i < scene.particles.size(); ++i) scene.particles[i].keepsRest = true;
        expectStill(scene, settings, double{reach}, 100,
                    "cloth " + std::to_string(thickness) + " m thick in a body");
    }
}

// Sheets with edges that are nearer than their thickness.
TEST(RestOfEdges, KeepsCrossedSheets) {
    Scene scene = crossedSheets(0.15f);
    scene.gravity = {0, 0, 0};
    double gap = 1;
    const std::size_t half = scene.bodies[1].firstParticle;
    for (std::size_t i = half; i < scene.particles.size(); ++i)
        gap = std::min(gap, double{scene.particles[i].position.y} - double{scene.particles[0].position.y});
    const float thick = 2 * scene.faces[0].thickness;
    for (std::size_t i = half; i < scene.particles.size(); ++i)
        scene.particles[i].position.y -= static_cast<float>(gap) - 0.7f * thick;
    Scene parting = scene;
    for (Particle& particle : scene.particles) particle.keepsRest = true;
    ASSERT_TRUE(usesKernel(scene, "find_edge_contacts"));
    expectStill(scene, settings, double{thick} / 2, 100, "crossed sheets");
    Runner runner(parting, settings);
    runner.run(30);
    EXPECT_GT(moved(runner.positions(), parting), 0.05 * double{thick}) << "by default they part";
}

TEST(RestOfFaces, EndsInTheSameBitsForAnyMarginOrderAndForm) {
    Block made = block({6, 4, 6});
    hold(made);
    const float top = 4 * spacing;
    for (float n = 0; n < 12; ++n)
        addBall(made.scene,
                {(0.7f + 0.4f * n) * spacing, top + (0.01f - 0.002f * n), (0.9f + 0.37f * n) * spacing},
                0.004f, 1e-3f);
    made.scene.gravity = {3, -20, 1};
    made.scene.contacts.friction = 0.3f;
    addMeshCollider(made.scene, plate(0.2f, 5, 0.01f));
    const auto hash = [&](const Settings& s) { return hashOfRun(made.scene, s, 30); };
    Settings narrow = settings, reversed = settings, loads = settings;
    narrow.contactMargin = 0.2f;
    reversed.isReversed = true;
    loads.forms.usesTexels = false;
    const std::uint64_t first = hash(settings);
    std::printf("state_hash %016llx\n", static_cast<unsigned long long>(first));
    EXPECT_EQ(hash(narrow), first) << "another margin";
    EXPECT_EQ(hash(reversed), first) << "reversed";
    EXPECT_EQ(hash(loads), first) << "without texels";
}

// A rest distance that grew by one rounding a substep would have drifted by 0.5 mm in 4,000 substeps. The
// longer form of the test has 20,000.
TEST(RestOfFaces, DoesNotDriftInThousandsOfSubsteps) {
    const auto driftOf = [](const Scene& scene, std::size_t first, float aside) {
        Runner runner(scene, {.substeps = 100, .contactRoom = 64});
        int step = 0;
        const auto placesAfter = [&](int steps) { // one cycle has 40 steps
            for (const int end = step + steps; step < end; ++step)
                runner.step({.dt = scene.dt, .gravity = {step % 40 < 20 ? aside : -aside, -9.81f, 0}});
            return runner.positions();
        };
        const auto before = placesAfter(40), away = placesAfter(10),
                   after = placesAfter(test::isFull() ? 190 : 30);
        double drift = 0;
        for (std::size_t i = first; i < after.size(); ++i)
            drift = std::max(drift, std::abs(after[i].y() - before[i].y()));
        const double way = std::abs(away.back().x() - before.back().x());
        std::printf("%.1e m lower or higher, %.3f m to and fro\n", drift, way);
        if (aside > 0) {
            EXPECT_GT(way, 0.05) << "over several faces";
        }
        return drift;
    };
    const float small = 0.004f, reach = 0.3f * spacing + small;
    Block made = block({2, 2, 2});
    holdTightly(made);
    made.scene.contacts.friction = 0.8f;
    for (float n = 0; n < 6; ++n)
        addBall(made.scene,
                {(0.4f + 0.23f * n) * spacing, 2 * spacing + (0.9f - 0.31f * n) * reach,
                 (1.6f - 0.2f * n) * spacing},
                small, 1e-3f);
    EXPECT_LT(driftOf(made.scene, made.count, 0), 1e-5) << "in front of a surface, and behind it";
    Scene slope = weightless();
    addMeshCollider(slope, plate(0.25f, 6, 0.01f));
    slope.particles[addBall(slope, {0.01f, 0.8f * 0.03f, 0.013f}, 0.02f)].velocity.x = -2.0f / 3;
    EXPECT_LT(driftOf(slope, slope.particles.size() - 1, 4), 1e-5) << "from face to face";
}

// Rest distances survive an undone step, a saved state and a simulation with larger capacity, on both sides
// of faces.
TEST(RestOfFaces, IsRememberedAcrossStatesAndUndoneSteps) {
    Block made = block({4, 3, 4});
    hold(made);
    for (float n = 0; n < 6; ++n)
        addBall(
            made.scene,
            {(0.7f + 0.4f * n) * spacing, 3 * spacing + 0.003f * (2.5f - n), (0.9f + 0.37f * n) * spacing},
            0.004f, 1e-3f);
    made.scene.gravity = {1, -9.81f, 0};
    expectRemembered(made.scene, settings, 8);
}
