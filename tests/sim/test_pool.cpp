// Tests of bodies that enter and leave the world (Body::isAbsent).
#include "sim/program/program.hpp"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"
#include "sinew/events.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sinew::sim {
namespace {

using Eigen::Vector3d;

constexpr float radius = 0.04f;

void addBox(Scene& scene, Vec3 origin, bool hasFaces = true) {
    addLattice(
        scene,
        {.origin = origin, .cells = {3, 2, 4}, .spacing = 0.1f, .youngModulus = 1e5f, .radius = radius});
    if (hasFaces) addSurfaceFaces(scene, scene.grids.back());
}

constexpr std::uint32_t ofBox = 4 * 3 * 5;

void addSheet(Scene& scene, Vec3 origin, bool isPinned) {
    addCloth(scene,
             {.origin = origin,
              .right = {1, 0, 0},
              .down = {0, 0, 1},
              .size = {9, 9},
              .spacing = 0.1f,
              .areaDensity = 0.5f,
              .membraneStiffness = 5000,
              .thickness = radius,
              .pinned = isPinned ? std::vector<std::uint32_t>{0, 8, 72, 80} : std::vector<std::uint32_t>{}});
}

// A box on the floor below a hanging sheet.
Scene worldScene(bool hasFaces = true) {
    Scene scene;
    addBox(scene, {-0.1f, 0.05f, 0.2f}, hasFaces);
    if (hasFaces) addSheet(scene, {-0.4f, 0.6f, 0}, true);
    scene.planes.push_back({.normal = {0, 1, 0}, .friction = 0.4f});
    scene.contacts.friction = 0.4f;
    return scene;
}

// Then a box above it, a loose sheet above that, and a box aside: these three may be absent.
Scene stackScene(bool areAbsent, bool hasFaces = true) {
    Scene scene = worldScene(hasFaces);
    const std::size_t first = scene.bodies.size();
    addBox(scene, {-0.1f, 0.75f, 0.2f}, hasFaces);
    if (hasFaces) addSheet(scene, {-0.4f, 1.2f, 0}, false);
    addBox(scene, {2, 0.4f, 0}, hasFaces);
    for (std::size_t b = first; b < scene.bodies.size(); ++b) scene.bodies[b].isAbsent = areAbsent;
    return scene;
}

std::vector<Motion> spawns(std::initializer_list<std::uint32_t> bodies) {
    std::vector<Motion> motions;
    for (const std::uint32_t body : bodies) motions.push_back({.kind = MotionKind::spawn, .body = body});
    return motions;
}

Motion despawn(std::uint32_t body) {
    return {.kind = MotionKind::despawn, .body = body};
}

// Particles of a body.
std::vector<Vector3d> of(const Scene& scene, const std::vector<Vector3d>& x, std::size_t body) {
    const Body& one = scene.bodies[body];
    return {x.begin() + one.firstParticle, x.begin() + one.firstParticle + one.particleCount};
}

double heightOf(const std::vector<Vector3d>& x) {
    double sum = 0;
    for (const Vector3d& one : x) sum += one.y();
    return sum / static_cast<double>(x.size());
}

bool areAway(const std::vector<Vector3d>& x) {
    return std::ranges::all_of(
        x, [](const Vector3d& one) { return one == Vector3d::Constant(double{Motion::absentPlace}); });
}

constexpr Settings settings{.substeps = 16, .sleeps = false, .motions = 8};

Settings with(bool sleeps) {
    Settings result = settings;
    result.sleeps = sleeps;
    return result;
}

} // namespace

// The same scene with and without room for bodies: all bits of a run are equal.
TEST(Pool, ABodySpawnedAtOnceIsABodyOfTheScene) {
    for (const bool hasFaces : {false, true})
        for (const bool sleeps : {false, true}) {
            SCOPED_TRACE(std::to_string(hasFaces) + std::to_string(sleeps));
            test::Runner there(stackScene(false, hasFaces), with(sleeps)),
                spawned(stackScene(true, hasFaces), with(sleeps));
            const std::vector<Motion> motions = hasFaces ? spawns({2, 3, 4}) : spawns({1, 2});
            for (int s = 0; s < 45; ++s) {
                EXPECT_FALSE(there.step(Step{}).isUndone);
                EXPECT_FALSE(spawned.step(s == 0 ? Step{.motions = motions} : Step{}).isUndone);
                ASSERT_EQ(there.stateHash(), spawned.stateHash()) << s;
            }
        }
}

