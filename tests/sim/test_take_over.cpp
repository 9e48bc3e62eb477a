// Tests of a simulation with other settings that takes over the state of one of the same scene.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/material.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr Solver everySolver[] = {Solver::split, Solver::jacobi, Solver::gaussSeidel};

Settings settingsOf(Solver solver, std::uint32_t substeps) {
    return {.solver = solver, .substeps = substeps, .iterations = solver == Solver::split ? 1u : 3u};
}

Scene swingingSheet() {
    Scene scene = test::sheet(10, 1e-5f);
    test::disturb(scene, 0, 0.5f);
    return scene;
}

double farthest(const test::Runner& a, const test::Runner& b) {
    const auto x = a.positions(), y = b.positions();
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - y[i]).norm());
    return most;
}

// The scene with the current positions and velocities.
Scene sceneAt(const Scene& scene, const test::Runner& runner) {
    Scene now = scene;
    const auto x = runner.positions(), v = runner.velocities();
    for (std::size_t i = 0; i < x.size(); ++i) {
        now.particles[i].position = test::toFloats(x[i]);
        now.particles[i].velocity = test::toFloats(v[i]);
    }
    return now;
}

} // namespace

TEST(TakeOver, ByAnotherSolverGoesOnAsASceneThatBeginsThere) {
    const Scene scene = swingingSheet();
    for (const Solver before : everySolver)
        for (const Solver after : everySolver) {
            if (before == after) continue;
            SCOPED_TRACE(::testing::PrintToString(before) + " to " + ::testing::PrintToString(after));
            test::Runner first(scene, settingsOf(before, 8)), second(scene, settingsOf(after, 12));
            first.run(15);
            second.run(3); // must leave no trace
            second.takeOver(first);
            EXPECT_EQ(farthest(first, second), 0);
            test::Runner anew(sceneAt(scene, first), settingsOf(after, 12));
            EXPECT_EQ(farthest(first, anew), 0);
            second.run(10);
            anew.run(10);
            EXPECT_EQ(second.stateHash(), anew.stateHash());
        }
}

TEST(TakeOver, ByABodyOnAGridFindsItsSlots) {
    for (const int boxes : {1, 2}) { // 1: computed slots, 2: listed slots
        Scene scene = test::block(4, 0.1f, 1e5f, 0.2f);
        if (boxes == 2)
            addLattice(scene,
                       {.origin = {1, 0.4f, 0}, .cells = {2, 3, 2}, .spacing = 0.1f, .youngModulus = 1e5f});
        test::Runner first(scene, settingsOf(Solver::jacobi, 8)), second(scene, settingsOf(Solver::split, 8));
        first.run(12);
        second.takeOver(first);
        EXPECT_EQ(farthest(first, second), 0);
        EXPECT_EQ(second.run(1).nonFinite, 0u);
        first.run(1);
        EXPECT_LT(farthest(first, second), 2e-3) << "a step on, the two solvers are near";
        EXPECT_GT(farthest(first, second), 0);
        for (const float w : second.inverseMasses()) EXPECT_GT(w, 0);
    }
}

// A sheet falls smoothly by its two corners, so that its motion hardly depends on substeps.
TEST(TakeOver, ByOtherSubstepsGoesOnWithoutAJolt) {
    const Scene scene = test::sheet(10, 1e-3f);
    for (const Solver solver : everySolver) {
        SCOPED_TRACE(::testing::PrintToString(solver));
        test::Runner first(scene, settingsOf(solver, 32)), second(scene, settingsOf(solver, 48)),
            still(scene, settingsOf(solver, 32));
        first.run(15);
        second.takeOver(first);
        still.takeOver(first);
        EXPECT_EQ(farthest(first, second), 0);
        first.run(2);
        EXPECT_EQ(second.run(2).nonFinite, 0u);
        const double way = farthest(first, still);
        EXPECT_GT(way, 0.05);
        EXPECT_LT(farthest(first, second), 0.05 * way) << "jacobi is softer with fewer substeps";
        EXPECT_GT(farthest(first, second), 0);
    }
}

TEST(TakeOver, BySubstepsThatAreTheSameHasTheSameBits) {
    const Scene scene = swingingSheet();
    for (const Solver solver : everySolver) {
        SCOPED_TRACE(::testing::PrintToString(solver));
        test::Runner first(scene, settingsOf(solver, 9)), second(scene, settingsOf(solver, 9));
        first.run(15);
        second.takeOver(first);
        first.run(5);
        second.run(5);
        EXPECT_EQ(second.stateHash(), first.stateHash());
    }
}

