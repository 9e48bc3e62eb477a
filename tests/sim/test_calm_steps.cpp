// Calm steps, which make lists of contacts in their first substep alone: the same bits as those that make
// them in any, whatever of them was undone and repeated, with several in flight.
#include "sim/bodies.hpp"
#include "sim/calm_steps.hpp"
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/hash.hpp"
#include "sim/material.hpp"
#include "sim/scenes.hpp"
#include "sim/start.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>

namespace sinew::sim {
namespace {

constexpr float spacing = 0.05f;

void addBox(Scene& scene, Vec3 origin, std::array<std::uint32_t, 3> cells, const Start& how = {},
            bool isCuttable = false) {
    const std::size_t first = scene.bodies.size();
    addLattice(scene, {.origin = origin,
                       .cells = cells,
                       .spacing = spacing,
                       .youngModulus = 2e5f,
                       .radius = 0.45f * spacing,
                       .isCuttable = isCuttable});
    start(scene, first, how);
}

// Fills in the host's part of a step, by its frame.
using Input = std::function<void(Step&)>;

// Steps of a scene with some of them in flight, each recorded again where it lacked lists.
class Steps {
public:
    Steps(const Scene& scene, const Settings& settings, bool repeats, std::uint32_t inFlight = 1,
          Input input = {})
        : simulation_(test::device(), scene, settings), scene_(scene), input_(std::move(input)),
          repeats_(repeats), inFlight_(inFlight) {
        submit([&](VkCommandBuffer commands) { simulation_.recordReset(commands); });
    }

    void run(std::uint64_t steps) {
        const std::uint64_t end = settled_ + steps;
        std::uint64_t next = settled_;
        while (settled_ < end) {
            while (next < end && next - settled_ < inFlight_) record(next++);
            test::queue().wait(values_[settled_ % values_.size()]);
            const Status status = simulation_.status(settled_);
            ASSERT_TRUE(status.isFinished);
            ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << "step " << settled_;
            if (!status.lacksLists) {
                ASSERT_FALSE(status.isUndone);
                calm_ += status.isCalm ? 1 : 0;
                later_ += status.laterLists > 0 ? 1 : 0;
                forces_.push_back(simulation_.forces(settled_));
                if (++settled_; inFlight_ == 1) hashes_.push_back(hash());
                continue;
            }
            test::queue().waitIdle();
            expectAllUndone(next);
            repeated_ += next - settled_;
            if (!broken_) broken_ = settled_;
            next = settled_;
        }
    }

    std::uint64_t hash() const {
        std::uint64_t hash = fnv1a({});
        for (const vk::BufferView& view : {simulation_.positions(), simulation_.velocities()})
            if (view.size > 0) hash = fnv1a(test::queue().download<std::byte>(view), hash);
        return hash;
    }

    template <typename Record> void submit(const Record& record) {
        const VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }

    Simulation& simulation() { return simulation_; }
    const std::vector<std::uint64_t>& hashes() const { return hashes_; }
    std::uint64_t calm() const { return calm_; }
    std::uint64_t repeated() const { return repeated_; }
    std::uint64_t later() const { return later_; } // steps that needed lists after their first substep
    std::optional<std::uint64_t> broken() const { return broken_; } // the first that lacked lists
    const std::vector<Impulses>& forces() const { return forces_; } // by step

private:
    void record(std::uint64_t frame) {
        Step step{.dt = scene_.dt, .gravity = scene_.gravity, .frame = frame, .repeats = repeats_};
        if (input_) input_(step);
        const VkCommandBuffer commands = test::queue().begin();
        simulation_.record(commands, step);
        values_[frame % values_.size()] = test::queue().submit(commands);
    }

    // All that was recorded from the step that lacked lists on.
    void expectAllUndone(std::uint64_t next) {
        for (std::uint64_t frame = settled_; frame < next; ++frame) {
            const Status status = simulation_.status(frame);
            EXPECT_TRUE(status.isUndone && status.lacksLists) << frame << " of " << settled_;
            const Impulses forces = simulation_.forces(frame);
            for (const BodyImpulses& body : forces.bodies)
                for (const Impulse& impulse : {body.contacts, body.planes, body.colliders, body.holds})
                    EXPECT_TRUE(impulse.linear.x == 0 && impulse.linear.y == 0 && impulse.linear.z == 0);
        }
        if (!hashes_.empty()) {
            EXPECT_EQ(hash(), hashes_.back()) << "before step " << settled_;
        }
    }

