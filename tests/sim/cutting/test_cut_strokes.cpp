// Tests of slow strokes, like those of a user: many steps through bodies that are held at one end, hang, bend
// and gape meanwhile. They must separate a body as one fast step does.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"
#include "sinew/bodies.hpp"
#include "support/full.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::Sweep;

namespace {

// Fixes particles with x below `low` or above `high`.
void hold(Scene& scene, double low, double high = 1e9) {
    for (Particle& particle : scene.particles)
        if (double{particle.position.x} < low || double{particle.position.x} > high) particle.inverseMass = 0;
}

Scene beam(double high = 1e9) {
    constexpr float spacing = 0.05f;
    Scene scene{.name = "beam", .gravity = {0, -9.81f, 0}, .damping = 2};
    addLattice(scene, {.cells = {14, 6, 6}, .spacing = spacing, .youngModulus = 6e4f, .isCuttable = true});
    hold(scene, 0.5 * double{spacing}, high);
    return scene;
}

Scene meshBody(const char* shape, std::uint32_t resolution, double low, double high = 1e9,
               float youngModulus = 6e4f) {
    Scene scene{.name = shape, .gravity = {0, -9.81f, 0}, .damping = 2};
    mesh::MeshBody body{.name = shape, .youngModulus = youngModulus, .isCuttable = true};
    body.voxels.resolution = resolution;
    mesh::addMesh(scene, mesh::generate(shape, 16), body);
    hold(scene, low, high);
    return scene;
}

// Result of a stroke.
struct Outcome {
    std::vector<std::size_t> sizes; // of pieces, largest first
    std::size_t dead = 0;           // number of links
    std::size_t openEdges = 0;      // of the surface, if any
    std::uint64_t hash = 0;
    std::size_t particles() const { return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}); }
};

Outcome outcomeOf(CutBody& body, std::size_t links) {
    Outcome outcome;
    for (const std::uint32_t size : body.pieceSizes())
        if (size > 0) outcome.sizes.push_back(size);
    std::ranges::sort(outcome.sizes, std::greater<>());
    outcome.dead = links - body.links().size();
    outcome.hash = body.runner().stateHash();
    if (body.runner().simulation().cutSurface().vertices.size > 0)
        outcome.openEdges = test::ClosedSurface(body).openEdges();
    EXPECT_EQ(body.oneSided(), 0u);
    EXPECT_EQ(body.looseLinks(), 0u);
    EXPECT_EQ(body.pieces(), body.expectedPieces());
    return outcome;
}

// A plane x = at + slant (y + z).
struct Plane {
    double at = 0, slant = 0;
};

double extremeHeight(const std::vector<Vector3d>& positions, double sign) {
    double height = -1e9;
    for (const Vector3d& x : positions) height = std::max(height, sign * x.y());
    return sign * height;
}

// Lowest height of the piece that is connected to held particles.
double lowestHeld(CutBody& body, const Scene& scene) {
    const std::vector<std::uint32_t> pieces = body.pieces();
    const std::vector<Vector3d> positions = body.runner().positions();
    std::set<std::uint32_t> held;
    for (std::size_t p = 0; p < pieces.size(); ++p)
        if (scene.particles[p].inverseMass == 0) held.insert(pieces[p]);
    double lowest = 1e9;
    for (std::size_t p = 0; p < pieces.size(); ++p)
        if (held.contains(pieces[p])) lowest = std::min(lowest, positions[p].y());
    return lowest;
}

