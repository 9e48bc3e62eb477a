// The next simulation is made on a thread beside the one that is stepped. At most one exists at a time.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/successor.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "vk/allocator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <latch>
#include <thread>

using namespace sinew;
using namespace sinew::sim;

namespace {

std::uint32_t buffersOnDevice() {
    return test::device().allocator().statistics().buffers;
}

Settings withSubsteps(std::uint32_t substeps) {
    return {.substeps = substeps};
}

SuccessorRequest requestOf(const Scene& scene, std::uint32_t substeps) {
    return {test::device(), [scene] { return scene; }, withSubsteps(substeps)};
}

void awaitReady(const Successor& successor) {
    while (!successor.isReady()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

// False after 10 s in which there were other buffers.
bool comesToBuffers(std::uint32_t count) {
    for (int i = 0; i < 5000 && buffersOnDevice() != count; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return buffersOnDevice() == count;
}

} // namespace

TEST(Successor, IsMadeOnAnotherThreadAndGoesOnWithTheSameBits) {
    const Scene scene = test::sheet(6, 1e-5f);
    test::Runner first(scene, withSubsteps(5)), waiting(scene, withSubsteps(9));
    first.run(4);
    const std::size_t made = test::device().kernels().pipelinesMade();
    Successor successor;
    EXPECT_FALSE(successor.isRequested());
    EXPECT_FALSE(successor.isReady());
    successor.request(requestOf(scene, 9));
    EXPECT_TRUE(successor.isRequested());
    first.run(2); // meanwhile
    awaitReady(successor);
    EXPECT_TRUE(successor.isRequested()) << "until somebody takes it";
    Successor::Made next = successor.take();
    EXPECT_FALSE(successor.isRequested());
    EXPECT_FALSE(successor.isReady());
    EXPECT_EQ(test::device().kernels().pipelinesMade(), made) << "this thread makes none";
    ASSERT_NE(next.simulation, nullptr);
    EXPECT_EQ(next.settings.substeps, 9u);
    EXPECT_EQ(next.scene.particles.size(), scene.particles.size());

    waiting.takeOver(first);
    waiting.run(1);
    const VkCommandBuffer commands = test::queue().begin();
    next.simulation->recordTakeOver(commands, first.simulation());
    next.simulation->record(commands, {.dt = scene.dt, .gravity = scene.gravity, .frame = 6});
    test::queue().wait(test::queue().submit(commands));
    EXPECT_EQ(test::queue().download<std::byte>(next.simulation->positions()),
              test::queue().download<std::byte>(waiting.simulation().positions()));
}

TEST(Successor, TellsWhyItCannotBeHadAndMakesTheNext) {
    const Scene good = test::chain(6);
    Scene bad = good;
    bad.distances[0].b = bad.distances[0].a;
    const std::uint32_t before = buffersOnDevice();
    Successor successor;
    successor.request(requestOf(bad, 4));
    awaitReady(successor);
    EXPECT_TRUE(successor.isRequested());
    const std::string said = test::refusal([&] { (void)successor.take(); });
    EXPECT_NE(said.find("distance[0]"), std::string::npos) << said;
    EXPECT_FALSE(successor.isRequested());
    EXPECT_EQ(buffersOnDevice(), before) << "nothing of what was refused is kept";
    successor.request(requestOf(good, 4));
    EXPECT_NE(successor.take().simulation, nullptr);
    successor.request({test::device(), []() -> Scene { throw std::invalid_argument("no such scene"); }, {}});
    EXPECT_EQ(test::refusal([&] { (void)successor.take(); }), "no such scene");
}

TEST(Successor, OfTwoRequestsIsTheLater) {
    const Scene scene = test::chain(6);
    const std::uint32_t before = buffersOnDevice();
    for (const bool isFinished : {false, true}) {
        std::uint32_t atSecond = ~0u;
        Successor successor;
        successor.request(requestOf(scene, 4));
        if (isFinished) awaitReady(successor);
        successor.request({test::device(),
                           [&] {
                               atSecond = buffersOnDevice();
                               return scene;
                           },
                           withSubsteps(6)});
        const Successor::Made made = successor.take();
        ASSERT_NE(made.simulation, nullptr);
        EXPECT_EQ(made.settings.substeps, 6u);
        EXPECT_EQ(atSecond, before) << "the first is destroyed before the second is made";
    }
}

TEST(Successor, SkipsRequestsThatOthersReplacedBeforeTheyBegan) {
    const Scene scene = test::chain(6);
    std::latch hasBegun(1), mayGoOn(1);
    int skipped = 0;
    Successor successor;
    successor.request({test::device(),
                       [&] {
                           hasBegun.count_down();
                           mayGoOn.wait();
                           return scene;
                       },
                       withSubsteps(4)});
    hasBegun.wait(); // or it would be skipped as well, and the next one could begin
    for (std::uint32_t substeps = 5; substeps < 9; ++substeps)
        successor.request({test::device(),
                           [&] {
                               ++skipped;
                               return scene;
                           },
                           withSubsteps(substeps)});
    successor.request(requestOf(scene, 9)); // none of which has waited
    EXPECT_FALSE(successor.isReady());
    mayGoOn.count_down();
    EXPECT_EQ(successor.take().settings.substeps, 9u);
    EXPECT_EQ(skipped, 0);
}

TEST(Successor, ThatIsDroppedLeavesTheDevice) {
    const Scene scene = test::chain(6);
    const std::uint32_t before = buffersOnDevice();
    Successor successor;
    for (const bool isFinished : {false, true}) {
        successor.request(requestOf(scene, 4));
        if (isFinished) {
            awaitReady(successor);
            EXPECT_GT(buffersOnDevice(), before);
        }
        successor.drop();
        EXPECT_FALSE(successor.isRequested());
        EXPECT_FALSE(successor.isReady());
        EXPECT_TRUE(comesToBuffers(before));
    }
    successor.drop(); // nothing
    successor.request(requestOf(scene, 5));
    successor.drop();
    successor.request(requestOf(scene, 6));
    EXPECT_EQ(successor.take().settings.substeps, 6u);
    EXPECT_TRUE(comesToBuffers(before));
}

TEST(Successor, IsWaitedForByItsOwner) {
    const std::uint32_t before = buffersOnDevice();
    bool hasBegun = false;
    {
        Successor successor;
        std::latch begins(1);
        successor.request({test::device(),
                           [&] {
                               begins.count_down();
                               std::this_thread::sleep_for(std::chrono::milliseconds(20));
                               hasBegun = true;
                               return test::chain(6);
                           },
                           withSubsteps(4)});
        begins.wait();
    }
    EXPECT_TRUE(hasBegun);
    EXPECT_EQ(buffersOnDevice(), before);
}