// Lists of contacts are made as often as without the absent bodies.
TEST(Pool, AbsentBodiesHaveNoListsMade) {
    for (const bool sleeps : {false, true}) {
        test::Runner without(worldScene(), with(sleeps)), beside(stackScene(true), with(sleeps));
        std::uint32_t few = 0, many = 0;
        for (int s = 0; s < 40; ++s) {
            few += without.step(Step{}).laterLists;
            many += beside.step(Step{}).laterLists;
        }
        std::printf("lists made after first substeps: %u without absent bodies, %u beside them\n", few, many);
        EXPECT_LE(many, few);
    }
}

// Absent bodies have no influence, nor had those that touched nothing while they were there.
TEST(Pool, ADespawnedBodyLeavesNoTrace) {
    for (const bool sleeps : {false, true}) {
        const Scene scene = stackScene(true);
        test::Runner never(scene, with(sleeps)), visited(scene, with(sleeps));
        const std::vector<Motion> in = spawns({4}), out{despawn(4)};
        for (int s = 0; s < 60; ++s) {
            never.step(Step{});
            visited.step(s == 10 ? Step{.motions = in} : s == 30 ? Step{.motions = out} : Step{});
            const auto a = never.positions(), b = visited.positions();
            for (std::size_t i = 0; i < scene.bodies[4].firstParticle; ++i)
                ASSERT_EQ(a[i], b[i]) << s << ' ' << i;
            EXPECT_EQ(areAway(of(scene, b, 4)), s < 10 || s >= 30);
            EXPECT_TRUE(areAway(of(scene, b, 2)));
        }
        EXPECT_EQ(never.stateHash(), visited.stateHash());
    }
}

// A body that comes late moves as one that was there from the start, up to rounding of sums.
TEST(Pool, ALateBodyFallsAsAnEarlyOne) {
    const Scene scene = stackScene(true);
    test::Runner early(scene, settings), late(scene, settings);
    const std::vector<Motion> motions{
        {.kind = MotionKind::spawn, .body = 4, .linear = {1, 0.5f, 0}, .rotation = {0, 0.6f, 0, 0.8f}},
        {.kind = MotionKind::setVelocity, .body = 4, .linear = {0.5f, 1, 0}, .angular = {0, 0, 2}}};
    early.step(Step{.motions = motions});
    for (int s = 0; s < 25; ++s) late.step(Step{});
    late.step(Step{.motions = motions});
    double most = 0;
    for (int s = 0; s < 20; ++s) {
        const auto a = of(scene, early.positions(), 4), b = of(scene, late.positions(), 4);
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
        early.step(Step{});
        late.step(Step{});
    }
    std::printf("late against early: %.1e m\n", most);
    EXPECT_LT(most, 1e-5); // 320 substeps with a rounding of 2.4e-7 each
}

