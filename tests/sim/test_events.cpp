// Tests of the events of a step: each kind once and when it happens, the same for every form and order, and
// not a bit of the motion for them.
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/compile/compile.hpp"
#include "sim/core/hash.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim/world_play.hpp"
#include "sinew/bodies.hpp"
#include "sinew/events.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>

using namespace sinew;
using namespace sinew::sim;

namespace {

using Kind = EventKind;
using Partner = EventPartner;

// An event and the step in which it happened.
struct Timed {
    std::uint64_t step;
    Event event;
    bool operator==(const Timed&) const = default;
};

void PrintTo(const Timed& timed, std::ostream* stream) {
    const Event& event = timed.event;
    *stream << "step " << timed.step << ": kind " << static_cast<int>(event.kind) << " body " << event.body
            << " partner " << static_cast<int>(event.partner) << " " << event.other << " count "
            << event.count;
}

std::vector<Timed> eventsOf(Simulation& simulation, std::uint64_t frame) {
    const Events events = simulation.events(frame);
    EXPECT_TRUE(events.isFinished);
    EXPECT_EQ(events.lost, 0u);
    std::vector<Timed> timed;
    for (const Event& event : events.list) timed.push_back({frame, event});
    return timed;
}

std::vector<Timed> run(test::Runner& runner, int steps, const Step& step = {}) {
    std::vector<Timed> all;
    for (int s = 0; s < steps; ++s) {
        const Status status = runner.step(step);
        EXPECT_FALSE(status.isUndone);
        for (const Timed& timed : eventsOf(runner.simulation(), status.frame)) all.push_back(timed);
    }
    return all;
}

std::vector<Timed> ofKind(const std::vector<Timed>& all, Kind kind) {
    std::vector<Timed> some;
    std::ranges::copy_if(all, std::back_inserter(some),
                         [&](const Timed& one) { return one.event.kind == kind; });
    return some;
}

Settings listing(std::uint32_t kinds = allEvents, std::uint32_t substeps = 16) {
    return {.substeps = substeps, .events = kinds};
}

// One body a ball.
void addBall(Scene& scene, const Vec3& position, const Vec3& velocity = {}, float radius = 0.1f) {
    scene.bodies.push_back({"ball", static_cast<std::uint32_t>(scene.particles.size()), 1});
    scene.particles.push_back(
        {.position = position, .velocity = velocity, .contactOffset = radius, .radius = radius});
}

Scene weightless() {
    return {.name = "weightless", .gravity = {0, 0, 0}};
}

Lattice blockAt(const Vec3& origin) {
    return {.name = "block",
            .origin = origin,
            .cells = {3, 3, 3},
            .spacing = 0.1f,
            .youngModulus = 1e5f,
            .radius = 0.05f};
}

void addCuttableBlock(Scene& scene) {
    Lattice lattice = blockAt({0, 0, 0});
    lattice.isCuttable = true;
    addLattice(scene, lattice);
}

// Blocks that meet, and a ball on the way of both; a plane below.
Scene meeting() {
    Scene scene{.name = "meeting"};
    addLattice(scene, blockAt({0, 0.3f, 0}));
    addLattice(scene, blockAt({0.06f, 0.72f, 0.03f}));
    addBall(scene, {0.15f, 1.3f, 0.15f});
    for (std::uint32_t i = 64; i < 128; ++i) scene.particles[i].velocity = {0, -2, 0};
    scene.planes = {{.friction = 0.4f}};
    scene.colliders = {{.radius = 0.2f, .pose = {.position = {0.9f, 0.2f, 0.1f}}}};
    scene.contacts.friction = 0.4f;
    return scene;
}

} // namespace

