// Tests that a second thread which uses a simulation or its world is detected: by the mechanism in every
// build, and through the objects in builds without NDEBUG.
#include "sim/simulation/one_thread.hpp"

#include "sinew/bodies.hpp"
#include "sinew/world.hpp"
#include "support/host_device.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <thread>
#include <utility>

using namespace sinew;
using namespace sinew::sim;
using Sentences = std::vector<std::string>;

namespace {

void inAnotherThread(const std::function<void()>& call) {
    std::thread(call).join();
}

Sentences sentencesOf(OneThread& object) {
    Sentences sentences;
    object.takeTo(sentences);
    return sentences;
}

// Runs in a second thread at the next dispatch that is recorded: inside of a call of the first thread.
std::function<void()> intrusion;
PFN_vkCmdDispatch dispatch = nullptr;

VKAPI_ATTR void VKAPI_CALL dispatchDisturbed(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                                             std::uint32_t z) {
    if (const std::function<void()> call = std::exchange(intrusion, nullptr)) inAnotherThread(call);
    dispatch(commands, x, y, z);
}

Sentences afterIntrusion(const std::function<void(World&)>& intruder) {
    test::HostDevice host;
    dispatch = reinterpret_cast<PFN_vkCmdDispatch>(host.original("vkCmdDispatch"));
    host.replace("vkCmdDispatch", reinterpret_cast<PFN_vkVoidFunction>(&dispatchDisturbed));
    const vk::Device device = vk::Device::borrow(host.handles());
    Scene scene;
    addLattice(scene, {.cells = {2, 2, 2}, .spacing = 0.1f});
    World world(device, scene, {.substeps = 2});
    Simulation& simulation = world.simulation();
    host.submit([&](VkCommandBuffer commands) {
        simulation.recordReset(commands);
        intrusion = [&] { intruder(world); };
        simulation.record(commands, {.dt = scene.dt, .gravity = scene.gravity});
    });
    EXPECT_EQ(intrusion, nullptr) << "nothing was dispatched";
    Sentences sentences = simulation.complaintsOfUse();
    EXPECT_EQ(simulation.complaintsOfUse(), Sentences{}) << "each is said once";
    return sentences;
}

void expectDetected(const Sentences& said, const char* function) {
#ifdef NDEBUG
    EXPECT_EQ(said, Sentences{}) << function << ": costs nothing in a release build";
#else
    ASSERT_EQ(said.size(), 1u) << function;
    EXPECT_EQ(said[0].find(std::string("a simulation: ") + function + "() was called by a second thread"), 0u)
        << said[0];
#endif
}

} // namespace

TEST(OneThread, MayCallAgainInsideACall) {
    OneThread object("thing");
    for (int i = 0; i < 2; ++i) {
        const OneThread::Call outer(object, "outer");
        const OneThread::Call inner(object, "inner");
    }
    EXPECT_EQ(sentencesOf(object), Sentences{});
}

TEST(OneThread, MayFollowAnother) {
    OneThread object("thing");
    for (int i = 0; i < 2; ++i) {
        { const OneThread::Call call(object, "first"); }
        inAnotherThread([&] { const OneThread::Call call(object, "second"); });
    }
    EXPECT_EQ(sentencesOf(object), Sentences{});
}

TEST(OneThread, IsDisturbedByASecondOneInsideACall) {
    OneThread object("thing");
    ::testing::internal::CaptureStderr();
    for (int i = 0; i < 2; ++i) {
        const OneThread::Call call(object, "first");
        inAnotherThread([&] { const OneThread::Call other(object, "second"); });
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(),
              "sinew: a thing: second() is called by a second thread while another one is in first()\n");
    const Sentences said = sentencesOf(object);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].find("a thing: second() was called by a second thread"), 0u) << said[0];
    EXPECT_EQ(sentencesOf(object), Sentences{});
}

TEST(OneThread, RecordsWithoutAComplaint) {
    EXPECT_EQ(afterIntrusion([](World&) {}), Sentences{});
}

TEST(OneThread, IsAskedOfASimulationInADebugBuild) {
    expectDetected(afterIntrusion([](World& world) { world.simulation().status(0); }), "status");
}

TEST(OneThread, IsAskedOfAWorldInADebugBuild) {
    expectDetected(
        afterIntrusion([](World& world) { EXPECT_THROW(world.remove(PartId{}), std::invalid_argument); }),
        "remove");
}