// Bodies that sleep go with the step that is told to, also if nothing in the world is awake, and with any
// number of substeps.
TEST(Pool, SleepersGoAtOnce) {
    for (const bool hasContacts : {false, true})
        for (const bool hasMover : {false, true}) {
            SCOPED_TRACE(std::to_string(hasContacts) + std::to_string(hasMover));
            Scene scene{.gravity = {0, 0, 0}};
            addCloth(scene, {.size = {9, 9}, .spacing = 0.1f, .thickness = hasContacts ? radius : 0});
            scene.bodies[0].isAbsent = true;
            if (hasMover) {
                addCloth(scene, {.origin = {5, 0, 0}, .size = {16, 16}, .spacing = 0.1f});
                for (std::uint32_t i = 81; i < scene.particles.size(); ++i)
                    scene.particles[i].velocity = {0, 1, 0};
            }
            Settings odd = with(true);
            odd.substeps = 15;
            test::Runner runner(scene, odd);
            const std::vector<Motion> in = spawns({0}), out{despawn(0)};
            const auto step = [&](const std::vector<Motion>& motions) {
                return runner.step(Step{.gravity = scene.gravity, .motions = motions});
            };
            step(in);
            EXPECT_EQ(runner.run(50).sleeping, 81u);
            for (int s = 0; s < 6; ++s) {
                const Status status = step(s == 0 ? out : std::vector<Motion>{});
                EXPECT_EQ(status.sleeping, 0u) << s;
                EXPECT_TRUE(areAway(of(scene, runner.positions(), 0))) << s;
            }
            step(in);
            EXPECT_NEAR(of(scene, runner.positions(), 0)[0].x(), 0, 1e-6);
        }
}

// A body that lay on one that goes, or is placed anew, falls, also if it slept.
TEST(Pool, WhatLayOnABodyFalls) {
    for (const auto& [sleeps, isPlaced] : {std::pair{false, false}, {true, false}, {true, true}}) {
        Scene scene = stackScene(true, false);
        scene.bodies[1].isAbsent = false; // lies on box 3 soon
        addBox(scene, {-0.1f, 0.36f, 0.2f}, false);
        scene.bodies[3].isAbsent = true;
        scene.damping = 2;
        const Motion anew{.kind = MotionKind::spawn, .body = 3, .linear = {4, 0, 0}};
        const std::vector<Motion> in = spawns({3}), out{isPlaced ? anew : despawn(3)};
        test::Runner runner(scene, with(sleeps));
        runner.step(Step{.motions = in});
        Status status = runner.run(400);
        const double on = heightOf(of(scene, runner.positions(), 1));
        EXPECT_EQ(status.sleeping > 0, sleeps);
        runner.step(Step{.motions = out});
        status = runner.run(60);
        const double under = heightOf(of(scene, runner.positions(), 1));
        std::printf("sleeps %d, placed %d: %.3f m, then %.3f m\n", sleeps, isPlaced, on, under);
        EXPECT_LT(under, on - 0.15);
        if (!sleeps || isPlaced) continue;
        status = runner.run(400);
        EXPECT_EQ(status.sleeping, 2 * ofBox); // none of the absent ones
        runner.step(Step{.motions = in});
        status = runner.run(2);
        EXPECT_GT(heightOf(of(scene, runner.positions(), 3)), 0.1);
        EXPECT_LE(status.sleeping, 2 * ofBox);
    }
}

// An absent body touches nothing, also where a plane faces its place, and its contacts end when it goes.
TEST(Pool, EventsOfAbsentBodies) {
    for (const bool sleeps : {false, true}) {
        Scene scene;
        addBox(scene, {0, 0.05f, 0});
        scene.bodies[0].isAbsent = true;
        scene.planes = {{.normal = {0, 1, 0}, .friction = 0.4f}, {.normal = {0, -1, 0}, .offset = -5}};
        scene.damping = 2;
        Settings listing = with(sleeps);
        listing.events = contactEvents;
        test::Runner runner(scene, listing);
        std::vector<Event> all;
        std::uint32_t sleeping = 0;
        const auto play = [&](int steps, std::span<const Motion> motions) {
            for (int s = 0; s < steps; ++s) {
                const Status status = runner.step(s == 0 ? Step{.motions = motions} : Step{});
                const auto events = runner.simulation().events(status.frame).list;
                all.insert(all.end(), events.begin(), events.end());
                sleeping = status.sleeping;
            }
        };
        play(5, {});
        EXPECT_EQ(all.size(), 0u);
        const std::vector<Motion> in = spawns({0}), out{despawn(0)};
        play(200, in);
        EXPECT_EQ(sleeping > 0, sleeps);
        const auto count = [&](EventKind kind) {
            return std::ranges::count_if(
                all, [&](const Event& event) { return event.kind == kind && event.other == 0; });
        };
        const auto contacts = count(EventKind::contactBegins);
        EXPECT_EQ(all.size(), static_cast<std::size_t>(2 * contacts - 1)); // it may bounce
        EXPECT_EQ(count(EventKind::contactEnds), contacts - 1);
        play(5, out);
        EXPECT_EQ(count(EventKind::contactEnds), contacts);
        EXPECT_EQ(all.size(), static_cast<std::size_t>(2 * contacts));
    }
}

