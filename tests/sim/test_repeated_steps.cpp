// Tests of the time between a step that lacked contact lists and its repetition, and of host mistakes.
#include "sim/calm_cases.hpp"
#include "sim/core/hash.hpp"
#include "sinew/material.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

namespace sinew::sim {
namespace {

// Runs single steps, to test the time between a step that lacked lists and its repetition.
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
    // Runs until the first step that lacks lists, and one step more; returns the frame of the first.
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
    ASSERT_EQ(a.hostColliders.size(), b.hostColliders.size());
    for (std::size_t i = 0; i < a.hostColliders.size(); ++i)
        EXPECT_TRUE(areSame(a.hostColliders[i].hostCollider.pose.position,
                            b.hostColliders[i].hostCollider.pose.position));
}

double farthest(const ByHand& a, const ByHand& b) {
    const auto first = test::queue().download<float>(a.simulation.positions()),
               second = test::queue().download<float>(b.simulation.positions());
    double most = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
        most = std::max(most, std::abs(double{first[i]} - double{second[i]}));
    return most;
}

// Before the repetition, a saved, read or taken-over state is that before the step, on the device and on the
// host.
TEST(RepeatedSteps, AreSavedAndTakenOverAsBeforeTheOneThatLackedLists) {
    const Case one = ledByTheHost();
    ByHand plain(one, false), calm(one, true);
    const std::uint64_t broken = calm.untilBroken();
    for (std::uint64_t frame = 0; frame < broken; ++frame) plain.step(frame);
    EXPECT_TRUE(
        areSame(calm.simulation.colliderPoses()[0].position, plain.simulation.colliderPoses()[0].position));
    EXPECT_TRUE(areSame(calm.simulation.hostColliders()[0].hostCollider.pose.position,
                        plain.simulation.hostColliders()[0].hostCollider.pose.position));

    ByHand ofCalm(one, false), ofPlain(one, false); // simulations that take over
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

// A grab began after the step that lacked lists. In the repetition it takes another particle.
TEST(RepeatedSteps, TakeHoldOfWhatTheRepetitionSays) {
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

// A step without repetition is executed once, although it was recorded while a repeatable one was in flight.
TEST(RepeatedSteps, AreNotDoubledWhereTheHostNoLongerRepeats) {
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

// The host may first repeat earlier frames; it then reaches the step that lacked lists in time.
TEST(RepeatedSteps, MayBeginBeforeTheOneThatLackedLists) {
    const Case one = landing();
    ByHand plain(one, false), calm(one, true);
    const std::uint64_t broken = calm.untilBroken();
    const auto noMore = [](Step& step) { step.repeats = false; };
    EXPECT_TRUE(calm.step(broken - 1, noMore).lacksLists) << "it is not given up";
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{});
    EXPECT_FALSE(calm.step(broken).isUndone);
    for (std::uint64_t frame = 0; frame <= broken; ++frame) plain.step(frame);
    EXPECT_EQ(calm.hash(), plain.hash());
}

// A host that requests repeatable steps and repeats none gets a complaint. Without the request, steps
// continue.
TEST(RepeatedSteps, ThatNobodyRepeatsAreSaid) {
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

// A step that runs from the wrong state must not request capacity.
TEST(RepeatedSteps, BehindOneThatLackedListsAskForNoRoom) {
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
    EXPECT_GT(calm.simulation.status(frame + 1).contactRoom, 0u) << "its status still has its slot";
    EXPECT_EQ(calm.simulation.complaints(), std::vector<std::string>{}) << "of steps before the repetition";
    EXPECT_FALSE(again.isUndone);
    for (std::uint64_t before = 0; before <= frame; ++before) EXPECT_FALSE(plain.step(before).isUndone);
    EXPECT_LT(farthest(calm, plain), 1e-5) << "the undone step had longer substeps";
}

// Steps after the one that lacked lists had a larger dt, and left positions accordingly.
TEST(RepeatedSteps, BehindWhichStepsWereLongerAreSavedAndTakenOver) {
    const Case one = collision();
    ByHand plain(one, false), calm(one, true), other(one, true);
    std::uint64_t frame = 0;
    while (frame < one.steps && !calm.step(frame).lacksLists) ++frame;
    ASSERT_LT(frame, one.steps);
    EXPECT_TRUE(calm.step(frame + 1, [](Step& step) { step.dt = 0.1f; }).isUndone);
    other.submit([&](VkCommandBuffer c) { other.simulation.recordTakeOver(c, calm.simulation); });
    const vk::Buffer saved(test::device(),
                           {.name = "saved", .count = calm.simulation.stateSize() / 4, .stride = 4});
    const SavedState host = calm.save(saved);
    calm.submit([&](VkCommandBuffer c) { calm.simulation.recordReset(c); });
    calm.step(0);
    calm.submit([&](VkCommandBuffer c) { calm.simulation.recordLoadState(c, saved.view(), host); });
    for (std::uint64_t before = 0; before < frame; ++before) plain.step(before);
    for (ByHand* each : {&plain, &calm, &other}) EXPECT_FALSE(each->step(frame).isUndone);
    EXPECT_LT(farthest(calm, plain), 1e-5) << "what was saved";
    EXPECT_LT(farthest(other, plain), 1e-5) << "what took over";
}

// A step in place of the one that lacked lists runs from the wrong state, and must not request capacity.
TEST(RepeatedSteps, ThatNobodyRepeatsAskForNoRoom) {
    Case one = collision();
    one.settings.contactRoom = 1;
    one.settings.substeps = 4;
    ByHand calm(one, true);
    std::uint64_t frame = 0;
    while (frame < one.steps && !calm.step(frame).lacksLists) ++frame;
    ASSERT_LT(frame, one.steps);
    const std::uint64_t slots = one.settings.framesInFlight;
    Status behind;
    for (std::uint64_t next = frame + 1; next <= frame + slots; ++next)
        behind = calm.step(next, [](Step& step) { step.dt = 0.1f; });
    EXPECT_GT(behind.contactRoom, 0u);
    const std::vector<std::string> said = calm.simulation.complaints();
    ASSERT_EQ(said.size(), 1u) << said.back();
    EXPECT_NE(said[0].find("was not repeated"), std::string::npos) << said[0];
}

// A change of material with a repeatable step in flight gives a complaint. After all steps have finished
// there is none, and the repetition uses the new material.
TEST(RepeatedSteps, AreSettledBeforeTheMaterialChanges) {
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

} // namespace
} // namespace sinew::sim