TEST(Events, ABallOnAPlaneBeginsOnceAndEndsWhenItLeaves) {
    for (const Solver solver : {Solver::split, Solver::jacobi, Solver::gaussSeidel}) {
        SCOPED_TRACE(static_cast<int>(solver));
        Scene scene{.name = "ball"};
        addBall(scene, {0, 0.3f, 0});
        scene.planes = {{.normal = {1, 0, 0}, .offset = -5}, {}};
        Settings settings = listing();
        settings.solver = solver;
        test::Runner runner(scene, settings);
        const std::vector<Timed> falls = run(runner, 60);
        ASSERT_EQ(falls.size(), 1u);
        const Event begin{Kind::contactBegins, Partner::plane, 0, 1, 1};
        EXPECT_EQ(falls[0].event, begin);
        EXPECT_NEAR(static_cast<double>(falls[0].step), 60 * std::sqrt(2 * 0.2 / 9.81), 1.5); // free fall
        const std::vector<Timed> rises = run(runner, 20, {.gravity = {0, 5, 0}});
        ASSERT_EQ(rises.size(), 1u);
        const Event end{Kind::contactEnds, Partner::plane, 0, 1, 0};
        EXPECT_EQ(rises[0].event, end);
        // 2 mm take 0.028 s, and the end is told in the second step without a contact.
        EXPECT_NEAR(static_cast<double>(rises[0].step), 63, 1);
    }
}

// Within one step the ball meets the plane and leaves it.
TEST(Events, ABounceBetweenTwoSubstepsIsAContact) {
    Scene scene = weightless();
    addBall(scene, {0, 0.25f, 0}, {0, -18, 0});
    scene.planes = {{.restitution = 1}};
    test::Runner runner(scene, listing());
    const std::vector<Timed> all = run(runner, 5);
    EXPECT_GT(runner.positions()[0].y(), 1.0);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0], (Timed{0, {Kind::contactBegins, Partner::plane, 0, 0, 1}}));
    EXPECT_EQ(all[1], (Timed{2, {Kind::contactEnds, Partner::plane, 0, 0, 0}}));
}

TEST(Events, TwoBlocksMeetAndPart) {
    Scene scene = weightless();
    addLattice(scene, blockAt({0, 0, 0}));
    addLattice(scene, blockAt({0.5f, 0, 0}));
    for (std::uint32_t i = 64; i < 128; ++i) scene.particles[i].velocity = {-2, 0, 0};
    test::Runner runner(scene, listing());
    const std::vector<Timed> all = run(runner, 60);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].event.kind, Kind::contactBegins);
    EXPECT_EQ(all[0].event.partner, Partner::body);
    EXPECT_EQ(all[0].event.body, 0u);
    EXPECT_EQ(all[0].event.other, 1u);
    EXPECT_GE(all[0].event.count, 1u);
    EXPECT_LE(all[0].event.count, 16u); // 4 x 4 particles face as many
    EXPECT_NEAR(static_cast<double>(all[0].step), 60 * 0.1 / 2, 1.5);
    EXPECT_EQ(all[1].event.kind, Kind::contactEnds);
    EXPECT_GT(all[1].step, all[0].step + 1);
}

TEST(Events, CollidersAndHostCollidersAreTold) {
    Scene scene = weightless();
    addBall(scene, {0, 0, 0}, {1, 0, 0});
    scene.colliders = {{.radius = 0.1f, .pose = {.position = {5, 0, 0}}},
                       {.radius = 0.1f, .pose = {.position = {0.5f, 0, 0}}}};
    Settings settings = listing();
    settings.hostColliders = 2;
    test::Runner runner(scene, settings);
    const std::vector<HostCollider> hands{{.radius = 0.1f, .pose = {.position = {0, 3, 0}}},
                                          {.radius = 0.1f, .pose = {.position = {0.1f, 0.19f, 0}}}};
    const std::vector<Timed> all = run(runner, 30, {.gravity = {}, .hostColliders = hands});
    const std::vector<Timed> begins = ofKind(all, Kind::contactBegins);
    ASSERT_EQ(begins.size(), 2u);
    EXPECT_EQ(begins[0].event,
              (Event{Kind::contactBegins, Partner::hostCollider, 0, 1, begins[0].event.count}));
    EXPECT_EQ(begins[1].event.partner, Partner::collider);
    EXPECT_EQ(begins[1].event.other, 1u);
}

// A block on a mesh, and two sheets that cross: contacts with faces, and between edges.
TEST(Events, FacesAndEdgesAreContactsToo) {
    Scene block{.name = "block", .damping = 20}; // it would bounce
    addMeshCollider(block, {.name = "mesh",
                            .vertices = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}},
                            .triangles = {{0, 2, 1}, {0, 3, 2}},
                            .thickness = 0.01f});
    addLattice(block, blockAt({0, 0.15f, 0}));
    for (const Scene& scene : {block, test::crossedSheets(0.25f)}) {
        SCOPED_TRACE(scene.name);
        ASSERT_EQ(scene.bodies.size(), 2u);
        test::Runner runner(scene, listing(contactEvents));
        const std::vector<Timed> all = run(runner, 60);
        const std::vector<Timed> begins = ofKind(all, Kind::contactBegins);
        EXPECT_EQ(all.size(), 1u) << "it stays";
        ASSERT_EQ(begins.size(), 1u);
        EXPECT_EQ(begins[0].event.partner, Partner::body);
        EXPECT_EQ(begins[0].event.body, 0u);
        EXPECT_EQ(begins[0].event.other, 1u);
        EXPECT_GE(begins[0].event.count, 1u);
    }
}