// Nothing reaches an absent body: no plane that has its place behind it, no collider there, no field, no
// motion; and it has no part in forces.
TEST(Pool, NothingReachesAnAbsentBody) {
    constexpr float away = Motion::absentPlace;
    Scene scene = stackScene(true);
    scene.planes.push_back({.normal = {0, -1, 0}, .offset = -5});
    scene.colliders.push_back({.radius = 5, .pose = {.position = {away, away - 3, away}}});
    Settings all = settings;
    all.keepsForces = true;
    all.fields = 3;
    all.hostColliders = 1;
    test::Runner runner(scene, all);
    const std::vector<ForceField> fields{{.vector = {3, 0, 1}},
                                         {.kind = FieldKind::wind, .vector = {8, 0, 0}, .strength = 0.6f},
                                         {.kind = FieldKind::radial, .center = {away, 0, 0}, .strength = 2}};
    const std::vector<Motion> pushes{{.linear = {0, 1, 0}}};
    const auto sizeOf = [](const Impulse& one) {
        return std::abs(one.linear.x) + std::abs(one.linear.y) + std::abs(one.linear.z);
    };
    for (int s = 0; s < 20; ++s) {
        const std::vector<HostCollider> ball{
            {.radius = 4, .pose = {.position = {away, away, away - 3 + 0.1f * static_cast<float>(s)}}}};
        const Status status = runner.step(Step{.hostColliders = ball, .fields = fields, .motions = pushes});
        const auto x = runner.positions();
        const Impulses impulses = runner.simulation().forces(status.frame);
        for (std::uint32_t b = 2; b < scene.bodies.size(); ++b) {
            EXPECT_TRUE(areAway(of(scene, x, b)));
            const BodyImpulses& got = impulses.bodies.at(b);
            EXPECT_EQ(sizeOf(got.contacts) + sizeOf(got.planes) + sizeOf(got.colliders), 0);
        }
        EXPECT_EQ(sizeOf(impulses.planes.at(1)), 0);
        EXPECT_EQ(sizeOf(impulses.colliders.at(0)) + sizeOf(impulses.hostColliders.at(0)), 0);
    }
}

// A grab that begins in the step of the spawn holds the body where it is spawned; one that lasts while the
// body leaves holds nothing after that.
TEST(Pool, AGrabHoldsABodyFromTheStepOfItsSpawn) {
    for (const bool sleeps : {false, true}) {
        Scene scene{.gravity = {0, 0, 0}};
        addBox(scene, {0, 0, 0}, false);
        addBox(scene, {3, 0, 0}, false);
        scene.bodies[1].isAbsent = true;
        Settings held = with(sleeps);
        held.grabs = 1;
        test::Runner runner(scene, held);
        const std::uint32_t chosen = scene.bodies[1].firstParticle;
        const Vec3 at = scene.particles[chosen].position, place{at.x, at.y + 1, at.z};
        const std::vector<Motion> in{{.kind = MotionKind::spawn, .body = 1, .linear = {0, 1, 0}}},
            out{despawn(1)};
        Grab grab{.particle = chosen, .radius = 0.25f, .target = place};
        const auto step = [&](std::span<const Motion> motions, bool isHeld) {
            runner.step(Step{.gravity = scene.gravity,
                             .grabs = isHeld ? std::span<const Grab>(&grab, 1) : std::span<const Grab>{},
                             .motions = motions});
            return of(scene, runner.positions(), 1)[0];
        };
        EXPECT_NEAR(step(in, true).y(), double{place.y}, 1e-5); // held where it is
        grab.target.x += 1;
        for (int s = 0; s < 60; ++s) step({}, true);
        EXPECT_NEAR(step({}, true).x(), double{grab.target.x}, 0.05);
        step(out, true);
        EXPECT_EQ(step({}, true).x(), double{Motion::absentPlace});
        EXPECT_NEAR(step(in, true).x(), double{at.x}, 1e-5);
        for (int s = 0; s < 30; ++s) step({}, true);
        EXPECT_NEAR(step({}, true).x(), double{at.x}, 1e-4);
    }
}

