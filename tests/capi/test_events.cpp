// Events in C.
#include "sinew/sinew_events.h"

#include "capi/support.hpp"

namespace sinew::test {
namespace {

using World = Owned<SinewWorld, sinewDestroyWorld>;

class CApiEvents : public OnDevice {
protected:
    std::vector<SinewEvent> ofSteps(SinewSimulation simulation) {
        std::uint32_t count = 0, lost = 1;
        EXPECT_TRUE(isOk(sinewGetStepEvents(simulation, &count, nullptr, &lost)));
        std::vector<SinewEvent> events(count);
        EXPECT_TRUE(isOk(sinewGetStepEvents(simulation, &count, events.data(), nullptr)));
        EXPECT_EQ(lost, 0u);
        return events;
    }
};

} // namespace

TEST_F(CApiEvents, OfManyStepsAreTheirs) {
    Scene scene;
    makeCube(scene);
    SinewSettings settings = sinewDefaultSettings();
    settings.events = 1u << SINEW_EVENT_CONTACT_BEGINS;
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    EXPECT_TRUE(ofSteps(simulation).empty());
    std::uint32_t count = 0;
    EXPECT_EQ(sinewGetEvents(simulation, 0, &count, nullptr, nullptr), SINEW_NOT_READY);
    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 16)));
    const std::vector<SinewEvent> events = ofSteps(simulation);
    ASSERT_EQ(events.size(), 1u); // after a fall of 0.2 m
    EXPECT_NEAR(static_cast<double>(events[0].frame), 12, 1);
    EXPECT_EQ(events[0].kind, static_cast<std::uint32_t>(SINEW_EVENT_CONTACT_BEGINS));
    EXPECT_EQ(events[0].body, 0u);
    EXPECT_EQ(events[0].partner, static_cast<std::uint32_t>(SINEW_PARTNER_PLANE));
    EXPECT_EQ(events[0].other, 0u);
    EXPECT_GE(events[0].count, 1u);
    EXPECT_LE(events[0].count, 9u);
    count = 3;
    std::array<SinewEvent, 3> newest{};
    EXPECT_TRUE(isOk(sinewGetEvents(simulation, 15, &count, newest.data(), nullptr)));
    EXPECT_EQ(count, 0u);
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 1)));
    EXPECT_TRUE(ofSteps(simulation).empty()) << "those of the newest call alone";
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "count",
                          sinewGetStepEvents(simulation, nullptr, nullptr, nullptr)));
}

TEST_F(CApiEvents, OfAWorldHaveItsIndices) {
    Scene base, cube;
    makeCube(base, 2, 5);
    makeCube(cube, 2, 0.01f);
    SinewSettings settings = sinewDefaultSettings();
    settings.events = SINEW_ALL_EVENTS;
    World world;
    SinewPart part;
    SinewSimulation simulation;
    ASSERT_TRUE(isOk(sinewCreateWorld(device, base, &settings, &world)));
    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStepWorld(world, &step, 2)));
    ASSERT_TRUE(isOk(sinewAddPart(world, cube, &part)));
    ASSERT_TRUE(isOk(sinewStepWorld(world, &step, 4)));
    ASSERT_TRUE(isOk(sinewGetWorldSimulation(world, &simulation)));
    const std::vector<SinewEvent> events = ofSteps(simulation);
    ASSERT_EQ(events.size(), 2u) << "both have a floor";
    for (const SinewEvent& event : events) EXPECT_EQ(event.body, 1u);
    std::uint32_t count = 0;
    EXPECT_TRUE(isOk(sinewGetWorldEvents(world, 5, &count, nullptr, nullptr)));
    EXPECT_EQ(sinewGetWorldEvents(world, 6, &count, nullptr, nullptr), SINEW_NOT_READY);
}

TEST_F(CApiEvents, RefuseKindsThatThereAreNot) {
    Scene scene;
    makeCube(scene);
    SinewSettings settings = sinewDefaultSettings();
    settings.events = 1u << 20;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "settings.events", sinewValidate(scene, &settings)));
}

} // namespace sinew::test