    Simulation simulation_;
    const Scene scene_;
    Input input_;
    bool repeats_;
    std::uint32_t inFlight_;
    std::array<std::uint64_t, Simulation::framesInFlight> values_{};
    std::uint64_t settled_ = 0, calm_ = 0, repeated_ = 0, later_ = 0;
    std::vector<std::uint64_t> hashes_;
    std::optional<std::uint64_t> broken_;
    std::vector<Impulses> forces_;
};

struct Case {
    const char* name;
    Scene scene;
    Settings settings;
    std::uint64_t steps = 40;
    Input input = {};
    bool isBroken = false; // some calm step lacks lists
};

Scene onFloor() {
    Scene scene;
    scene.planes = {{.friction = 0.4f}};
    return scene;
}

// Falls until a floor meets it.
Case landing() {
    Case one{"a box that lands", onFloor(), {.substeps = 16, .contactRoom = 64}, 30, {}, true};
    addBox(one.scene, {0, 0.6f, 0}, {4, 4, 4});
    return one;
}

// Two that fly until they meet.
Case collision() {
    Case one{"boxes that collide", {}, {.substeps = 12, .contactRoom = 64, .pokes = 1}, 30, {}, true};
    one.scene.gravity = {0, 0, 0};
    one.scene.contacts = {.friction = 0.3f, .restitution = 0.4f};
    addBox(one.scene, {0, 0, 0}, {3, 3, 3}, {.velocity = {1.5f, 0, 0}});
    addBox(one.scene, {1, 0.05f, 0}, {3, 3, 3}, {.velocity = {-1.5f, 0, 0}, .spin = {0, 1, 2}});
    return one;
}

Case stack() {
    Case one{"a stack", onFloor(), {.substeps = 16, .contactRoom = 64}};
    for (const int b : {0, 1, 2})
        addBox(one.scene, {0.01f * static_cast<float>(b), 0.03f + 0.24f * static_cast<float>(b), 0},
               {4, 4, 4});
    one.scene.contacts.friction = 0.5f;
    return one;
}

Case slide() {
    Case one{"a box that slides on another", onFloor(), {.substeps = 16, .contactRoom = 64}};
    one.scene.contacts.friction = 0.05f;
    addBox(one.scene, {0, 0.03f, 0}, {10, 2, 4});
    addBox(one.scene, {0, 0.18f, 0}, {3, 3, 3}, {.velocity = {0.6f, 0, 0}});
    return one;
}

Case balls() {
    Case one{"loose balls", onFloor(), {.substeps = 12, .contactRoom = 32}, 40, {}, true};
    one.scene.contacts = {.friction = 0.3f, .restitution = 0.2f};
    test::addBalls(one.scene, 4, 0.12f, 0.01f, {0, 0.9f, 0});
    return one;
}

Case cut() {
    Case one{"a box that is cut", onFloor(), {.substeps = 12, .contactRoom = 96}, 30, {}, true};
    addBox(one.scene, {0, 0.25f, 0}, {6, 4, 4}, {}, true);
    static constexpr std::array<Vec3, 2> from{{{0.151f, -1, -1}, {0.151f, 2, -1}}},
        to{{{0.161f, -1, 1}, {0.161f, 2, 1}}};
    one.input = [](Step& step) {
        if (step.frame == 12) step.blade = {.from = from, .to = to};
    };
    return one;
}

// Two that fly until they meet, of which one may tear: all its steps have the passes of cuts, and calm ones,
// too.
Case torn() {
    Case one = collision();
    one.name = "boxes that may tear";
    one.settings.contactRoom = 96;
    addLattice(one.scene, {.origin = {0, 2, 0},
                           .cells = {3, 3, 3},
                           .spacing = spacing,
                           .youngModulus = 2e5f,
                           .radius = 0.45f * spacing,
                           .isCuttable = true,
                           .tearStrain = 0.5f});
    return one;
}

// Two boxes meet while a point that follows no faster than it may leads a third one, and a collider on a path
// and a poke move beside it: the host's part of the state.
Case ledByTheHost() {
    Case one = collision();
    one.name = "a box that is led";
    addBox(one.scene, {0, 1, 0}, {3, 3, 3});
    const auto last = static_cast<std::uint32_t>(one.scene.particles.size() - 1);
    const Vec3 place = one.scene.particles[last].position;
    one.scene.attachments = {{.particle = last, .anchor = place, .maxSpeed = 0.04f}};
    one.scene.colliders = {{.radius = 0.1f,
                            .path = {{.time = 0, .pose = {.position = {0.28f, 1.1f, 0.1f}}},
                                     {.time = 1, .pose = {.position = {0.2f, 1.1f, 0.1f}}}}}};
    one.input = [place](Step& step) {
        static std::array<Vec3, 1> anchors;
        static std::array<Poke, 1> pokes;
        const auto frame = static_cast<float>(step.frame);
        anchors = {{{place.x + 0.01f * frame, place.y, place.z}}};
        pokes = {{{.radius = 0.08f,
                   .pose = {.position = {0.1f, 0.905f + 0.002f * frame, 0.1f}},
                   .maxSpeed = 0.05f}}};
        step.anchors = anchors;
        step.pokes = pokes;
    };
    return one;
}

// A hand takes hold of a box in the step behind the first one that lacks lists, and lets go.
Case held() {
    Case one = landing();
    one.name = "a box that is held";
    one.settings.grabs = 1;
    Steps alone(one.scene, one.settings, true);
    alone.run(one.steps);
    one.input = [first = alone.broken().value_or(0) + 1](Step& step) {
        static constexpr std::array<Grab, 1> grabs{
            {{.particle = 3, .radius = 0.1f, .target = {0.3f, 0.5f, 0}}}};
        if (step.frame >= first && step.frame < first + 5) step.grabs = grabs;
    };
    return one;
}

// One flies, and wakes one of two that sleep.
Case asleep() {
    Case one{"boxes that sleep", {}, {.substeps = 12, .contactRoom = 64, .sleeps = true}, 70, {}, true};
    one.scene.gravity = {0, 0, 0};
    addBox(one.scene, {0, 0, 0}, {3, 3, 3});
    addBox(one.scene, {0, 3, 0}, {3, 3, 3});
    addBox(one.scene, {1.6f, 0.05f, 0.02f}, {3, 3, 3}, {.velocity = {-1.5f, 0, 0}});
    return one;
}

// So few substeps that few, or none, come after the first one.
Case inSubsteps(std::uint32_t substeps, bool isBroken) {
    Case one = landing();
    one.name = substeps == 1 ? "a box that lands, in one substep" : "a box that lands, in an odd number";
    one.settings.substeps = substeps;
    one.isBroken = isBroken;
    return one;
}

// Positions have remainders there, which a step that is undone loses.
Case farAway() {
    Case one{"a box that lands far away", onFloor(), {.substeps = 16, .contactRoom = 64}, 30};
    addBox(one.scene, {900, 0.6f, 0}, {4, 4, 4});
    return one;
}

// A step that is undone loses velocities that nobody publishes.
Case withoutVelocities() {
    Case one = landing();
    one.name = "a box that lands without velocities";
    one.settings.publishesVelocities = false;
    one.isBroken = false;
    return one;
}

Case inUnequalSteps() {
    Case one = landing();
    one.name = "a box that lands in unequal steps";
    one.input = [](Step& step) { step.dt *= step.frame % 2 == 0 ? 1 : 0.9f; };
    one.isBroken = false;
    return one;
}

Case withForces() {
    Case one = landing();
    one.name = "forces of a box that lands";
    one.settings.keepsForces = true;
    return one;
}

std::vector<Case> cases() {
    const Settings few{.substeps = 10, .contactRoom = 96};
    return {landing(),
            collision(),
            stack(),
            slide(),
            balls(),
            cut(),
            ledByTheHost(),
            held(),
            asleep(),
            torn(),
            farAway(),
            withoutVelocities(),
            inUnequalSteps(),
            inSubsteps(1, false),
            inSubsteps(7, true),
            {"cloth on a ball", test::clothOnBall(), few, 20},
            {"cloth on a box", test::clothOnBox(0.2f), few, 20},
            {"crossed sheets", test::crossedSheets(0.2f), few, 20}};
}

bool areEqual(const Impulse& a, const Impulse& b) {
    const auto isSame = [](const Vec3& x, const Vec3& y) { return x.x == y.x && x.y == y.y && x.z == y.z; };
    return isSame(a.linear, b.linear) && isSame(a.angular, b.angular);
}

} // namespace

TEST(CalmSteps, AndThoseThatAreRepeatedLeaveTheBitsOfAllOthers) {
    std::uint64_t calm = 0, repeated = 0, later = 0;
    for (const Case& one : cases()) {
        SCOPED_TRACE(one.name);
        Steps plain(one.scene, one.settings, false, 1, one.input);
        Steps alone(one.scene, one.settings, true, 1, one.input);
        Steps together(one.scene, one.settings, true, 3, one.input);
        for (Steps* steps : {&plain, &alone, &together}) ASSERT_NO_FATAL_FAILURE(steps->run(one.steps));
        std::printf("%s: %llu of %llu steps calm, %llu repeated; three in flight: %llu, %llu; without: %llu "
                    "needed later lists\n",
                    one.name, static_cast<unsigned long long>(alone.calm()),
                    static_cast<unsigned long long>(one.steps),
                    static_cast<unsigned long long>(alone.repeated()),
                    static_cast<unsigned long long>(together.calm()),
                    static_cast<unsigned long long>(together.repeated()),
                    static_cast<unsigned long long>(plain.later()));
        EXPECT_EQ(plain.calm() + plain.repeated(), 0u);
        EXPECT_EQ(alone.hashes(), plain.hashes());
        EXPECT_EQ(together.hash(), plain.hash());
        if (one.isBroken) {
            EXPECT_GT(alone.repeated(), 0u);
            EXPECT_GT(together.repeated(), alone.repeated()) << "with those behind it";
        }
        if (one.settings.sleeps) {
            EXPECT_GT(together.simulation().status(one.steps - 1).sleeping, 0u);
        }
        calm += alone.calm();
        repeated += alone.repeated();
        later += plain.later();
        const Status last = together.simulation().status(one.steps - 1);
        EXPECT_GE(last.stepsUndone, together.repeated()) << "some are told apart no more";
    }
    EXPECT_GT(calm, 60u);
    EXPECT_GT(repeated, 1u) << "no step was broken";
    EXPECT_GT(later, 20u) << "no scene needs lists in the midst of a step";
}

// Impulses of a step that was repeated are those of the step that was not undone.
TEST(CalmSteps, KeepTheForcesOfOthers) {
    const Case one = withForces();
    Steps plain(one.scene, one.settings, false), calm(one.scene, one.settings, true, 2);
    for (Steps* steps : {&plain, &calm}) ASSERT_NO_FATAL_FAILURE(steps->run(one.steps));
    EXPECT_GT(calm.calm(), 0u);
    EXPECT_GT(calm.repeated(), 0u);
    bool isHeld = false;
    for (std::size_t step = 0; step < one.steps; ++step) {
        ASSERT_EQ(calm.forces()[step].bodies.size(), 1u);
        const BodyImpulses &with = calm.forces()[step].bodies[0], &without = plain.forces()[step].bodies[0];
        isHeld = isHeld || without.planes.linear.y > 0;
        for (const Impulse BodyImpulses::*of : {&BodyImpulses::contacts, &BodyImpulses::planes})
            EXPECT_TRUE(areEqual(with.*of, without.*of)) << step;
    }
    EXPECT_TRUE(isHeld) << "it does not land";
}

// Until a step that lacks lists is on the device, and not looked at yet: what is saved then, and what goes on
// from a reset, goes on as if nothing was.
TEST(CalmSteps, LeaveNothingBehindInStatesOfTheirOwn) {
    const Case one = landing();
    Simulation simulation(test::device(), one.scene, one.settings);
    const vk::Buffer saved(test::device(),
                           {.name = "saved", .count = simulation.stateSize() / 4, .stride = 4});
    SavedState host;
    const auto submit = [&](const auto& record) {
        const VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    };
    const auto step = [&](std::uint64_t frame, bool repeats) {
        submit([&](VkCommandBuffer commands) {
            simulation.record(commands, {.dt = one.scene.dt, .frame = frame, .repeats = repeats});
        });
        return simulation.status(frame);
    };
    submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
    std::uint64_t frame = 0;
    while (frame < one.steps && !step(frame, true).lacksLists) ++frame;
    ASSERT_LT(frame, one.steps) << "none lacks lists";
    EXPECT_TRUE(step(frame + 1, true).lacksLists) << "as all behind it";
    submit([&](VkCommandBuffer commands) { host = simulation.recordSaveState(commands, saved.view()); });

    submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
    EXPECT_FALSE(step(frame, true).isUndone) << "of another generation";
    submit([&](VkCommandBuffer commands) { simulation.recordLoadState(commands, saved.view(), host); });
    EXPECT_FALSE(step(frame, true).isUndone) << "it goes on before the step that lacked lists";
    EXPECT_FALSE(step(frame + 1, true).isUndone);
    // one that does not repeat steps goes on, too
    submit([&](VkCommandBuffer commands) { simulation.recordLoadState(commands, saved.view(), host); });
    EXPECT_FALSE(step(frame, false).isUndone);
}

// Steps one by one, for what happens between a step that lacked lists and its repetition.
class ByHand {
public:
    ByHand(const Case& one, bool repeats)
        : simulation(test::device(), one.scene, one.settings), one_(one), repeats_(repeats) {
        submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
    }

