// A person cuts slowly: strokes of many steps through bodies that are held at one end, hang down, bend and
// gape meanwhile. They must part a body as one step would.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/bodies.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/closed_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::Sweep;

namespace {

// What is beyond `held` along -x never moves.
void hold(Scene& scene, double held) {
    for (Particle& particle : scene.particles)
        if (double{particle.position.x} < held) particle.inverseMass = 0;
}

Scene beam() {
    constexpr float spacing = 0.05f;
    Scene scene{.name = "beam", .gravity = {0, -9.81f, 0}, .damping = 2};
    addLattice(scene, {.cells = {14, 6, 6}, .spacing = spacing, .youngModulus = 6e4f, .isCuttable = true});
    hold(scene, 0.5 * double{spacing});
    return scene;
}

Scene sphere() {
    Scene scene{.name = "sphere", .gravity = {0, -9.81f, 0}, .damping = 2};
    mesh::MeshBody body{.name = "sphere", .youngModulus = 6e4f, .isCuttable = true};
    body.voxels.resolution = 10;
    mesh::addMesh(scene, mesh::generate("sphere", 16), body);
    hold(scene, -0.08);
    return scene;
}

// What a stroke left.
struct Outcome {
    std::vector<std::uint32_t> sizes; // of pieces, largest first
    std::size_t dead = 0;             // links
    std::size_t openEdges = 0;        // of the surface, where there is one
    std::uint64_t hash = 0;
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

// A blade along z comes down through the whole body in the plane x = `at` in `steps` steps, once the body has
// hung for five; in more than one it goes on below, since what is cut sinks.
Outcome strokeDown(const Scene& scene, int steps, double at, bool isReversed = false) {
    CutBody body(scene, {.substeps = 8, .isReversed = isReversed});
    const std::size_t links = body.links().size();
    body.runner().run(5);
    double top = -1e9, bottom = 1e9;
    for (const Vector3d& x : body.runner().positions()) {
        top = std::max(top, x.y());
        bottom = std::min(bottom, x.y());
    }
    const double beyond = 1.3 * body.spacing(), way = bottom - top - (steps == 1 ? 2 : 7) * beyond;
    const auto edge = [&](int step) {
        const double y = top + beyond + way * step / steps;
        return std::vector<Vec3>{test::toFloats({at, y, -1}), test::toFloats({at, y, 1})};
    };
    for (int s = 1; s <= steps; ++s) {
        const Sweep sweep{.from = edge(s - 1), .to = edge(s), .isCarried = s > 1};
        EXPECT_EQ(body.cut(sweep).nonFinite, 0u);
    }
    return outcomeOf(body, links);
}

struct Case {
    const char* name;
    Scene scene;
    double at;
    std::vector<int> steps;
};

} // namespace

// Links that saw the blade's old edge each elsewhere left up to 74 of them across such cuts, and one piece.
TEST(SlowStroke, PartsABodyAsOneStepDoes) {
    const Case cases[] = {{"beam", beam(), 0.22, {1, 30}},
                          {"beam along a layer", beam(), 0.2, {1, 30}},
                          {"sphere", sphere(), 0.01, {1, 15, 60}}};
    for (const Case& each : cases) {
        std::uint32_t least = 0;
        for (const int steps : each.steps) {
            const Outcome outcome = strokeDown(each.scene, steps, each.at);
            std::printf("%s, %d steps: %zu links dead, %zu open edges, %zu pieces of %u and %u\n", each.name,
                        steps, outcome.dead, outcome.openEdges, outcome.sizes.size(), outcome.sizes.front(),
                        outcome.sizes.back());
            EXPECT_EQ(outcome.sizes.size(), 2u);
            EXPECT_EQ(outcome.openEdges, 0u);
            if (steps == 1) least = outcome.sizes.back();
            EXPECT_GT(outcome.sizes.back(), least * 4 / 5) << "where the blade was";
        }
    }
}

TEST(SlowStroke, HasTheSameBitsInReversedOrder) {
    const Scene scene = sphere();
    const Outcome one = strokeDown(scene, 5, 0.01), other = strokeDown(scene, 5, 0.01, true);
    EXPECT_EQ(one.hash, other.hash);
    EXPECT_EQ(one.sizes, other.sizes);
}