TEST(Events, ACutIsToldWithTheLinksAndThePieces) {
    Scene scene = weightless();
    scene.planes = {{.offset = -9}};
    addBall(scene, {5, 5, 5});
    addCuttableBlock(scene);
    test::Runner runner(scene, listing(cutEvents));
    EXPECT_TRUE(run(runner, 2).empty());
    const test::Sweep half = test::sweepOf({{0.15, 0.15, 0.15}, {1, 0, 0}}, 1);
    const Status first = runner.cut(half.blade());
    ASSERT_EQ(first.pieces, 2u);
    EXPECT_EQ(eventsOf(runner.simulation(), first.frame),
              (std::vector<Timed>{{2, {Kind::cut, Partner::none, 1, 0, first.linksCut}},
                                  {2, {Kind::pieces, Partner::none, 1, 0, 2}}}));
    EXPECT_TRUE(run(runner, 2).empty());
    const test::Sweep quarter = test::sweepOf({{0.15, 0.15, 0.15}, {0, 1, 0}}, 1);
    const Status second = runner.cut(quarter.blade());
    ASSERT_EQ(second.pieces, 4u);
    EXPECT_EQ(eventsOf(runner.simulation(), second.frame).back().event.count, 4u);
}

// Pieces of 16 of 64 particles are removed; the number of pieces stays while another one is there.
TEST(Events, RemovedFragmentsAreToldOnceAndAgainAfterAnUndo) {
    Scene scene = weightless();
    scene.debris = 17;
    addBall(scene, {5, 5, 5});
    addCuttableBlock(scene);
    test::Runner runner(scene, listing(cutEvents));
    run(runner, 1);
    const vk::Buffer whole = runner.saveTopology();
    const test::Sweep low = test::sweepOf({{0.05, 0.15, 0.15}, {1, 0, 0}}, 1),
                      high = test::sweepOf({{0.25, 0.15, 0.15}, {1, 0, 0}}, 1),
                      middle = test::sweepOf({{0.15, 0.15, 0.15}, {0, 1, 0}}, 1);
    const auto cut = [&](const test::Sweep& sweep) {
        const Status status = runner.cut(sweep.blade());
        std::vector<Event> events;
        for (const Timed& timed : eventsOf(runner.simulation(), status.frame)) events.push_back(timed.event);
        EXPECT_EQ(events.front(), (Event{Kind::cut, Partner::none, 1, 0, status.linksCut}));
        events.erase(events.begin());
        return events;
    };
    const std::vector<Event> one{{Kind::fragments, Partner::none, 1, 0, 1}};
    EXPECT_EQ(cut(low), one);
    EXPECT_TRUE(run(runner, 2).empty());
    EXPECT_EQ(cut(high), one) << "of this step";
    EXPECT_EQ(cut(middle), (std::vector<Event>{{Kind::pieces, Partner::none, 1, 0, 0},
                                               {Kind::fragments, Partner::none, 1, 0, 2}}))
        << "the rest, in halves";
    runner.loadTopology(whole);
    EXPECT_TRUE(run(runner, 1).empty());
    EXPECT_EQ(cut(low), one);
    test::Runner without(scene, listing(cutEvents & ~bitOf(Kind::fragments)));
    EXPECT_EQ(without.cut(low.blade()).frame, 0u);
    EXPECT_EQ(eventsOf(without.simulation(), 0).size(), 1u) << "they were not asked for";
    test::Runner alone(scene, listing(bitOf(Kind::fragments)));
    alone.cut(low.blade());
    EXPECT_EQ(eventsOf(alone.simulation(), 0), (std::vector<Timed>{{0, one[0]}}));
}

