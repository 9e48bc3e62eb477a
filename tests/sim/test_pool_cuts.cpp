// Tests of bodies that may be cut and enter and leave the world (Body::isAbsent): they come back whole.
#include "common/layout.h"
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/pool_rounds.hpp"
#include "sinew/bodies.hpp"
#include "sinew/events.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace sinew::sim {
namespace {

using Eigen::Vector3d;
using test::Runner;
using test::Sweep;
using test::sweepOf;

constexpr float radius = 0.02f;
constexpr std::uint32_t box = 1, sheet = 2, organ = 3; // bodies that may be absent

void addBox(Scene& scene, Vec3 origin) {
    const Lattice lattice{.origin = origin,
                          .cells = {4, 2, 3},
                          .spacing = 0.05f,
                          .youngModulus = 1e5f,
                          .poissonRatio = 0.4f,
                          .radius = radius,
                          .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {});
    addSurfaceFaces(scene, scene.grids.back());
}

// A box that stays, and aside from it a box, a sheet with bends, and a mesh, which may be absent.
Scene poolScene(bool areAbsent, float tearStrain = 0) {
    Scene scene;
    addBox(scene, {0, 0.03f, 0});
    addBox(scene, {1, 0.03f, 0});
    addCloth(scene, {.origin = {2, 0.1f, 0},
                     .right = {1, 0, 0},
                     .down = {0, 0, 1},
                     .size = {9, 9},
                     .spacing = 0.05f,
                     .areaDensity = 0.5f,
                     .membraneStiffness = 5000,
                     .skipStiffness = 50,
                     .thickness = radius,
                     .isCuttable = true,
                     .tearStrain = tearStrain});
    mesh::TriangleMesh ball = mesh::generate("sphere", 12);
    for (Vec3& x : ball.positions) x = {0.2f * x.x + 3, 0.2f * x.y + 0.3f, 0.2f * x.z};
    mesh::MeshBody body{.youngModulus = 1e5f, .touchesParticles = true, .isCuttable = true};
    body.voxels.resolution = 6;
    mesh::addMesh(scene, ball, body);
    for (std::size_t b = 1; b < scene.bodies.size(); ++b) scene.bodies[b].isAbsent = areAbsent;
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.4f});
    scene.debris = 5;
    return scene;
}

Settings settingsFor(bool sleeps) {
    return {.substeps = 6, .sleeps = sleeps, .grabs = 1, .motions = 4};
}

std::vector<Motion> motions(MotionKind kind) {
    return {{.kind = kind, .body = box}, {.kind = kind, .body = sheet}, {.kind = kind, .body = organ}};
}

// A stroke through all bodies, that of a corner of a body, and one below the middle of all of them.
Sweep stroke(int which) {
    switch (which) {
    case 0:
        return sweepOf({{1.5, 0.1, 0.08}, Vector3d(0.02, 0.1, 1).normalized()}, 3, 2);
    case 1:
        return sweepOf({{1.02, 0.05, 0.02}, Vector3d(1, 1, 1).normalized()}, 0.08);
    default:
        return sweepOf({{3, 0.3, 0.02}, Vector3d(1, 0.3, 0.2).normalized()}, 0.5);
    }
}