    template <typename Record> void submit(const Record& record) {
        const VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    Status step(std::uint64_t frame, const std::function<void(Step&)>& change = {}) {
        Step step{.dt = one_.scene.dt, .gravity = one_.scene.gravity, .frame = frame, .repeats = repeats_};
        if (one_.input) one_.input(step);
        if (change) change(step);
        submit([&](VkCommandBuffer commands) { simulation.record(commands, step); });
        return simulation.status(frame);
    }
    // The first step that lacks lists, which was recorded, and the one behind it.
    std::uint64_t untilBroken() {
        std::uint64_t frame = 0;
        while (frame < one_.steps && !step(frame).lacksLists) ++frame;
        EXPECT_LT(frame, one_.steps) << "none lacks lists";
        EXPECT_TRUE(step(frame + 1).lacksLists);
        return frame;
    }
    SavedState save(const vk::Buffer& buffer) {
        SavedState host;
        submit([&](VkCommandBuffer commands) { host = simulation.recordSaveState(commands, buffer.view()); });
        return host;
    }
    std::uint64_t hash() const { return hashOf(simulation); }
    static std::uint64_t hashOf(const Simulation& of) {
        std::uint64_t hash = fnv1a({});
        for (const vk::BufferView& view : {of.positions(), of.velocities()})
            hash = fnv1a(test::queue().download<std::byte>(view), hash);
        return hash;
    }

    Simulation simulation;

private:
    const Case& one_;
    bool repeats_;
};

bool areSame(const Vec3& a, const Vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

void expectSameHost(const SavedState& a, const SavedState& b) {
    EXPECT_EQ(a.h, b.h);
    EXPECT_EQ(a.colliderTime, b.colliderTime);
    EXPECT_EQ(a.isUncut, b.isUncut);
    EXPECT_EQ(a.hasNewTopology, b.hasNewTopology);
    ASSERT_EQ(a.anchors.size(), b.anchors.size());
    for (std::size_t i = 0; i < a.anchors.size(); ++i) EXPECT_TRUE(areSame(a.anchors[i], b.anchors[i]));
    ASSERT_EQ(a.pokes.size(), b.pokes.size());
    for (std::size_t i = 0; i < a.pokes.size(); ++i)
        EXPECT_TRUE(areSame(a.pokes[i].poke.pose.position, b.pokes[i].poke.pose.position));
}

double farthest(const ByHand& a, const ByHand& b) {
    const auto first = test::queue().download<float>(a.simulation.positions()),
               second = test::queue().download<float>(b.simulation.positions());
    double most = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
        most = std::max(most, std::abs(double{first[i]} - double{second[i]}));
    return most;
}

// What is saved, seen or taken over before the repetition is the state before the step, on the host as well.
TEST(CalmSteps, AreSavedAndTakenOverAsBeforeTheOneThatLackedLists) {
    const Case one = ledByTheHost();
    ByHand plain(one, false), calm(one, true);
    const std::uint64_t broken = calm.untilBroken();
    for (std::uint64_t frame = 0; frame < broken; ++frame) plain.step(frame);
    EXPECT_TRUE(
        areSame(calm.simulation.colliderPoses()[0].position, plain.simulation.colliderPoses()[0].position));
    EXPECT_TRUE(areSame(calm.simulation.pokes()[0].poke.pose.position,
                        plain.simulation.pokes()[0].poke.pose.position));

    ByHand ofCalm(one, false), ofPlain(one, false); // those that take over
    ofCalm.submit([&](VkCommandBuffer c) { ofCalm.simulation.recordTakeOver(c, calm.simulation); });
    ofPlain.submit([&](VkCommandBuffer c) { ofPlain.simulation.recordTakeOver(c, plain.simulation); });

    const vk::BufferRequest request{.name = "saved", .count = calm.simulation.stateSize() / 4, .stride = 4};
    const vk::Buffer saved(test::device(), request), other(test::device(), request);
    const SavedState host = calm.save(saved);
    expectSameHost(host, plain.save(other));
    const auto goOn = [&](ByHand& from) {
        for (std::uint64_t frame = broken; frame < one.steps; ++frame)
            while (from.step(frame).lacksLists) {
            }
        return from.hash();
    };
    const std::uint64_t hash = goOn(plain);
    EXPECT_EQ(goOn(calm), hash) << "which was looked at and saved in between";
    calm.submit([&](VkCommandBuffer c) { calm.simulation.recordLoadState(c, saved.view(), host); });
    EXPECT_EQ(goOn(calm), hash) << "of what was saved";
    EXPECT_EQ(goOn(ofCalm), goOn(ofPlain));
}

// The hand that took hold behind the step that lacked lists holds something else in its repetition.
TEST(CalmSteps, TakeHoldOfWhatTheRepetitionSays) {
    Case one = landing();
    one.settings.grabs = 1;
    ByHand plain(one, false), calm(one, true);
    const std::array<Grab, 1> first{{{.particle = 3, .radius = 0.1f, .target = {0.3f, 0.5f, 0}}}},
        second{{{.particle = 120, .radius = 0.1f, .target = {-0.3f, 0.8f, 0}}}};
    std::uint64_t frame = 0;
    while (frame < one.steps && !calm.step(frame).lacksLists) ++frame;
    ASSERT_LT(frame, one.steps);
    EXPECT_TRUE(calm.step(frame + 1, [&](Step& step) { step.grabs = first; }).lacksLists);
    for (std::uint64_t before = 0; before < frame; ++before) plain.step(before);
    for (int i = 0; i < 3; ++i, ++frame)
        for (ByHand* each : {&plain, &calm})
            EXPECT_FALSE(each->step(frame, [&](Step& step) { step.grabs = second; }).isUndone);
    EXPECT_EQ(calm.hash(), plain.hash());
}

// A step that may not be repeated, recorded while one is in flight that may, is taken once.
TEST(CalmSteps, AreNotDoubledWhereTheHostNoLongerRepeats) {
    const Case one = landing();
    ByHand plain(one, false), calm(one, true);
    const std::uint64_t broken = calm.untilBroken();
    const auto noMore = [](Step& step) { step.repeats = false; };
    EXPECT_TRUE(calm.step(broken + 2, noMore).lacksLists) << "behind one that lacked lists";
    for (std::uint64_t frame = 0; frame < broken; ++frame) plain.step(frame);
    EXPECT_EQ(calm.hash(), plain.hash());
    for (std::uint64_t frame = broken; frame < broken + 3; ++frame) {
        EXPECT_FALSE(calm.step(frame, noMore).isUndone);
        plain.step(frame);
    }
    EXPECT_EQ(calm.hash(), plain.hash());
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{});
}

// One that asks for steps that may be repeated and repeats none is told; without asking, steps go on.
TEST(CalmSteps, ThatNobodyRepeatsAreSaid) {
    const Case one = landing();
    ByHand plain(one, false), calm(one, true);
    const std::uint64_t broken = calm.untilBroken(), slots = one.settings.framesInFlight;
    for (std::uint64_t frame = broken + 2; frame < broken + slots; ++frame) calm.step(frame);
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{}) << "there is still time";
    EXPECT_TRUE(calm.step(broken + slots).isUndone);
    const std::vector<std::string> said = calm.simulation.complaints();
    ASSERT_EQ(said.size(), 1u);
    for (const std::string& part : {"step " + std::to_string(broken + slots),
                                    "step " + std::to_string(broken) + " lacked", std::string("lacksLists")})
        EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
    calm.step(broken + slots + 1);
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{}) << "once";
    const auto noMore = [](Step& step) { step.repeats = false; };
    EXPECT_FALSE(calm.step(broken + slots + 2, noMore).isUndone) << "from before the step that lacked lists";
    for (std::uint64_t frame = 0; frame <= broken; ++frame) plain.step(frame);
    EXPECT_EQ(calm.hash(), plain.hash());
}