// Two steps after it left, no chunk of a lattice and no group of particles of an absent body runs.
TEST(Pool, AbsentBodiesAreLeftOut) {
    for (const bool sleeps : {false, true}) {
        Scene scene;
        addLattice(scene, {.cells = {9, 9, 9}, .spacing = 0.1f, .radius = radius});
        addLattice(scene, {.origin = {2, 0, 0}, .cells = {9, 9, 9}, .spacing = 0.1f, .radius = radius});
        addCloth(scene, {.origin = {4, 0, 0}, .size = {20, 20}, .spacing = 0.1f, .thickness = radius});
        scene.bodies[1].isAbsent = scene.bodies[2].isAbsent = true;
        test::Runner runner(scene, with(sleeps));
        const StepProgram& program = runner.simulation().program();
        const auto first = [&](const std::string& label, std::size_t word = 0) {
            for (std::uint32_t b = 0; b < program.buffers.size(); ++b)
                if (program.buffers[b].label == label)
                    return test::queue()
                        .download<std::uint32_t>(runner.simulation().view(BufferId{b}))
                        .at(word);
            return 0u;
        };
        const auto groupsOfParticles = [&] { return first("sleep.state", 6); }; // SleepState::listed
        const auto chunks = [&] { return first("pool.chunks[0].arguments"); };
        const std::vector<Motion> in = spawns({1, 2}), out{despawn(1), despawn(2)};
        runner.run(4);
        const std::uint32_t few = chunks(), fewGroups = groupsOfParticles();
        runner.step(Step{.motions = in});
        EXPECT_GT(chunks(), few);
        EXPECT_GT(groupsOfParticles(), fewGroups);
        runner.step(Step{.motions = out});
        runner.run(3);
        EXPECT_EQ(chunks(), few);
        EXPECT_EQ(groupsOfParticles(), fewGroups);
    }
}

// More chunks than a work group has, so that groups drop out, and reversed kernels begin at the other end.
TEST(Pool, ReversedKernelsHaveTheSameBits) {
    for (const bool sleeps : {false, true})
        for (const std::uint32_t columns : {0u, 1u}) {
            Scene scene;
            addLattice(scene, {.cells = {15, 15, 15}, .spacing = 0.05f, .radius = 0.02f});
            for (std::uint32_t b = 0; b < 6; ++b)
                addLattice(scene, {.origin = {2.0f + static_cast<float>(b), 0, 0},
                                   .cells = {9, 9, 9},
                                   .spacing = 0.05f,
                                   .radius = 0.02f});
            for (std::size_t b = 1; b < scene.bodies.size(); ++b) scene.bodies[b].isAbsent = true;
            scene.planes.push_back({.normal = {0, 1, 0}, .offset = -0.1f});
            std::vector<std::uint64_t> hashes;
            for (const bool isReversed : {false, true}) {
                Settings chosen = with(sleeps);
                chosen.substeps = 4;
                chosen.isReversed = isReversed;
                if (columns > 0) chosen.forms = {.columns = columns, .chunk = 1};
                test::Runner runner(scene, chosen);
                const Vector3d before = runner.positions().front();
                runner.run(6);
                EXPECT_LT(runner.positions().front().y(), before.y() - 0.01) << "it falls";
                const std::vector<Motion> in = spawns({1, 4}), out{despawn(1)};
                runner.step(Step{.motions = in});
                runner.run(4);
                runner.step(Step{.motions = out});
                runner.run(6);
                hashes.push_back(runner.stateHash());
            }
            EXPECT_EQ(hashes[0], hashes[1]) << sleeps << columns;
        }
}

