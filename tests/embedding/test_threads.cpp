// Tests an engine with three frames in flight and two threads: one records and submits steps, the other one
// draws from the same buffers, on a queue of its own where the device has two.
#include "embedding/soft_bodies.hpp"
#include "sinew/vk/check.hpp"
#include "support/host_device.hpp"

#include <gtest/gtest.h>

#include <array>
#include <condition_variable>
#include <cstring>
#include <future>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace sinew::test {
namespace {

constexpr std::size_t inFlight = 3;
constexpr std::uint64_t frames = 24, stepsPerFrame = 2;

using Position = std::array<float, 4>;

// A command buffer that is recorded again when the device is done with it.
class Slot {
public:
    explicit Slot(const HostDevice& host) : functions_(host.functions()), device_(host.handles().device) {
        const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                               .queueFamilyIndex = host.queueFamily()};
        vk::check(functions_.vkCreateCommandPool(device_, &poolInfo, nullptr, &pool_), "pool", "the host");
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = pool_,
                                               .commandBufferCount = 1};
        vk::check(functions_.vkAllocateCommandBuffers(device_, &info, &commands_), "commands", "the host");
        const VkFenceCreateInfo fenceInfo{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                          .flags = VK_FENCE_CREATE_SIGNALED_BIT};
        vk::check(functions_.vkCreateFence(device_, &fenceInfo, nullptr, &fence_), "fence", "the host");
        const VkSemaphoreCreateInfo semaphoreInfo{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        vk::check(functions_.vkCreateSemaphore(device_, &semaphoreInfo, nullptr, &done_), "semaphore",
                  "the host");
    }
    ~Slot() {
        functions_.vkDestroySemaphore(device_, done_, nullptr);
        functions_.vkDestroyFence(device_, fence_, nullptr);
        functions_.vkDestroyCommandPool(device_, pool_, nullptr);
    }
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;

    void wait() const {
        vk::check(functions_.vkWaitForFences(device_, 1, &fence_, VK_TRUE, 20'000'000'000), "fence",
                  "the host");
    }
    VkCommandBuffer begin() {
        vk::check(functions_.vkResetFences(device_, 1, &fence_), "vkResetFences", "the host");
        const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
        vk::check(functions_.vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer", "the host");
        return commands_;
    }
    /// Submits behind `before`, unless it is null, and lets done() follow.
    void submit(VkQueue queue, std::mutex& queues, VkSemaphore before) {
        vk::check(functions_.vkEndCommandBuffer(commands_), "vkEndCommandBuffer", "the host");
        const VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
        const VkSubmitInfo info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                .waitSemaphoreCount = before == VK_NULL_HANDLE ? 0u : 1u,
                                .pWaitSemaphores = &before,
                                .pWaitDstStageMask = &all,
                                .commandBufferCount = 1,
                                .pCommandBuffers = &commands_,
                                .signalSemaphoreCount = 1,
                                .pSignalSemaphores = &done_};
        const std::lock_guard lock(queues); // both threads may use the same queue
        vk::check(functions_.vkQueueSubmit(queue, 1, &info, fence_), "vkQueueSubmit", "the host");
    }
    VkSemaphore done() const { return done_; }

private:
    const vk::DeviceFunctions& functions_;
    VkDevice device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkSemaphore done_ = VK_NULL_HANDLE;
};

// Number of frames that a thread has submitted, for the other one to wait for.
class Progress {
public:
    void advance() {
        const std::lock_guard lock(mutex_);
        ++frames_;
        changed_.notify_all();
    }
    void waitFor(std::uint64_t wanted) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return frames_ >= wanted || isStopped_; });
        if (isStopped_) throw std::runtime_error("the other thread failed");
    }
    void stop() {
        const std::lock_guard lock(mutex_);
        isStopped_ = true;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::uint64_t frames_ = 0;
    bool isStopped_ = false;
};

struct Engine {
    explicit Engine(HostDevice& device)
        : host(device), borrowed(vk::Device::borrow(device.handles())),
          simulation(borrowed, SoftBodies::makeScene(),
                     {.substeps = 4, .framesInFlight = inFlight * stepsPerFrame}) {
        for (std::size_t i = 0; i < inFlight; ++i) {
            stepping[i] = std::make_unique<Slot>(host);
            drawing[i] = std::make_unique<Slot>(host);
            const vk::BufferView view = simulation.positions();
            pictures.emplace_back(borrowed, vk::BufferRequest{.name = "picture",
                                                              .count = view.size / view.stride,
                                                              .stride = view.stride,
                                                              .kind = vk::MemoryKind::readback});
        }
    }