// An undo of a cut is no event, and the next cut is compared with what it left.
TEST(Events, AnUndoneCutCutsAgain) {
    Scene scene = weightless();
    addCuttableBlock(scene);
    test::Runner runner(scene, listing(cutEvents));
    run(runner, 1);
    const vk::Buffer whole = runner.saveTopology();
    const test::Sweep half = test::sweepOf({{0.15, 0.15, 0.15}, {1, 0, 0}}, 1);
    runner.cut(half.blade());
    runner.loadTopology(whole);
    EXPECT_TRUE(run(runner, 1).empty());
    const Status again = runner.cut(half.blade());
    EXPECT_EQ(eventsOf(runner.simulation(), again.frame).back().event,
              (Event{Kind::pieces, Partner::none, 0, 0, 2}));
}

TEST(Events, TornLinksAreToldApartFromThoseThatABladeCut) {
    Scene scene{.name = "pulled", .gravity = {0, 0, 0}, .damping = 5};
    ClothSheet sheet{.size = {12, 12},
                     .spacing = 0.1f,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 100,
                     .isCuttable = true,
                     .tearStrain = 0.12f};
    for (std::uint32_t i = 0; i < 12; ++i) sheet.pinned.insert(sheet.pinned.end(), {12 * i, 12 * i + 11});
    addCloth(scene, sheet);
    for (Particle& particle : scene.particles) particle.position.x *= 1.4f;
    test::Runner runner(scene, listing(cutEvents));
    std::uint32_t torn = 0, parts = 1;
    for (int s = 0; s < 40; ++s) {
        const Status status = runner.step(Step{.gravity = {}});
        std::uint32_t ofStep = 0;
        for (const Timed& timed : eventsOf(runner.simulation(), status.frame)) {
            EXPECT_NE(timed.event.kind, Kind::cut);
            if (timed.event.kind == Kind::tear) ofStep += timed.event.count;
            if (timed.event.kind == Kind::pieces) parts = timed.event.count;
        }
        EXPECT_EQ(ofStep, status.linksCut);
        EXPECT_EQ(parts, status.pieces == 0 ? 1 : status.pieces);
        torn += ofStep;
    }
    EXPECT_GT(torn, 10u);
    const test::Sweep slit = test::sweepOf({{0.2, 0, 0.2}, {0, 0, 1}}, 0.15);
    const Status status = runner.cut(slit.blade());
    std::uint32_t cut = 0, tornToo = 0;
    for (const Timed& timed : eventsOf(runner.simulation(), status.frame)) {
        if (timed.event.kind == Kind::cut) cut += timed.event.count;
        if (timed.event.kind == Kind::tear) tornToo += timed.event.count;
    }
    EXPECT_GT(cut, 0u);
    EXPECT_EQ(cut + tornToo, status.linksCut);
}

TEST(Events, APileSleepsAndABallWakesIt) {
    Scene scene{.name = "pile"};
    for (int i = 0; i < 4; ++i)
        addBall(scene, {0.001f * static_cast<float>(i), 0.1f + 0.2f * static_cast<float>(i), 0});
    addBall(scene, {0.02f, 60, 0}); // arrives after 3.5 s
    scene.contacts.friction = 0.6f;
    scene.planes = {{.friction = 0.6f}};
    scene.damping = 0.2f;
    Settings settings = listing();
    settings.sleeps = true;
    test::Runner runner(scene, settings);
    const std::vector<Timed> before = run(runner, 150);
    ASSERT_EQ(ofKind(before, Kind::sleeps).size(), 4u);
    EXPECT_TRUE(ofKind(before, Kind::wakes).empty());
    EXPECT_TRUE(ofKind(before, Kind::contactEnds).empty()) << "while they fall asleep";
    const std::vector<Timed> after = run(runner, 120);
    ASSERT_GE(ofKind(after, Kind::wakes).size(), 1u);
    const std::vector<Timed> hits = ofKind(after, Kind::contactBegins);
    ASSERT_GE(hits.size(), 1u);
    EXPECT_EQ(hits[0].event.other, 4u);
    EXPECT_EQ(ofKind(after, Kind::wakes)[0].step, hits[0].step);
}