// Forms differ only in speed; another device may be faster with other forms.
TEST(TakeOver, ByOtherFormsHasTheSameBits) {
    Scene scene = test::block(4, 0.1f, 1e5f, 0.05f);
    scene.planes = {{.friction = 0.5f}};
    const Settings settings = settingsOf(Solver::split, 9);
    const Forms forms[] = {{.usesTexels = false},
                           {.columns = 1, .chunk = 3},
                           {.columns = 1, .chunk = 1},
                           {.residentBytes = test::device().limits().maxSharedMemory}};
    for (const Forms& before : forms)
        for (const Forms& after : forms) {
            Settings of = settings, other = settings;
            of.forms = before;
            other.forms = after;
            test::Runner first(scene, of), second(scene, other);
            first.run(15);
            second.takeOver(first);
            EXPECT_EQ(second.stateHash(), first.stateHash());
            first.run(5);
            second.run(5);
            EXPECT_EQ(second.stateHash(), first.stateHash());
        }
}

// A sheet with a sphere that passes through it on a path, by the time of the state.
TEST(TakeOver, OfAStateThatWasSavedGoesOnFromThat) {
    Scene scene = swingingSheet();
    scene.colliders = {
        {.radius = 0.2f,
         .path = {{0, {.position = {0.4f, -0.6f, 0.4f}}}, {1, {.position = {0.4f, 0.6f, 0.4f}}}}}};
    for (const Solver solver : everySolver) {
        SCOPED_TRACE(::testing::PrintToString(solver));
        test::Runner first(scene, settingsOf(solver, 9)), same(scene, settingsOf(solver, 9)),
            second(scene, settingsOf(solver, 9)), other(scene, settingsOf(solver, 14));
        first.run(15);
        same.run(15);
        const test::Runner::Saved saved = first.save();
        first.run(20);
        const std::uint64_t after = first.stateHash();
        for (test::Runner* next : {&second, &other}) {
            next->run(2); // must leave no trace
            next->takeOverByHost(first, &saved);
            EXPECT_EQ(next->stateHash(), same.stateHash());
        }
        EXPECT_EQ(first.stateHash(), after) << "it stands where it stood";
        EXPECT_NE(after, same.stateHash());
        same.run(10);
        second.run(10);
        other.run(10);
        EXPECT_EQ(second.stateHash(), same.stateHash());
        EXPECT_NE(other.stateHash(), same.stateHash()) << "with other substeps";
        const test::Runner::Saved again = second.save();
        second.run(3);
        second.load(again);
        EXPECT_EQ(second.stateHash(), same.stateHash());
    }
}

TEST(TakeOver, ByWayOfTheHostHasTheSameBits) {
    Scene scene = test::block(3, 0.1f, 1e5f, 0.05f);
    scene.planes = {{.friction = 0.5f}};
    Settings settings = settingsOf(Solver::split, 8);
    settings.sleeps = true;
    settings.grabs = 2;
    test::Runner first(scene, settings);
    first.run(20);
    for (const Solver after : {Solver::split, Solver::jacobi}) {
        Settings other = settingsOf(after, 10);
        other.grabs = 2;
        other.sleeps = after == Solver::split;
        test::Runner direct(scene, other), byHost(scene, other);
        direct.takeOver(first);
        byHost.takeOverByHost(first);
        direct.run(7);
        byHost.run(7);
        EXPECT_EQ(direct.stateHash(), byHost.stateHash());
        EXPECT_LT(farthest(direct, byHost), 1e-9);
    }
}

TEST(TakeOver, KeepsCutsAndTakesAnotherMaterial) {
    const Scene scene = test::cuttableSheet();
    test::Runner first(scene, settingsOf(Solver::split, 8));
    EXPECT_GT(first.cut(test::bladeAcrossSheet()).linksCut, 0u);
    first.run(2);
    const Scene soft = withMaterial(scene, {.stiffness = 0.3f});
    test::Runner second(soft, settingsOf(Solver::split, 20));
    second.takeOver(first);
    const Status status = second.run(3);
    EXPECT_EQ(status.pieces, 2u);
    EXPECT_GT(status.linksCutInAll, 0u);
    test::Runner made(soft, settingsOf(Solver::split, 20));
    made.cut(test::bladeAcrossSheet());
    made.run(5);
    EXPECT_LT(farthest(second, made), 1e-5);
}

namespace {

const std::string goesOn = "nothing was refused";

// Message of the error if a simulation of `to` takes over from one of `from`, or goesOn.
std::string refusedTakeOver(const Scene& from, const Scene& to, const Settings& before,
                            const Settings& after) {
    test::Runner first(from, before), second(to, after);
    first.run(1);
    second.run(2);
    const std::uint64_t hash = second.stateHash();
    const std::string checked = test::refusal([&] { second.simulation().checkTakeOver(first.simulation()); });
    EXPECT_EQ(second.stateHash(), hash) << "a check records nothing";
    const std::string said = test::refusal([&] { second.takeOver(first); });
    EXPECT_EQ(checked, said);
    EXPECT_EQ(second.stateHash() == hash, said != goesOn) << "what is refused records nothing";
    return said;
}

} // namespace