    void play() {
        std::future<void> drawer = std::async(std::launch::async, [this] { untilItFails([&] { draw(); }); });
        untilItFails([&] { step(); });
        drawer.get();
        for (std::size_t i = 0; i < inFlight; ++i) {
            stepping[i]->wait();
            drawing[i]->wait();
        }
    }

    // The other thread waits for this one's frames: it ends too.
    template <typename Part> void untilItFails(const Part& part) {
        try {
            part();
        } catch (...) {
            stepped.stop();
            drawn.stop();
            throw;
        }
    }

    void step() {
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            Slot& slot = *stepping[frame % inFlight];
            slot.wait();
            if (frame >= inFlight)
                for (std::uint64_t s = 0; s < stepsPerFrame; ++s)
                    finished += simulation.status((frame - inFlight) * stepsPerFrame + s).isFinished;
            const VkCommandBuffer commands = slot.begin();
            if (frame == 0) simulation.recordReset(commands);
            for (std::uint64_t s = 0; s < stepsPerFrame; ++s)
                simulation.record(commands, {.dt = 1.0f / 120, .frame = frame * stepsPerFrame + s});
            drawn.waitFor(frame); // a semaphore must be signalled by what was submitted before
            slot.submit(host.queue(0), queues,
                        frame == 0 ? VK_NULL_HANDLE : drawing[(frame - 1) % inFlight]->done());
            stepped.advance();
        }
    }

    void draw() {
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            Slot& slot = *drawing[frame % inFlight];
            vk::Buffer& picture = pictures[frame % inFlight];
            slot.wait();
            if (frame >= inFlight) keep(picture);
            vk::Commands commands(borrowed, slot.begin());
            commands.copy(simulation.positions(), picture.view());
            commands.hostBarrier();
            stepped.waitFor(frame + 1);
            slot.submit(host.queue(1), queues, stepping[frame % inFlight]->done());
            drawn.advance();
        }
    }

    void keep(const vk::Buffer& picture) {
        std::vector<Position> positions(picture.view().size / sizeof(Position));
        std::memcpy(positions.data(), picture.mapped(), picture.view().size);
        kept.push_back(std::move(positions));
    }

    HostDevice& host;
    vk::Device borrowed;
    sim::Simulation simulation;
    std::array<std::unique_ptr<Slot>, inFlight> stepping, drawing;
    std::vector<vk::Buffer> pictures;
    std::mutex queues;
    Progress stepped, drawn;
    std::uint64_t finished = 0;
    std::vector<std::vector<Position>> kept; // positions that were drawn, by frame
};

TEST(Threads, StepAndDrawWithThreeFramesInFlightWithoutAMessage) {
    HostDevice host({.queues = 2});
    RecordProperty("queues", static_cast<int>(host.queueCount()));
    std::vector<std::vector<Position>> kept, alone;
    {
        Engine engine(host);
        engine.play();
        kept = std::move(engine.kept);
        EXPECT_EQ(engine.finished, (frames - inFlight) * stepsPerFrame);
        EXPECT_EQ(engine.simulation.complaints(), std::vector<std::string>{});
    }
    {
        Engine engine(host); // each frame on its own
        for (std::uint64_t frame = 0; frame < frames - inFlight; ++frame) {
            host.submit([&](VkCommandBuffer buffer) {
                if (frame == 0) engine.simulation.recordReset(buffer);
                for (std::uint64_t s = 0; s < stepsPerFrame; ++s)
                    engine.simulation.record(buffer, {.dt = 1.0f / 120, .frame = frame * stepsPerFrame + s});
                vk::Commands commands(engine.borrowed, buffer);
                commands.copy(engine.simulation.positions(), engine.pictures[0].view());
                commands.hostBarrier();
            });
            engine.keep(engine.pictures[0]);
        }
        alone = std::move(engine.kept);
    }
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
    ASSERT_EQ(kept.size(), frames - inFlight);
    for (std::size_t frame = 0; frame < kept.size(); ++frame)
        EXPECT_EQ(kept[frame], alone[frame]) << "frame " << frame;
}

} // namespace
} // namespace sinew::test