// Moves a blade along z down in `plane` through a body that has hung for five frames, at a speed that would
// pass it in `steps` steps. The body sinks meanwhile, so the blade continues until no held part is below it.
Outcome strokeDown(const Scene& scene, int steps, const Plane& plane, bool isReversed = false) {
    CutBody body(scene, {.substeps = 8, .isReversed = isReversed});
    const std::size_t links = body.links().size();
    body.runner().run(5);
    const double beyond = 1.3 * body.spacing(), top = extremeHeight(body.runner().positions(), 1) + beyond,
                 way = top + beyond - extremeHeight(body.runner().positions(), -1);
    const auto edge = [&](int step) {
        const double y = top - way * step / steps;
        const auto point = [&](double z) { return test::toFloats({plane.at + plane.slant * (y + z), y, z}); };
        return std::vector<Vec3>{point(-1), point(1)};
    };
    const auto isThrough = [&](int step) {
        return step > steps && double{edge(step - 1).front().y} <= lowestHeld(body, scene) - beyond;
    };
    const int most = steps == 1 ? 1 : 10 * steps;
    for (int s = 1; s <= most && !isThrough(s); ++s) {
        const Sweep sweep{.from = edge(s - 1), .to = edge(s), .isCarried = s > 1};
        EXPECT_EQ(body.cut(sweep).nonFinite, 0u);
    }
    return outcomeOf(body, links);
}

struct Case {
    const char* name;
    Scene scene;
    Plane plane;
    std::vector<int> steps;
    bool hangs = false;     // hangs so far that another part of it is below the blade
    bool hasDebris = false; // a mesh: also leaves fragments in one step
    double most = 1.5;      // largest number of dead links, over that of one step
};

} // namespace

// Bodies held at one end hang, swing and gape; those held at both ends only gape. Regression test: links that
// saw the blade's old edge at different places left up to 74 links across such cuts, and one piece.
TEST(SlowStroke, PartsABodyAsOneStepDoes) {
    const Case cases[] = {
        {"beam", beam(), {0.22}, {1, 30}, true},
        {"beam along a layer", beam(), {0.2}, {1, 30}, true},
        {"beam, slanted", beam(), {0.2, 0.2}, {1, 15, 60}},
        {"bridge", beam(0.64), {0.22}, {1, 30, 120}, false, false, 1},
        {"bridge along a layer", beam(0.64), {0.2}, {1, 30, 120}},
        {"sphere", meshBody("sphere", 10, -0.08), {0.01}, {1, 15, 60}},
        {"sphere, slanted", meshBody("sphere", 10, -0.08), {0.01, 0.2}, {1, 30, 60}},
        {"organ", meshBody("organ", 24, -0.08, 0.08, 3e5f), {0.02}, {1, 30, 60}, false, true},
        {"knot", meshBody("torus_knot", 24, -0.08, 0.08, 1e6f), {0}, {1, 60}, false, true}};
    for (const Case& each : cases) {
        Outcome once;
        for (const int steps : each.steps) {
            const bool isBetween = steps != each.steps.front() && steps != each.steps.back();
            if (isBetween && !test::isFull()) continue;
            const Outcome outcome = strokeDown(each.scene, steps, each.plane);
            ASSERT_GE(outcome.sizes.size(), 2u) << each.name << " in " << steps << " steps";
            if (steps == 1) once = outcome;
            const std::size_t debris = outcome.particles() - outcome.sizes[0] - outcome.sizes[1];
            std::printf("%s, %d steps: %zu links dead, pieces of %zu and %zu, %zu debris of %zu particles\n",
                        each.name, steps, outcome.dead, outcome.sizes[0], outcome.sizes[1],
                        outcome.sizes.size() - 2, debris);
            EXPECT_LE(debris, each.hasDebris ? once.particles() / 100 : 0);
            EXPECT_LE(static_cast<double>(outcome.dead), each.most * static_cast<double>(once.dead));
            EXPECT_EQ(outcome.openEdges, 0u);
            EXPECT_GT(outcome.sizes[1], each.hangs ? 20 : once.sizes[1] * 9 / 10) << "where the blade was";
        }
    }
}

TEST(SlowStroke, HasTheSameBitsInReversedOrder) {
    const Scene scene = meshBody("sphere", 10, -0.08);
    const Outcome one = strokeDown(scene, 5, {0.01}), other = strokeDown(scene, 5, {0.01}, true);
    EXPECT_EQ(one.hash, other.hash);
    EXPECT_EQ(one.sizes, other.sizes);
}