// Nothing runs while all sleep: contacts go on, and no event is told twice.
TEST(Events, AreNoneWhileEverythingSleeps) {
    Scene scene{.name = "asleep"};
    addBall(scene, {0, 0.1f, 0});
    addBall(scene, {0, 0.3f, 0});
    scene.planes = {{.friction = 0.6f}};
    Settings settings = listing();
    settings.sleeps = true;
    test::Runner runner(scene, settings);
    const std::vector<Timed> before = run(runner, 120);
    EXPECT_EQ(ofKind(before, Kind::sleeps).size(), 2u);
    EXPECT_TRUE(run(runner, 30).empty());
    Step wakes;
    wakes.wakes = true;
    const std::vector<Timed> woken = run(runner, 1, wakes);
    EXPECT_EQ(ofKind(woken, Kind::wakes).size(), 2u);
    EXPECT_EQ(woken.size(), 2u) << "contacts have not begun anew";
}

TEST(Events, AreEqualInReversedOrderAndForAllForms) {
    const Scene scene = meeting();
    std::vector<std::vector<Timed>> runs;
    for (const bool isReversed : {false, true})
        for (const bool usesTexels : {false, true})
            for (const std::uint32_t columns : {1u, 2u}) {
                Settings settings = listing();
                settings.isReversed = isReversed;
                settings.forms.usesTexels = usesTexels;
                settings.forms.columns = columns;
                test::Runner runner(scene, settings);
                runs.push_back(run(runner, 90));
            }
    EXPECT_GE(runs[0].size(), 4u);
    for (const std::vector<Timed>& other : runs) EXPECT_EQ(other, runs[0]);
    std::vector<std::uint32_t> words;
    for (const auto& [step, event] : runs[0])
        words.insert(words.end(),
                     {static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(event.kind),
                      static_cast<std::uint32_t>(event.partner), event.body, event.other, event.count});
    std::printf("state_hash of events %016" PRIx64 "\n", fnv1a(std::as_bytes(std::span(words))));
}

TEST(Events, ChangeNoBitOfTheMotion) {
    std::vector<test::NamedScene> scenes = test::allScenes();
    scenes.push_back({"meeting", meeting()});
    scenes.push_back({"crossed_sheets", test::crossedSheets(0.25f)});
    for (const test::NamedScene& named : scenes) {
        if (named.scene.particles.empty()) continue;
        SCOPED_TRACE(named.name);
        EXPECT_EQ(test::hashOfRun(named.scene, listing(), 20), test::hashOfRun(named.scene, listing(0), 20));
    }
}

TEST(Events, AddNoPassAndNoBufferWhereNoneAreAsked) {
    const Scene scene = meeting();
    const StepProgram without = compile(scene, listing(0)), with = compile(scene, listing());
    for (const BufferSpec& buffer : without.buffers)
        EXPECT_EQ(buffer.label.find("events."), std::string::npos);
    EXPECT_EQ(without.events.list, BufferId{});
    EXPECT_GT(with.buffers.size(), without.buffers.size());
}

// The first events in order are kept, whichever form runs.
TEST(Events, BeyondTheRoomAreCounted) {
    Scene scene{.name = "rain"};
    for (int i = 0; i < 300; ++i)
        addBall(scene, {0.25f * static_cast<float>(i % 20), 0.11f, 0.25f * static_cast<float>(i / 20)});
    scene.planes = {{}};
    for (const bool isReversed : {false, true}) {
        Settings settings = listing();
        settings.eventRoom = 100;
        settings.isReversed = isReversed;
        test::Runner runner(scene, settings);
        std::uint32_t told = 0, lost = 0;
        for (int s = 0; s < 8; ++s) {
            const Events events = runner.simulation().events(runner.run(1).frame);
            ASSERT_LE(events.list.size(), 100u);
            for (std::uint32_t e = 0; e < events.list.size(); ++e) {
                EXPECT_EQ(events.list[e].kind, Kind::contactBegins);
                EXPECT_TRUE(events.lost == 0 || events.list[e].body == e) << e;
            }
            told += static_cast<std::uint32_t>(events.list.size());
            lost += events.lost;
        }
        EXPECT_EQ(told, 100u);
        EXPECT_EQ(lost, 200u);
    }
}

