// Tests of calm steps, which build contact lists only in their first substep. They must give the same bits as
// steps that may build lists in any substep, also after undone and repeated steps and with several in flight.
#include "sim/calm_cases.hpp"
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/core/hash.hpp"
#include "sim/scenes.hpp"
#include "sim/simulation/calm_steps.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>

namespace sinew::sim {
namespace {

// Runs the steps of a scene with some in flight, and repeats those that lacked lists.
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
    std::optional<std::uint64_t> broken() const { return broken_; } // the first step that lacked lists
    const std::vector<Impulses>& forces() const { return forces_; } // by step

private:
    void record(std::uint64_t frame) {
        Step step{.dt = scene_.dt, .gravity = scene_.gravity, .frame = frame, .repeats = repeats_};
        if (input_) input_(step);
        const VkCommandBuffer commands = test::queue().begin();
        simulation_.record(commands, step);
        values_[frame % values_.size()] = test::queue().submit(commands);
    }

    // Expects all steps from the one that lacked lists on to be undone.
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

// Two boxes that fly until they collide, and a third that may tear. All steps have the passes of cuts, also
// calm ones.
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

// A grab takes a box in the step after the first one that lacks lists, and releases it later.
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

// One flying box wakes one of two sleeping boxes.
Case asleep() {
    Case one{"boxes that sleep", {}, {.substeps = 12, .contactRoom = 64, .sleeps = true}, 70, {}, true};
    one.scene.gravity = {0, 0, 0};
    addBox(one.scene, {0, 0, 0}, {3, 3, 3});
    addBox(one.scene, {0, 3, 0}, {3, 3, 3});
    addBox(one.scene, {1.6f, 0.05f, 0.02f}, {3, 3, 3}, {.velocity = {-1.5f, 0, 0}});
    return one;
}

// So few substeps that few or none follow the first.
Case inSubsteps(std::uint32_t substeps, bool isBroken) {
    Case one = landing();
    one.name = substeps == 1 ? "a box that lands, in one substep" : "a box that lands, in an odd number";
    one.settings.substeps = substeps;
    one.isBroken = isBroken;
    return one;
}

// Positions far away have remainders, which an undone step loses.
Case farAway() {
    Case one{"a box that lands far away", onFloor(), {.substeps = 16, .contactRoom = 64}, 30};
    addBox(one.scene, {900, 0.6f, 0}, {4, 4, 4});
    return one;
}

// An undone step loses velocities that are not published.
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

// A repeated step reports only the impulses of its completed run.
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

// A step that lacks lists has run and has not been evaluated yet. A state saved then, and steps after a
// reset, must continue as if nothing had happened.
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
    // A host that does not repeat steps continues, too.
    submit([&](VkCommandBuffer commands) { simulation.recordLoadState(commands, saved.view(), host); });
    EXPECT_FALSE(step(frame, false).isUndone);
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