// The drawn triangles: places and normals of their corners.
std::vector<layout::SkinVertex> drawnOf(Runner& runner) {
    runner.skin();
    const Simulation& simulation = runner.simulation();
    const auto read = [](const vk::BufferView& view) { return test::queue().download<std::uint32_t>(view); };
    std::vector<layout::SkinVertex> drawn;
    const auto add = [&](const vk::BufferView& vertices, const vk::BufferView& indices, std::uint32_t first,
                         std::uint32_t count) {
        const auto all = test::queue().download<layout::SkinVertex>(vertices);
        const auto corners = read(indices);
        for (std::uint32_t k = first; k < first + count; ++k) drawn.push_back(all.at(corners.at(k)));
    };
    for (const SkinRange& skin : simulation.skins())
        add(simulation.skinVertices(), simulation.skinIndices(), skin.firstIndex, skin.indexCount);
    const auto addDraws = [&](const vk::BufferView& vertices, const vk::BufferView& indices,
                              const vk::BufferView& draws) {
        const auto words = read(draws);
        for (std::size_t d = 0; d + 5 <= words.size(); d += 5) add(vertices, indices, words[d + 2], words[d]);
    };
    addDraws(simulation.skinVertices(), simulation.skinIndices(), simulation.pieceDraws());
    const CutSurface cut = simulation.cutSurface();
    addDraws(cut.vertices, cut.indices, cut.draws);
    return drawn;
}

bool areEqual(const std::vector<layout::SkinVertex>& a, const std::vector<layout::SkinVertex>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

Status cut(Runner& runner, const Sweep& sweep, std::span<const Motion> motions = {}) {
    Step step{.motions = motions};
    step.blade = sweep.blade();
    return runner.step(step);
}

void cutAll(Runner& runner) {
    for (int which = 0; which < 3; ++which) cut(runner, stroke(which));
    runner.run(3);
}

} // namespace

TEST(PoolCuts, ABodySpawnedAtOnceIsCutAsOneOfTheScene) {
    for (const bool sleeps : {false, true}) {
        Runner there(poolScene(false), settingsFor(sleeps)), spawned(poolScene(true), settingsFor(sleeps));
        const auto in = motions(MotionKind::spawn);
        EXPECT_EQ(there.step(Step{}).pieces, 4u);
        EXPECT_EQ(spawned.step(Step{.motions = in}).pieces, 4u);
        for (int s = 0; s < 14; ++s) {
            const bool cuts = s % 3 == 2 && s < 9;
            const Status a = cuts ? cut(there, stroke(s / 3)) : there.step(Step{}),
                         b = cuts ? cut(spawned, stroke(s / 3)) : spawned.step(Step{});
            ASSERT_FALSE(a.isUndone);
            ASSERT_EQ(there.stateHash(), spawned.stateHash()) << s;
            EXPECT_EQ(a.pieces, b.pieces);
            EXPECT_EQ(a.linksCutInAll, b.linksCutInAll);
        }
        EXPECT_TRUE(areEqual(drawnOf(there), drawnOf(spawned)));
    }
}

// Bodies that were cut and came back have the bits of those that come for the first time: as they are, where
// the same stroke cuts them, also in the step of the spawn, and in any order of invocations.
TEST(PoolCuts, ABodyThatWasCutComesBackWhole) {
    for (const bool sleeps : {false, true}) { // then they are placed anew, and may tear
        SCOPED_TRACE(sleeps);
        const Scene scene = poolScene(true, sleeps ? 4.0f : 0.0f);
        Settings reversed = settingsFor(sleeps);
        reversed.isReversed = !sleeps;
        Runner first(scene, settingsFor(sleeps)), again(scene, reversed);
        const auto in = motions(MotionKind::spawn), out = motions(MotionKind::despawn);
        for (const bool cutsAtOnce : {false, true}) {
            again.step(Step{.motions = in});
            first.run(1);
            for (Runner* one : {&first, &again}) cutAll(*one); // also a box that stays
            if (!sleeps) {
                first.run(1);
                again.step(Step{.motions = out});
            }
            std::vector<Status> last;
            for (Runner* one : {&first, &again}) {
                last.push_back(cutsAtOnce ? cut(*one, stroke(2), in) : one->step(Step{.motions = in}));
                one->run(3);
            }
            EXPECT_EQ(last[0].pieces, last[1].pieces);
            EXPECT_EQ(last[0].linksCut, last[1].linksCut);
            EXPECT_EQ(last[0].linksCutInAll, last[1].linksCutInAll);
            EXPECT_EQ(last[0].debrisParticles, last[1].debrisParticles);
            ASSERT_EQ(first.stateHash(), again.stateHash());
            EXPECT_TRUE(areEqual(drawnOf(first), drawnOf(again)));
            for (Runner* one : {&first, &again}) cutAll(*one);
            ASSERT_EQ(first.stateHash(), again.stateHash());
            EXPECT_TRUE(areEqual(drawnOf(first), drawnOf(again)));
            for (Runner* one : {&first, &again}) one->step(Step{.motions = out});
        }
    }
}