// Particles of absent bodies have empty lists of pairs and faces, and are in no list of pairs.
TEST(Pool, ManyComeAndGo) {
    for (const bool sleeps : {false, true}) {
        Scene scene = stackScene(true);
        for (int k = 0; k < 4; ++k) {
            addBox(scene, {-1.5f, 0.4f, 0.6f * static_cast<float>(k)});
            scene.bodies.back().isAbsent = true;
        }
        Settings wide = with(sleeps);
        wide.contactRoom = 64;
        test::Runner runner(scene, wide);
        std::mt19937 random(7);
        std::uniform_real_distribution<float> at(-0.5f, 0.5f);
        std::vector<bool> isThere(scene.bodies.size(), true);
        for (std::size_t b = 2; b < isThere.size(); ++b) isThere[b] = false;
        int changes = 0;
        for (int s = 0; s < 80; ++s) {
            std::vector<Motion> motions;
            for (int k = 0; k < 4; ++k) {
                const auto b = static_cast<std::uint32_t>(2 + random() % (isThere.size() - 2));
                const bool comes = random() % 2 == 0;
                const Vec3 place{at(random), 1.5f + at(random), at(random)};
                if (comes)
                    motions.push_back({.kind = MotionKind::spawn, .body = b, .linear = place});
                else
                    motions.push_back(despawn(b));
                isThere[b] = comes;
                ++changes;
            }
            const Status status = runner.step(Step{.motions = motions});
            ASSERT_FALSE(status.isUndone) << s;
            const auto x = runner.positions();
            const auto w = runner.inverseMasses();
            for (std::size_t b = 2; b < isThere.size(); ++b) {
                EXPECT_EQ(areAway(of(scene, x, b)), !isThere[b]) << s << ' ' << b;
                EXPECT_EQ(w[scene.bodies[b].firstParticle] > 0, isThere[b]) << s << ' ' << b;
            }
            const StepProgram& program = runner.simulation().program();
            const auto lists = test::queue().download<std::array<std::uint32_t, 2>>(
                runner.simulation().view(program.contacts.pairLists));
            const auto points = test::queue().download<std::array<std::uint32_t, 2>>(
                runner.simulation().view(program.contacts.faceLists));
            std::vector<bool> isAbsent(lists.size());
            for (std::size_t b = 2; b < isThere.size(); ++b)
                for (std::uint32_t i = 0; !isThere[b] && i < scene.bodies[b].particleCount; ++i) {
                    const std::uint32_t slot = program.slots[scene.bodies[b].firstParticle + i];
                    isAbsent[slot] = true;
                    ASSERT_EQ(lists[slot][1], 0u);
                    ASSERT_EQ(points[slot][1], 0u);
                }
            const auto candidates = test::queue().download<std::array<std::uint32_t, 2>>( // slot, reach
                runner.simulation().view(program.contacts.pairs));
            for (const auto& [first, count] : lists)
                for (std::uint32_t c = first; c < first + count; ++c)
                    ASSERT_FALSE(isAbsent[candidates[c][0]]);
        }
        std::printf("%d spawns and despawns\n", changes);
    }
}

// A step that is undone takes its changes back.
TEST(Pool, AnUndoneStepTakesChangesBack) {
    for (const bool sleeps : {false, true}) {
        const Scene scene = stackScene(true);
        test::Runner runner(scene, with(sleeps)), other(scene, with(sleeps));
        const std::vector<Motion> in = spawns({2}), swap{despawn(2), spawns({4})[0]};
        for (test::Runner* one : {&runner, &other}) {
            one->step(Step{.motions = in});
            one->run(20);
        }
        const auto before = runner.positions();
        runner.writePosition(0, std::numeric_limits<float>::quiet_NaN());
        EXPECT_GT(runner.step(Step{.motions = swap}).nonFinite, 0u);
        EXPECT_EQ(runner.positions(), before);
        for (int s = 0; s < 30; ++s) {
            runner.step(s == 3 ? Step{.motions = swap} : Step{});
            other.step(s == 3 ? Step{.motions = swap} : Step{});
        }
        EXPECT_EQ(runner.stateHash(), other.stateHash());
    }
}

