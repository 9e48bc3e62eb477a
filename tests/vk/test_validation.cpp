// Deliberate hazards. A hazard that the installed layer reports must stay reported, because the other device
// tests rely on it. A hazard that it does not report fails the test as soon as a layer reports it.
#include "support/device.hpp"
#include "support/host_device.hpp"
#include "test_kernels.hpp"

#include "vk/environment.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>

namespace sinew::test {

namespace {

using Access = VkAccessFlags;
using Stages = VkPipelineStageFlags;

constexpr Stages compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, transfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr Access shaderWrite = VK_ACCESS_SHADER_WRITE_BIT, shaderRead = VK_ACCESS_SHADER_READ_BIT;

struct Barrier {
    Stages from = compute, to = compute;
    Access written = shaderWrite, visible = shaderRead | shaderWrite;
};

/// Three buffers, a kernel for each kind of access, and the passes of all hazards below.
class Hazard {
public:
    Hazard(const vk::Device& device, vk::Queue& queue)
        : device_(device), queue_(queue), a_(buffer("a")), b_(buffer("b")), c_(buffer("c")),
          arguments_(
              device,
              {.name = "arguments", .count = 1, .stride = 16, .usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}),
          copy_(device, kernels::copyValues, {}), add_(device, kernels::addOne, {}),
          addTwiceBound_(device, kernels::addOneTwiceBound, {}), shift_(device, kernels::shiftValues, {}),
          writeArguments_(device, kernels::writeArguments, {}), sets_(makeSets()) {
        begin();
        for (const vk::Buffer* each : {&a_, &b_, &c_, &arguments_}) commands_->fill(each->view(), 1);
        commands_->endStep();
        commands_->hostBarrier();
        submit();
        queue_.waitIdle();
    }

    void begin() {
        recording_ = queue_.begin();
        commands_.emplace(device_, recording_);
    }
    void copyAToB() { pass(copy_, 0); }
    void copyBToC() { pass(copy_, 1); }
    void copyBToA() { pass(copy_, 2); }
    void copyAToA() { pass(copy_, 3); } ///< bound both as readonly and as writeonly
    void addToA() { pass(add_, 4); }
    void addToATwiceBound() { pass(addTwiceBound_, 5); }
    void shiftA() { pass(shift_, 6); }
    void writeArguments() { pass(writeArguments_, 7); }
    void fillA() { commands_->fill(a_.view(), 3); }
    void transferAToC() { commands_->copy(a_.view(), c_.view()); }
    void dispatchByArguments() {
        commands_->bind(copy_, sets_[0]);
        device_.functions().vkCmdDispatchIndirect(recording_, arguments_.view().buffer, 0);
    }
    void barrier(const Barrier& barrier) {
        const VkMemoryBarrier memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = barrier.written,
                                     .dstAccessMask = barrier.visible};
        device_.functions().vkCmdPipelineBarrier(recording_, barrier.from, barrier.to, 0, 1, &memory, 0,
                                                 nullptr, 0, nullptr);
    }
    void submit() { queue_.submit(recording_); }
    VkCommandBuffer recording() const { return recording_; }
    const vk::Buffer& a() const { return a_; }

private:
    vk::Buffer buffer(const char* name) {
        return {device_, {.name = name, .count = 64, .stride = 4, .kind = vk::MemoryKind::readback}};
    }
    vk::BindingSets makeSets() {
        const vk::BindingRequest requests[] = {{&copy_, {a_.view(), b_.view()}},
                                               {&copy_, {b_.view(), c_.view()}},
                                               {&copy_, {b_.view(), a_.view()}},
                                               {&copy_, {a_.view(), a_.view()}},
                                               {&add_, {a_.view()}},
                                               {&addTwiceBound_, {a_.view(), a_.view()}},
                                               {&shift_, {a_.view()}},
                                               {&writeArguments_, {arguments_.view()}}};
        return {device_, requests};
    }
    void pass(const vk::Kernel& kernel, std::size_t set) {
        commands_->bind(kernel, sets_[set]);
        commands_->dispatch(1);
    }

    const vk::Device& device_;
    vk::Queue& queue_;
    vk::Buffer a_, b_, c_, arguments_;
    vk::Kernel copy_, add_, addTwiceBound_, shift_, writeArguments_;
    vk::BindingSets sets_;
    VkCommandBuffer recording_ = VK_NULL_HANDLE;
    std::optional<vk::Commands> commands_;
};

/// Messages of the layer for these passes in one command buffer, until they have finished.
std::vector<std::string> messagesOf(const std::function<void(Hazard&)>& record) {
    Hazard hazard(device(), queue());
    EXPECT_EQ(takeMessages(), std::vector<std::string>{}) << "before the hazard";
    hazard.begin();
    record(hazard);
    hazard.submit();
    queue().waitIdle();
    return takeMessages();
}

void expectReported(const char* kind, const std::function<void(Hazard&)>& record) {
    const auto messages = messagesOf(record);
    ASSERT_FALSE(messages.empty()) << "the layer has stopped seeing this: tests prove less than they claim";
    EXPECT_NE(messages[0].find(kind), std::string::npos) << messages[0];
}

void expectMissed(const std::function<void(Hazard&)>& record) {
    EXPECT_EQ(messagesOf(record), std::vector<std::string>{})
        << "the layer sees this now: good news, correct what docs and tests say";
}

constexpr const char* readAfterWrite = "READ_AFTER_WRITE";
constexpr const char* writeAfterRead = "WRITE_AFTER_READ";
constexpr const char* writeAfterWrite = "WRITE_AFTER_WRITE";

} // namespace