// Pieces, fragments, cut surfaces and skins of a body that goes are gone with it; those of others stay.
TEST(PoolCuts, PiecesGoWithTheirBody) {
    const Scene scene = poolScene(true);
    Runner runner(scene, settingsFor(false)), alone(scene, settingsFor(false));
    EXPECT_EQ(runner.step(Step{}).pieces, 1u);
    const auto in = motions(MotionKind::spawn), out = motions(MotionKind::despawn);
    EXPECT_EQ(runner.step(Step{.motions = in}).pieces, 4u);
    alone.run(2);
    for (int which = 0; which < 3; ++which) cut(alone, stroke(which));
    for (int which = 0; which < 3; ++which) cut(runner, stroke(which));
    const Status parted = runner.run(1);
    EXPECT_GE(parted.pieces, 8u);
    EXPECT_GT(parted.debris, 0u);
    alone.run(1);
    const Status gone = runner.step(Step{.motions = out}), own = alone.run(1);
    EXPECT_EQ(gone.pieces, own.pieces);
    EXPECT_EQ(gone.debris, own.debris);
    EXPECT_EQ(gone.debrisMass, own.debrisMass);
    EXPECT_EQ(gone.linksCutInAll, own.linksCutInAll);
    EXPECT_GT(own.linksCutInAll, 0u);
    EXPECT_EQ(runner.stateHash(), alone.stateHash());
    EXPECT_TRUE(areEqual(drawnOf(runner), drawnOf(alone)));
    constexpr float away = Motion::absentPlace;
    std::size_t there = 0;
    for (const layout::SkinVertex& one : drawnOf(runner)) {
        ASSERT_TRUE(std::isfinite(one.position.x) && std::isfinite(one.normal.x));
        const auto isNear = [](float x) { return std::abs(x - away) <= 0.25f; }; // four roundings of a cell
        const bool isAway = isNear(one.position.x) && isNear(one.position.y) && isNear(one.position.z);
        ASSERT_TRUE(isAway || one.position.x < 1) << one.position.x;
        there += isAway ? 0 : 1;
    }
    EXPECT_GT(there, 0u);
    EXPECT_EQ(cut(runner, stroke(0)).linksCut, cut(alone, stroke(0)).linksCut);
}

// A body begins each life in one piece: pieces of the one before are no event of the next, and none is lost.
TEST(PoolCuts, EventsAreThoseOfOneLife) {
    Settings settings = settingsFor(false);
    settings.events = bitOf(EventKind::pieces);
    Runner runner(poolScene(true), settings);
    const auto eventsOf = [&](const Status& status) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found; // body, pieces
        for (const Event& event : runner.simulation().events(status.frame).list)
            if (event.body != 0) found.emplace_back(event.body, event.count); // body 0 stays
        return found;
    };
    const auto in = motions(MotionKind::spawn), out = motions(MotionKind::despawn);
    runner.step(Step{.motions = in});
    const auto first = eventsOf(cut(runner, stroke(0)));
    EXPECT_FALSE(first.empty());
    for (const bool goes : {true, false}) { // then it is placed anew
        if (goes) {
            EXPECT_TRUE(eventsOf(runner.step(Step{.motions = out})).empty());
        }
        EXPECT_TRUE(eventsOf(runner.step(Step{.motions = in})).empty());
        EXPECT_EQ(eventsOf(cut(runner, stroke(0))), first) << goes;
    }
    EXPECT_EQ(eventsOf(cut(runner, stroke(0), in)), first) << "in the step of the spawn";
}