TEST(Pool, SavedStatesRememberWhoIsAbsent) {
    for (const bool sleeps : {false, true}) {
        const Scene scene = stackScene(true);
        test::Runner runner(scene, with(sleeps)), other(scene, with(sleeps));
        const std::vector<Motion> in = spawns({2, 4}), out{despawn(4)};
        runner.step(Step{.motions = in});
        runner.run(10);
        const auto saved = runner.save();
        runner.run(10);
        const std::uint64_t after = runner.stateHash();
        runner.step(Step{.motions = out});
        runner.load(saved);
        runner.run(10);
        EXPECT_EQ(runner.stateHash(), after);
        other.takeOver(runner);
        EXPECT_EQ(other.run(10).stepsUndone, 0u);
        runner.run(10);
        EXPECT_EQ(other.stateHash(), runner.stateHash());
    }
}

TEST(Pool, WrongBodiesAreRefused) {
    const Scene scene = stackScene(true);
    test::Runner runner(scene, settings);
    const auto faultOf = [&](const Motion& motion) {
        const char* fault = runner.simulation().faultOf(motion);
        return std::string(fault ? fault : "");
    };
    EXPECT_EQ(faultOf(despawn(2)), "");
    EXPECT_EQ(faultOf({.kind = MotionKind::spawn, .body = 4}), "");
    EXPECT_NE(faultOf(despawn(0)).find("does not let be absent"), std::string::npos);
    EXPECT_NE(faultOf({.kind = MotionKind::spawn, .body = 1}).find("does not let be absent"),
              std::string::npos);
    EXPECT_NE(faultOf(despawn(9)).find("does not exist"), std::string::npos);
    EXPECT_NE(faultOf(despawn(Motion::allBodies)).find("one whole"), std::string::npos);
    EXPECT_NE(faultOf({.kind = MotionKind::spawn, .body = 2, .rotation = {0, 0, 0, 2}}).find("unit length"),
              std::string::npos);
    const auto complaintOf = [](const Scene& bad, const Settings& chosen) {
        const std::vector<std::string> complaints = validate(bad, chosen);
        return complaints.empty() ? std::string() : complaints.front();
    };
    EXPECT_EQ(complaintOf(scene, settings), "");
    EXPECT_NE(complaintOf(scene, {.substeps = 16}).find("settings.motions"), std::string::npos);
    Scene bad = scene;
    bad.bodies[1].isAbsent = true;
    EXPECT_NE(complaintOf(bad, settings).find("fixed or driven"), std::string::npos);
    bad = stackScene(true, false);
    bad.grids.back().isCuttable = true;
    EXPECT_EQ(complaintOf(bad, settings), "");
    bad = stackScene(true, false);
    bad.distances.push_back({.a = 0, .b = bad.bodies[2].firstParticle, .restLength = 1});
    EXPECT_NE(complaintOf(bad, settings).find("is linked to what is not of it"), std::string::npos);
    bad = stackScene(true, false);
    bad.bodies[1].particleCount += 1;
    EXPECT_NE(complaintOf(bad, settings).find("shares a particle with another body"), std::string::npos);
    bad = stackScene(true, false);
    bad.skins.push_back(
        {.name = "skin", .triangles = {{0, 1, 2}}, .particles = {0, 1, bad.bodies[2].firstParticle}});
    EXPECT_NE(complaintOf(bad, settings).find("has a skin with what is not of it"), std::string::npos);
    bad = stackScene(true, false);
    bad.attachments.push_back({.particle = bad.bodies[2].firstParticle});
    EXPECT_NE(complaintOf(bad, settings).find("has an attachment"), std::string::npos);
}

} // namespace sinew::sim