TEST(Layer, ReportsADispatchThatReadsWhatTheLastOneWrote) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.copyAToB();
        hazard.copyBToC();
    });
}

TEST(Layer, ReportsADispatchThatWritesWhatTheLastOneRead) {
    expectReported(writeAfterRead, [](Hazard& hazard) {
        hazard.copyBToC();
        hazard.copyAToB();
    });
}

TEST(Layer, MissesTwoDispatchesThatWorkInPlace) {
    expectMissed([](Hazard& hazard) {
        hazard.addToA();
        hazard.addToA();
    });
}

TEST(Layer, ReportsABufferBoundForReadingAndForWriting) {
    expectReported("AFTER_", [](Hazard& hazard) {
        hazard.copyAToA();
        hazard.copyAToA();
    });
}

TEST(Layer, ReportsABarrierOfExecutionAlone) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.copyAToB();
        hazard.barrier({.written = 0, .visible = 0});
        hazard.copyBToC();
    });
}

TEST(Layer, ReportsABarrierWithTheWrongSourceStage) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.copyAToB();
        hazard.barrier({.from = transfer, .written = VK_ACCESS_TRANSFER_WRITE_BIT});
        hazard.copyBToC();
    });
}

TEST(Layer, ReportsABarrierWithoutTheSourceAccess) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.copyAToB();
        hazard.barrier({.written = shaderRead});
        hazard.copyBToC();
    });
}

TEST(Layer, ReportsABarrierWithoutTheDestinationAccess) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.copyAToB();
        hazard.barrier({.visible = VK_ACCESS_UNIFORM_READ_BIT});
        hazard.copyBToC();
    });
}

TEST(Layer, ReportsPingPongWithoutABarrier) {
    expectReported("AFTER_", [](Hazard& hazard) {
        hazard.copyAToB();
        hazard.copyBToA();
    });
}

TEST(Layer, MissesABarrierOfExecutionAloneBetweenPassesInPlace) {
    expectMissed([](Hazard& hazard) {
        hazard.addToA();
        hazard.barrier({.written = 0, .visible = 0});
        hazard.addToA();
    });
}

// A build for tests may bind the buffer of a pass in place twice, because the layer then reports both hazards
// above.
TEST(Layer, ReportsPassesInPlaceThatBindTheirBufferTwice) {
    expectReported("AFTER_", [](Hazard& hazard) {
        hazard.addToATwiceBound();
        hazard.addToATwiceBound();
    });
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.addToATwiceBound();
        hazard.barrier({.written = 0, .visible = 0});
        hazard.addToATwiceBound();
    });
}

TEST(Layer, ReportsADispatchAfterAFill) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.fillA();
        hazard.copyAToB();
    });
}

TEST(Layer, ReportsAFillAfterAFill) {
    expectReported(writeAfterWrite, [](Hazard& hazard) {
        hazard.fillA();
        hazard.fillA();
    });
}

TEST(Layer, ReportsACopyAfterADispatch) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.copyBToA();
        hazard.transferAToC();
    });
}

TEST(Layer, ReportsIndirectArgumentsWithoutTheirAccess) {
    expectReported(readAfterWrite, [](Hazard& hazard) {
        hazard.writeArguments();
        hazard.barrier({.to = VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | compute});
        hazard.dispatchByArguments();
    });
}

TEST(Layer, MissesAHostReadWithoutItsBarrier) {
    Hazard hazard(device(), queue());
    hazard.begin();
    hazard.addToA();
    hazard.submit();
    queue().waitIdle();
    const std::uint32_t value = *reinterpret_cast<const std::uint32_t*>(hazard.a().mapped());
    EXPECT_TRUE(value == 1 || value == 2) << value; // either order, because the hazard leaves it open
    EXPECT_EQ(takeMessages(), std::vector<std::string>{});
}

TEST(Layer, MissesARaceInsideOneDispatch) {
    expectMissed([](Hazard& hazard) { hazard.shiftA(); });
}