TEST(TakeOver, OfAnotherSceneIsRefusedInASentence) {
    const Settings settings = settingsOf(Solver::split, 4);
    Scene scene = test::block(3, 0.1f, 1e5f, 0.05f);
    scene.planes = {{.offset = -1}};
    scene.colliders = {{.radius = 0.1f, .pose = {{3, 0, 0}, {}}}};
    const auto refused = [&](const std::function<void(Scene&)>& change) {
        Scene other = scene;
        change(other);
        return refusedTakeOver(scene, other, settings, settings);
    };
    EXPECT_EQ(refused([](Scene&) {}), goesOn);
    EXPECT_EQ(refused([](Scene& other) { other = withMaterial(other, {.stiffness = 0.5f}); }), goesOn);
    const std::pair<const char*, std::function<void(Scene&)>> others[] = {
        {"a corner 5 cm higher", [](Scene& other) { other.particles[0].position.y += 0.05f; }},
        {"another mass", [](Scene& other) { other.particles[0].inverseMass *= 2; }},
        {"a floor lower", [](Scene& other) { other.planes[0].offset -= 0.1f; }},
        {"a collider elsewhere", [](Scene& other) { other.colliders[0].pose.position.x += 1; }},
        {"one that moves",
         [](Scene& other) {
             other.colliders[0].path = {{0, {{3, 0, 0}, {}}}, {1, {{3, 1, 0}, {}}}};
         }},
        {"what is held", [](Scene& other) { other.fixed = {{.particle = 0}}; }},
        {"a body that may be cut", [](Scene& other) { other.grids[0].isCuttable = true; }},
        {"a body that tears",
         [](Scene& other) {
             other.grids[0].isCuttable = true;
             other.grids[0].tearStrain = 0.5f;
         }},
        {"one that floats above planes", [](Scene& other) { other.particles[0].contactOffset = 0.05f; }},
        {"wider particles", [](Scene& other) { other.particles[0].radius = 0.04f; }},
        {"debris that is removed", [](Scene& other) { other.debris = 3; }},
        {"another way of an attachment", [](Scene& other) { other.attachments = {{.particle = 3}}; }}};
    for (const auto& [name, change] : others) {
        SCOPED_TRACE(name);
        EXPECT_NE(refused(change).find("of one scene"), std::string::npos);
    }
    const std::string counted = refusedTakeOver(test::chain(6), test::chain(7), settings, settings);
    EXPECT_NE(counted.find("6 particles, this one has 7"), std::string::npos) << counted;
}

TEST(TakeOver, WithLessRoomForContactsIsRefused) {
    Scene scene = test::chain(6);
    for (Particle& particle : scene.particles) particle.radius = 0.01f;
    Settings before = settingsOf(Solver::split, 4), after = before;
    before.contactRoom = 32;
    after.contactRoom = 31;
    const std::string said = refusedTakeOver(scene, scene, before, after);
    EXPECT_NE(said.find("contactRoom is 31"), std::string::npos) << said;
    EXPECT_EQ(refusedTakeOver(scene, scene, after, before), goesOn);
}

// The results of completed steps are kept when they leave the ring of steps in flight.
TEST(TakeOver, AfterMoreUndoneStepsThanAreInFlightGoesOnFromTheLastGoodOne) {
    Scene scene = test::particleAt({0, 1, 0});
    scene.colliders.push_back({.shape = ColliderShape::sphere,
                               .radius = 0.1f,
                               .path = {{.time = 0, .pose = {.position = {5, 0, 0}}},
                                        {.time = 10, .pose = {.position = {5, 10, 0}}}}});
    for (const std::uint32_t inFlight : {1u, 4u}) {
        const Settings settings{.substeps = 4, .framesInFlight = inFlight};
        test::Runner first(scene, settings), second(scene, settings);
        first.run(10);
        for (std::uint32_t i = 0; i < inFlight + 2; ++i) {
            first.writePosition(0, std::numeric_limits<float>::quiet_NaN());
            EXPECT_GT(first.run(1).nonFinite, 0u);
        }
        second.takeOver(first);
        second.run(1);
        EXPECT_NEAR(double{second.simulation().colliderPoses()[0].position.y}, 11 * double{scene.dt}, 1e-5)
            << inFlight;
    }
}