// What a step needs that goes on from the wrong state is no lack of room.
TEST(CalmSteps, BehindOneThatLackedListsAskForNoRoom) {
    Case one = collision();
    one.settings.contactRoom = 1;
    one.settings.substeps = 4;
    ByHand plain(one, false), calm(one, true);
    std::uint64_t frame = 0;
    while (frame < one.steps && !calm.step(frame).lacksLists) ++frame;
    ASSERT_LT(frame, one.steps);
    const Status behind = calm.step(frame + 1, [](Step& step) { step.dt = 0.1f; });
    EXPECT_TRUE(behind.isUndone);
    EXPECT_GT(behind.contactRoom, 0u) << "it goes far, and needs none";
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{});
    const Status again = calm.step(frame);
    EXPECT_EQ(again.contactRoom, 0u);
    EXPECT_FALSE(again.isUndone);
    for (std::uint64_t before = 0; before <= frame; ++before) EXPECT_FALSE(plain.step(before).isUndone);
    EXPECT_LT(farthest(calm, plain), 1e-5) << "the undone step had longer substeps";
}

// Another material behind a step in flight that may be repeated is said; once all came back it is not, and
// the repetition has that material.
TEST(CalmSteps, AreSettledBeforeTheMaterialChanges) {
    const Case one = landing();
    ByHand plain(one, false), calm(one, true);
    const Scene soft = withMaterial(one.scene, {.stiffness = 0.5f});
    std::optional<SceneChange> ofCalm = calm.simulation.prepareChange(soft),
                               ofPlain = plain.simulation.prepareChange(soft);
    ASSERT_TRUE(ofCalm && ofPlain);
    const std::uint64_t broken = calm.untilBroken();
    for (std::uint64_t frame = 0; frame < broken; ++frame) plain.step(frame);
    calm.submit([&](VkCommandBuffer commands) { calm.simulation.recordChange(commands, *ofCalm); });
    plain.submit([&](VkCommandBuffer commands) { plain.simulation.recordChange(commands, *ofPlain); });
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{});
    for (std::uint64_t frame = broken; frame < broken + 3; ++frame)
        for (ByHand* each : {&plain, &calm}) EXPECT_FALSE(each->step(frame).isUndone);
    EXPECT_EQ(calm.hash(), plain.hash());

    std::optional<SceneChange> later = calm.simulation.prepareChange(one.scene);
    ASSERT_TRUE(later);
    const Step step{.dt = one.scene.dt, .gravity = one.scene.gravity, .frame = broken + 3, .repeats = true};
    calm.submit([&](VkCommandBuffer commands) {
        calm.simulation.record(commands, step);
        calm.simulation.recordChange(commands, *later);
    });
    const std::vector<std::string> said = calm.simulation.complaints();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("step " + std::to_string(broken + 3) + ": in flight with Step::repeats"),
              std::string::npos)
        << said[0];
}

TEST(CalmSteps, ComeAfterEnoughOthersAndTwiceAsManyOnceOneFailed) {
    CalmSteps steps;
    const auto untilCalm = [&] {
        std::uint32_t count = 0;
        for (; !steps.areCalm(); ++count) steps.finished(0, false);
        return count;
    };
    EXPECT_EQ(untilCalm(), CalmSteps::fewest);
    steps.finished(1, false);
    EXPECT_EQ(untilCalm(), CalmSteps::fewest) << "in a row";
    steps.lacked();
    EXPECT_EQ(untilCalm(), 2 * CalmSteps::fewest);
    for (int i = 0; i < 20; ++i) steps.lacked();
    EXPECT_EQ(untilCalm(), CalmSteps::most);
    for (std::uint32_t i = 0; i < CalmSteps::most; ++i) steps.finished(0, true);
    steps.finished(1, false);
    EXPECT_EQ(untilCalm(), CalmSteps::most / 2) << "after as many calm ones";
}

} // namespace sinew::sim