TEST(Events, OfAnUndoneStepAreNoneButTheLackOfRoom) {
    Scene scene{.name = "crowd", .gravity = {0, 0, 0}};
    for (int i = 0; i < 6; ++i)
        for (int k = 0; k < 6; ++k)
            addBall(scene, {0.21f * static_cast<float>(i), 0, 0.21f * static_cast<float>(k)},
                    {-4 * static_cast<float>(i - 3), 0, -4 * static_cast<float>(k - 3)});
    Settings settings = listing();
    settings.contactRoom = 1;
    test::Runner runner(scene, settings);
    bool isUndone = false;
    for (int s = 0; s < 30 && !isUndone; ++s) {
        const Status status = runner.run(1);
        isUndone = status.isUndone;
        const Events events = runner.simulation().events(status.frame);
        if (!isUndone) continue;
        ASSERT_EQ(events.list.size(), 1u);
        EXPECT_EQ(events.list[0],
                  (Event{Kind::lacksRoom, Partner::none, Event::noBody, 0, status.contactRoom}));
    }
    EXPECT_TRUE(isUndone);
}

// The record that events are compared with is part of the state.
TEST(Events, AreTheSameAfterALoad) {
    test::Runner runner(meeting(), listing());
    run(runner, 30);
    const test::Runner::Saved saved = runner.save();
    const std::vector<Timed> first = run(runner, 40);
    runner.load(saved);
    std::vector<Timed> second = run(runner, 40);
    for (Timed& timed : second) timed.step -= 40;
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, second);
}

// A host collider shifts the place of colliders among the partners of a body: contacts begin anew, none ends.
TEST(Events, OfATakeOverWithOtherPartnersEndNothing) {
    Scene scene = weightless();
    scene.colliders = {{.radius = 0.2f}};
    addBall(scene, {0, 0.299f, 0});
    Settings settings = listing(contactEvents);
    test::Runner none(scene, settings), same(scene, settings);
    settings.hostColliders = 1;
    test::Runner one(scene, settings);
    EXPECT_EQ(ofKind(run(none, 4), Kind::contactBegins).size(), 1u);
    same.takeOver(none);
    EXPECT_TRUE(run(same, 6).empty());
    one.takeOver(none);
    const std::vector<Timed> all = run(one, 6);
    EXPECT_EQ(ofKind(all, Kind::contactEnds).size(), 0u);
    ASSERT_EQ(ofKind(all, Kind::contactBegins).size(), 1u);
    EXPECT_EQ(all[0].event.partner, Partner::collider);
    EXPECT_EQ(all[0].event.other, 0u);
}

TEST(Events, GoOnInAWorldWhoseBodiesComeAndGo) {
    Scene base = test::ground();
    base.damping = 20; // boxes would bounce
    addBall(base, {-3, 0.1f, 0});
    Settings settings = listing(contactEvents, 8);
    settings.contactRoom = 64;
    test::Play play(base, settings);
    const PartId leaves = play.add(test::box({5, 0.05f, 0}, {2, 2, 2}));
    Scene pair;
    addBall(pair, {0, 0.1f, 0});
    addBall(pair, {0, 0.3f, 0});
    const PartId stays = play.add(pair);
    const auto takeSteps = [&](int steps) {
        std::vector<Timed> all;
        for (int s = 0; s < steps; ++s) {
            const std::uint32_t frame = play.step().frame;
            for (const Event& event : play.world().events(frame).list) all.push_back({frame, event});
        }
        return all;
    };
    EXPECT_EQ(ofKind(takeSteps(20), Kind::contactBegins).size(), 4u); // three on the ground, one on another
    play.remove(leaves);
    const PartId arrives = play.add(test::box({-5, 0.021f, 0}, {2, 2, 2}));
    const std::vector<Timed> after = takeSteps(20);
    ASSERT_EQ(after.size(), 1u);
    EXPECT_EQ(after[0].event.body, play.at(arrives).first.bodies);
    EXPECT_EQ(after[0].event.partner, Partner::plane);
    EXPECT_TRUE(play.world().contains(stays));
}

TEST(Events, RefuseTooManyPairsAndUnknownKinds) {
    Scene scene = weightless();
    for (int i = 0; i < 5000; ++i) addBall(scene, {static_cast<float>(i), 0, 0});
    const std::vector<std::string> tooMany = validate(scene, listing());
    ASSERT_EQ(tooMany.size(), 1u);
    EXPECT_NE(tooMany[0].find("leave out contactEvents"), std::string::npos) << tooMany[0];
    EXPECT_TRUE(validate(scene, listing(sleepEvents)).empty());
    EXPECT_FALSE(validate(weightless(), listing(1u << 20)).empty());
    Settings none = listing();
    none.eventRoom = 0;
    EXPECT_FALSE(validate(weightless(), none).empty());
}
