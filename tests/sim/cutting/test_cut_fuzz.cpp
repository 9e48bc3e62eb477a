// Fuzz test: random strokes through 20 bodies (boxes, meshes and sheets), at rest and moving, with and
// without contacts between pieces. Every stroke is checked (stroke_check). By default a few strokes go
// through every fifth body. SINEW_STROKES=50 takes 50 through each, 1,000 in all; SINEW_SEED=2 takes other
// strokes; SINEW_BODY=6 takes only that body.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/cutting/stroke_check.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "vk/allocator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::StrokeCheck;
using test::StrokeResult;
using test::Sweep;

namespace {

constexpr float spacing = 0.05f;

class Numbers {
public:
    explicit Numbers(std::uint32_t seed) : bits_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0;
    }
    std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(bits_() % count); }
    Vector3d inCube() {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        return {x, y, z};
    }
    Vector3d direction() {
        Vector3d v = inCube();
        while (v.norm() > 1 || v.norm() < 0.1) v = inCube();
        return v.normalized();
    }

private:
    std::mt19937 bits_;
};

std::uint32_t setting(const char* name, std::uint32_t otherwise) {
    const char* text = std::getenv(name);
    return text ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

Scene boxScene(const Lattice& lattice) {
    Scene scene{.name = lattice.name, .gravity = {0, 0, 0}};
    Lattice cuttable = lattice;
    cuttable.spacing = spacing;
    cuttable.isCuttable = true;
    addLatticeSkin(scene, cuttable, addLattice(scene, cuttable), {0.7f, 0.2f, 0.1f});
    return scene;
}

Scene meshScene(const char* shape, std::uint32_t resolution, bool isTouched) {
    Scene scene{.name = shape, .gravity = {0, 0, 0}};
    mesh::MeshBody body{
        .name = shape, .youngModulus = 1e5f, .touchesParticles = isTouched, .isCuttable = true};
    body.voxels.resolution = resolution;
    mesh::addMesh(scene, mesh::generate(shape, 24), body);
    return scene;
}

Scene sheetScene(ClothSheet sheet) {
    Scene scene{.name = "sheet", .gravity = {0, 0, 0}};
    sheet.size = {14, 11};
    sheet.spacing = spacing;
    sheet.membraneStiffness = 100;
    sheet.isCuttable = true;
    addCloth(scene, sheet);
    return scene;
}

std::vector<Scene> bodies() {
    std::vector<Scene> scenes;
    std::vector<float> fill(5 * 5 * 5, 1);
    for (const std::size_t hole : {62u, 63u, 31u, 7u, 100u, 124u}) fill[hole] = 0;
    scenes.push_back(boxScene({.name = "cube", .cells = {5, 5, 5}}));
    scenes.push_back(boxScene({.name = "touching", .cells = {4, 6, 4}, .radius = spacing / 2}));
    scenes.push_back(boxScene({.name = "with holes", .cells = {5, 5, 5}, .fill = fill}));
    scenes.push_back(
        boxScene({.name = "keeps volume", .cells = {3, 7, 4}, .poissonRatio = 0.4f, .recovery = 2}));
    scenes.push_back(boxScene({.name = "26 links", .cells = {4, 4, 5}, .hasBodyDiagonals = true}));
    for (const bool isTouched : {false, true}) {
        scenes.push_back(meshScene("sphere", 8, isTouched));
        scenes.push_back(meshScene("torus_knot", 16, isTouched));
        scenes.push_back(meshScene("organ", 11, isTouched));
        scenes.push_back(meshScene("tube", 14, isTouched));
        scenes.push_back(meshScene("slab_with_hole", 13, isTouched));
    }
    scenes.push_back(sheetScene({}));
    scenes.push_back(sheetScene({.bendingStiffness = 1e-4f}));
    scenes.push_back(sheetScene({.radius = 0.3f * spacing}));
    scenes.push_back(sheetScene({.skipStiffness = 30, .bendingStiffness = 1e-4f}));
    scenes.push_back(sheetScene({.thickness = 0.4f * spacing}));
    for (std::size_t s = 0; s < scenes.size(); ++s) scenes[s].name.append(" ").append(std::to_string(s));
    return scenes;
}

// Gives every second body drift, rotation and strain, by up to a third of a cell a step.
void setMoving(Scene& scene, Numbers& numbers, double cell) {
    const Vector3d drift = 4 * cell * numbers.direction(), turn = 2 * numbers.direction();
    const double stretch = numbers.between(-1, 1);
    for (Particle& particle : scene.particles) {
        const Vector3d x = test::toVector(particle.position);
        particle.velocity = test::toFloats(drift + turn.cross(x) + stretch * Vector3d(x.x(), -x.y(), 0));
    }
    scene.damping = 0;
}

void add(Sweep& sweep, const Vector3d& from, const Vector3d& to) {
    sweep.from.push_back(test::toFloats(from));
    sweep.to.push_back(test::toFloats(to));
}

// A random stroke: a square of one quad, three quads with bends, a lattice plane through a particle, or the
// last stroke slightly shifted.
Sweep randomStroke(Numbers& numbers, const std::vector<Vector3d>& x, double cell, const Sweep& last) {
    const double kind = numbers.between(0, 1);
    Sweep sweep;
    if (kind < 0.1 && !last.from.empty()) {
        const Vector3d shift = numbers.between(0.05, 0.5) * cell * numbers.direction();
        for (std::size_t p = 0; p < last.from.size(); ++p)
            add(sweep, test::toVector(last.from[p]) + shift, test::toVector(last.to[p]) + shift);
        return sweep;
    }
    const Vector3d middle = x[numbers.below(x.size())] + (kind < 0.3 ? 0 : 1) * cell * numbers.inCube();
    Vector3d normal = numbers.direction();
    if (kind < 0.3) {
        do normal = {numbers.below(4) - 1.0, numbers.below(4) - 1.0, numbers.below(4) - 1.0};
        while (normal.norm() == 0);
        normal.normalize();
    }
    const double reach = numbers.between(1, 6) * cell, roll = numbers.between(0, 6.3);
    const Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
    const Vector3d u = std::cos(roll) * first + std::sin(roll) * second, v = normal.cross(u);
    const int quads = kind > 0.8 ? 3 : 1;
    for (int p = 0; p <= quads; ++p) {
        const Vector3d on = middle + reach * (2.0 * p / quads - 1) * u;
        const double bend = quads > 1 ? 0.2 * reach : 0;
        add(sweep, on - reach * v + bend * numbers.inCube(), on + reach * v + bend * numbers.inCube());
    }
    return sweep;
}

struct Summary {
    std::size_t triangles = 0, crowded = 0, pieces = 0, links = 0;
    double volumeError = 0, momentumError = 0, milliseconds = 0;
    void count(const StrokeResult& result) {
        triangles = std::max(triangles, result.triangles);
        crowded = std::max(crowded, result.crowdedEdges);
        pieces = result.status.pieces;
        links = result.live;
        volumeError = std::max(volumeError, std::abs(result.volumeError));
        momentumError = std::max(momentumError, result.momentumError);
        milliseconds += result.milliseconds;
    }
};

void cutAtRandom(Scene scene, std::uint32_t seed, bool isMoving, std::uint32_t strokes) {
    Numbers numbers(seed);
    const double cell = double{scene.grids.at(0).restLength[0]};
    if (isMoving) setMoving(scene, numbers, cell);
    StrokeCheck check(scene, {.substeps = 4, .contactRoom = 64}, true);
    const std::size_t links = check.body().links().size();
    const auto before = test::device().allocator().statistics();
    Summary summary;
    Sweep last;
    for (std::uint32_t s = 0; s < strokes; ++s) {
        check.run(static_cast<int>(numbers.below(3)));
        last = randomStroke(numbers, check.body().runner().positions(), cell, last);
        const std::string what =
            scene.name + ", seed " + std::to_string(seed) + ", stroke " + std::to_string(s + 1);
        StrokeResult result = check.stroke(last.blade(), what);
        check.checkSurface(result, what);
        summary.count(result);
        if (testing::Test::HasFailure()) return; // later failures would only repeat it
    }
    const auto after = test::device().allocator().statistics();
    EXPECT_EQ(after.used, before.used) << "memory";
    EXPECT_EQ(after.buffers, before.buffers) << "memory";
    std::printf("%-18s %4zu particles, %5zu of %5zu links, %4zu pieces, %6zu triangles, %4zu crowded edges, "
                "volume %.1e, "
                "momentum %.1e, %5.2f ms a stroke\n",
                scene.name.c_str(), scene.particles.size(), summary.links, links, summary.pieces,
                summary.triangles, summary.crowded, summary.volumeError, summary.momentumError,
                summary.milliseconds / strokes);
}

} // namespace

TEST(CutFuzz, RandomStrokesThroughTwentyBodiesLeaveAllAsItMustBe) {
    const std::uint32_t all = setting("SINEW_STROKES", 0), seed = setting("SINEW_SEED", 1), every = 20,
                        only = setting("SINEW_BODY", every);
    const std::vector<Scene> scenes = bodies();
    ASSERT_EQ(scenes.size(), 20u);
    ASSERT_LE(only, every) << "SINEW_BODY";
    for (std::uint32_t b = 0; b < scenes.size(); ++b)
        if (only == every ? all > 0 || b % 5 == 2 : b == only)
            cutAtRandom(scenes[b], 1000 * seed + b, b % 2 == 1, all > 0 ? all : 6);
}
