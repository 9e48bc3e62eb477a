// Tests of steps that lacked contact lists and are repeated by the document: later changes must follow them,
// and times must count them once.
#include "sim/calm_cases.hpp"
#include "sim/core/hash.hpp"
#include "support/device.hpp"
#include "viewer/headless_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <regex>
#include <string>
#include <thread>

namespace sinew::viewer {
namespace {

// A box that falls onto a floor: some calm step lacks lists.
struct Landing {
    sim::Case one = sim::landing();
    Document document{test::device(), one.scene, one.settings};

    explicit Landing(bool repeats) {
        run([&](VkCommandBuffer commands) { document.recordReset(commands); });
        document.setRepeats(repeats);
    }
    template <typename Record> void run(const Record& record) {
        const VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    void step(vk::Timestamps* timestamps = nullptr) {
        run([&](VkCommandBuffer commands) { document.recordStep(commands, timestamps); });
    }
    // Runs steps until one has lacked lists, and `more` after it; the document then returns to the state
    // before that one.
    std::uint64_t untilUndone(std::uint64_t more) {
        do step();
        while (!document.lacksLists(document.steps()) && document.steps() < one.steps);
        const std::uint64_t undone = document.steps();
        EXPECT_TRUE(document.lacksLists(undone)) << "none lacks lists";
        for (std::uint64_t i = 0; i < more; ++i) step();
        document.goBackBefore(undone);
        return undone;
    }
    void prepare(const sim::Material& material) {
        document.turn(material);
        while (document.takeTurn(false) == Document::Turn::none)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::uint64_t hash() const {
        std::uint64_t hash = sim::fnv1a({});
        for (const vk::BufferView& view :
             {document.simulation().positions(), document.simulation().velocities()})
            hash = sim::fnv1a(test::queue().download<std::byte>(view), hash);
        return hash;
    }
};

TEST(DocumentRepeats, TakesAnotherMaterialBehindStepsThatWereUndone) {
    const sim::Material soft{.stiffness = 0.5f};
    Landing calm(true), plain(false);
    const std::uint64_t undone = calm.untilUndone(2), newest = undone + 2;
    calm.prepare(soft); // before the repetition
    EXPECT_EQ(calm.document.undoneSteps(), 3u);
    EXPECT_FALSE(calm.document.isTurnReady());
    for (std::uint64_t left = 3; left > 0; --left) {
        calm.step();
        EXPECT_EQ(calm.document.undoneSteps(), left - 1);
        EXPECT_EQ(calm.document.material(), sim::Material{}) << "step " << calm.document.steps();
    }
    EXPECT_TRUE(calm.document.isTurnReady());
    while (plain.document.steps() < newest) plain.step();
    EXPECT_EQ(calm.hash(), plain.hash());
    plain.prepare(soft);
    for (int i = 0; i < 3; ++i)
        for (Landing* each : {&calm, &plain}) each->step();
    EXPECT_EQ(calm.document.material(), soft);
    EXPECT_EQ(calm.hash(), plain.hash());
}

TEST(DocumentRepeats, AreDroppedWithTheStateThatTheyLedFrom) {
    Landing reset(true), loaded(true);
    reset.untilUndone(1);
    EXPECT_EQ(reset.document.undoneSteps(), 2u);
    reset.run([&](VkCommandBuffer commands) { reset.document.recordReset(commands); });
    EXPECT_EQ(reset.document.undoneSteps(), 0u);
    reset.step();
    EXPECT_EQ(reset.document.undoneSteps(), 0u);
    loaded.untilUndone(1);
    loaded.document.setPlayed(1); // like History when it loads a state
    EXPECT_EQ(loaded.document.undoneSteps(), 0u);
}

// Uses HeadlessTimes like viewer --headless --timing.
TEST(HeadlessTimes, CountEachStepOnceThatWasTakenAgain) {
    Landing landing(true);
    Document& document = landing.document;
    HeadlessTimes times(test::device(), document);
    constexpr std::uint64_t inFlight = 3;
    std::uint64_t settled = 0, repeated = 0;
    while (settled < landing.one.steps) {
        while (document.steps() < std::min(settled + inFlight, landing.one.steps))
            landing.step(times.ofStep(document.steps() + 1));
        if (document.lacksLists(settled + 1)) {
            repeated += document.steps() - settled;
            document.goBackBefore(settled + 1);
            continue;
        }
        times.stepFinished(++settled);
    }
    EXPECT_GE(repeated, inFlight) << "no step was taken again";
    const std::string table = times.table();
    std::smatch found;
    ASSERT_TRUE(std::regex_search(table, found, std::regex("step, on the device \\[ms\\] +([0-9]+)")))
        << table;
    EXPECT_EQ(std::stoull(found[1]), landing.one.steps) << table;
}

} // namespace
} // namespace sinew::viewer