namespace {

/// Messages of two submissions on a separate device, the second of which reads what the first writes.
std::vector<std::string> messagesAcrossSubmissions(bool areOneSubmit) {
    const vk::Device own = vk::Device::create(device().getInstanceProcAddr(), {.hasValidation = true});
    vk::Queue queue(own);
    Hazard hazard(own, queue);
    EXPECT_EQ(own.validationMessages(), std::vector<std::string>{}) << "before the hazard";
    hazard.begin();
    hazard.copyAToB();
    if (areOneSubmit) {
        const VkCommandBuffer first = hazard.recording();
        own.functions().vkEndCommandBuffer(first);
        hazard.begin();
        hazard.copyBToC();
        const VkCommandBuffer both[] = {first, hazard.recording()};
        own.functions().vkEndCommandBuffer(both[1]);
        const VkSubmitInfo info{
            .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 2, .pCommandBuffers = both};
        own.functions().vkQueueSubmit(queue.handle(), 1, &info, VK_NULL_HANDLE);
    } else {
        hazard.submit();
        hazard.begin();
        hazard.copyBToC();
        hazard.submit();
    }
    queue.waitIdle();
    return own.validationMessages();
}

} // namespace

TEST(Layer, LooksAcrossCommandBuffersAndSubmissionsWithItsSwitch) {
    for (const bool areOneSubmit : {true, false}) {
        const auto messages = messagesAcrossSubmissions(areOneSubmit);
        ASSERT_FALSE(messages.empty()) << areOneSubmit;
        EXPECT_NE(messages[0].find(readAfterWrite), std::string::npos) << messages[0];
    }
}

TEST(Layer, LooksAcrossNothingWithoutItsSwitch) {
    device(); // the shared device must read the variable before it is restored
    vk::setVariable("VK_LAYER_ENABLES", nullptr);
    for (const bool areOneSubmit : {true, false})
        EXPECT_EQ(messagesAcrossSubmissions(areOneSubmit), std::vector<std::string>{})
            << "the switch is no longer needed: drop it";
    vk::enableQueueSubmitValidation();
}

TEST(Layer, ReportsWhatLeaksByName) {
    HostDevice host;
    {
        const vk::Device borrowed = vk::Device::borrow(host.handles());
        const VkFenceCreateInfo info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        VkFence fence = VK_NULL_HANDLE;
        host.functions().vkCreateFence(borrowed.handle(), &info, nullptr, &fence);
        borrowed.name(VK_OBJECT_TYPE_FENCE, vk::handleValue(fence), "forgotten");
    }
    const auto messages = host.finish();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("forgotten"), std::string::npos) << messages[0];
}

namespace {

/// Messages of a dispatch that writes `past` elements behind the end of a buffer with its own memory.
std::vector<std::string> messagesOfWriteBehindEnd(bool isGpuAssisted, std::uint32_t past) {
    HostDevice host({.hasGpuAssistedValidation = isGpuAssisted});
    {
        const vk::Device borrowed = vk::Device::borrow(host.handles());
        const vk::Kernel kernel(borrowed, kernels::writeBehindEnd, {});
        const vk::Buffer buffer(borrowed, {.name = "values", .count = 4, .stride = 4});
        const vk::BindingRequest request{&kernel, {buffer.view()}};
        const vk::BindingSets sets(borrowed, {&request, 1});
        host.submit([&](VkCommandBuffer handle) {
            vk::Commands commands(borrowed, handle);
            commands.bind(kernel, sets[0]);
            commands.push(kernel, &past, sizeof past);
            commands.dispatch(1);
        });
    }
    return host.finish();
}

bool mentions(const std::vector<std::string>& messages, const char* part) {
    return std::any_of(messages.begin(), messages.end(),
                       [&](const std::string& message) { return message.find(part) != std::string::npos; });
}

} // namespace

TEST(Layer, FindsAWriteBehindTheEndOnTheGpuOnly) {
    constexpr const char* outOfBounds =
        "ut of bounds"; // the messages differ: "Descriptor index ..." and "Access ... out of bounds"
    EXPECT_TRUE(mentions(messagesOfWriteBehindEnd(true, 1), outOfBounds));
    EXPECT_FALSE(mentions(messagesOfWriteBehindEnd(true, 0), outOfBounds));
    EXPECT_EQ(messagesOfWriteBehindEnd(false, 1), std::vector<std::string>{});
}

// The order switch detects races that the layer misses. No device runs so many groups at the same time.
TEST(OrderSwitch, ShowsARaceInTwoRuns) {
    constexpr std::uint32_t groups = 1 << 14, groupSize = 64;
    std::vector<std::vector<std::uint32_t>> results;
    std::vector<std::uint32_t> start(std::size_t{groups} * groupSize);
    std::iota(start.begin(), start.end(), 0u);
    for (const std::uint32_t isReversed : {0u, 1u}) {
        const vk::SpecialisationConstant order{0, isReversed};
        const vk::Kernel kernel(device(), kernels::shiftValues, {&order, 1});
        const vk::Buffer buffer = upload("values", start);
        const vk::BindingRequest request{&kernel, {buffer.view()}};
        const vk::BindingSets sets(device(), {&request, 1});
        VkCommandBuffer handle = queue().begin();
        vk::Commands commands(device(), handle);
        commands.bind(kernel, sets[0]);
        commands.dispatch(groups);
        queue().submit(handle);
        results.push_back(queue().download<std::uint32_t>(buffer.view()));
    }
    EXPECT_FALSE(results[0] == results[1]); // too large to print
}

} // namespace sinew::test