// Links of the solver's state and all that follows from them are as before an undone step, after it.
TEST(PoolCuts, AnUndoneStepBringsCutsBack) {
    for (const bool sleeps : {false, true}) {
        const Scene scene = poolScene(true);
        Runner runner(scene, settingsFor(sleeps)), other(scene, settingsFor(sleeps));
        const auto in = motions(MotionKind::spawn);
        for (const MotionKind kind : {MotionKind::spawn, MotionKind::despawn}) {
            SCOPED_TRACE(std::to_string(sleeps) + std::to_string(static_cast<int>(kind)));
            const auto change = motions(kind);
            for (Runner* one : {&runner, &other}) {
                one->reset();
                one->step(Step{.motions = in});
                cutAll(*one);
            }
            const auto before = drawnOf(runner);
            runner.writePosition(0, std::numeric_limits<float>::quiet_NaN());
            EXPECT_GT(runner.step(Step{.motions = change}).nonFinite, 0u);
            EXPECT_TRUE(areEqual(drawnOf(runner), before));
            for (int s = 0; s < 8; ++s) {
                const Status a = s == 4 ? cut(runner, stroke(2)) : runner.step(Step{}),
                             b = s == 4 ? cut(other, stroke(2)) : other.step(Step{});
                EXPECT_EQ(a.pieces, b.pieces);
                EXPECT_EQ(a.linksCutInAll, b.linksCutInAll);
                EXPECT_EQ(a.debrisParticles, b.debrisParticles);
                ASSERT_EQ(runner.stateHash(), other.stateHash()) << s;
            }
            EXPECT_TRUE(areEqual(drawnOf(runner), drawnOf(other)));
        }
    }
}

TEST(PoolCuts, SavedStatesKeepCuts) {
    const Scene scene = poolScene(true);
    Runner runner(scene, settingsFor(false)), other(scene, settingsFor(false));
    const auto in = motions(MotionKind::spawn), out = motions(MotionKind::despawn);
    runner.step(Step{.motions = in});
    cutAll(runner);
    const auto saved = runner.save();
    runner.run(4);
    const std::uint64_t after = runner.stateHash();
    const auto drawn = drawnOf(runner);
    runner.step(Step{.motions = out});
    const auto absent = runner.save();
    runner.run(2);
    const std::uint64_t without = runner.stateHash();
    const auto empty = drawnOf(runner);
    runner.load(saved);
    const Status status = runner.run(4);
    EXPECT_EQ(runner.stateHash(), after);
    EXPECT_TRUE(areEqual(drawnOf(runner), drawn));
    other.takeOver(runner);
    EXPECT_EQ(other.run(4).pieces, status.pieces);
    runner.run(4);
    EXPECT_EQ(other.stateHash(), runner.stateHash());
    other.load(absent);
    other.run(2);
    EXPECT_EQ(other.stateHash(), without);
    EXPECT_TRUE(areEqual(drawnOf(other), empty));
}

// measure_pool plays 10,000 rounds, and looks at the memory of the process.
TEST(PoolCuts, CountsDoNotDriftInRounds) {
    test::PoolRounds rounds(test::device(), test::queue());
    std::optional<test::PoolCounts> first;
    std::uint32_t cut = 0;
    for (std::uint32_t round = 0; round < 100; ++round) {
        cut += rounds.play(round);
        if (round % 20 != 3) continue; // the same bodies have just left
        if (!first) first = rounds.counts();
        ASSERT_EQ(rounds.counts(), *first) << round;
    }
    EXPECT_EQ(first->pieces + first->deadLinks + first->fragments, 0u);
    EXPECT_GT(cut, 1000u);
    EXPECT_EQ(rounds.stepsUndone(), 0u);
}

} // namespace sinew::sim
