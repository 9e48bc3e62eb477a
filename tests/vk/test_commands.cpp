// Tests of recorded commands: correct results and correct stages.
#include "support/device.hpp"
#include "support/host_device.hpp"
#include "test_kernels.hpp"

#include "sinew/vk/commands.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace sinew::test {

namespace {

/// Records, submits and waits.
void run(const std::function<void(vk::Commands&)>& record) {
    VkCommandBuffer handle = queue().begin();
    vk::Commands commands(device(), handle);
    record(commands);
    queue().wait(queue().submit(handle));
}

std::vector<std::uint32_t> values(const vk::Buffer& buffer) {
    return queue().download<std::uint32_t>(buffer.view());
}

} // namespace

TEST(Commands, ChainDispatchesThroughBarriers) {
    const vk::Kernel kernel(device(), kernels::copyValues, {});
    for (const std::uint32_t count : {1u, 63u, 64u, 65u, 129u}) {
        std::vector<std::uint32_t> start(count);
        std::iota(start.begin(), start.end(), 0u);
        const vk::Buffer a = upload("a", start);
        const vk::Buffer b(device(), {.name = "b", .count = count, .stride = 4});
        const vk::BindingRequest requests[] = {{&kernel, {a.view(), b.view()}},
                                               {&kernel, {b.view(), a.view()}}};
        const vk::BindingSets sets(device(), requests);
        run([&](vk::Commands& commands) {
            commands.beginStep();
            for (std::size_t pass = 0; pass < 10; ++pass) {
                commands.bind(kernel, sets[pass % 2]);
                commands.dispatch((count + 63) / 64);
                commands.barrier();
            }
            commands.endStep();
        });
        const auto result = values(a);
        for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(result[i], i + 10) << "of " << count;
    }
}

TEST(Commands, SwitchBetweenKernelsAndSets) {
    const vk::Kernel add(device(), kernels::addOne, {}), copy(device(), kernels::copyValues, {});
    const vk::Buffer a = upload<std::uint32_t>("a", {1}), b = upload<std::uint32_t>("b", {10});
    const vk::BindingRequest requests[] = {
        {&add, {a.view()}}, {&add, {b.view()}}, {&copy, {a.view(), b.view()}}};
    const vk::BindingSets sets(device(), requests);
    run([&](vk::Commands& commands) {
        const auto pass = [&](const vk::Kernel& kernel, std::size_t set) {
            commands.beginLabel("pass");
            commands.bind(kernel, sets[set]);
            commands.dispatch(1);
            commands.barrier();
            commands.endLabel();
        };
        pass(add, 0);  // a = 2
        pass(add, 1);  // b = 11
        pass(add, 1);  // b = 12
        pass(copy, 2); // b = 3
        pass(add, 1);  // b = 4
    });
    EXPECT_EQ(values(a), std::vector<std::uint32_t>{2});
    EXPECT_EQ(values(b), std::vector<std::uint32_t>{4});
}

TEST(Commands, FillCopyAndUpdateReachTheRangeOfTheirView) {
    const vk::Buffer a(device(), {.name = "a", .count = 8, .stride = 4});
    const vk::Buffer b(device(), {.name = "b", .count = 8, .stride = 4});
    const std::uint32_t news[] = {21, 22};
    run([&](vk::Commands& commands) {
        commands.beginStep();
        commands.fill(a.view(), 7);
        commands.fill(b.view(), 1);
        commands.barrier();
        commands.update({a.view().buffer, 8, 16, 4}, news, sizeof news);
        commands.barrier();
        commands.copy({a.view().buffer, 4, 12, 4}, {b.view().buffer, 16, 12, 4});
        commands.endStep();
    });
    EXPECT_EQ(values(a), (std::vector<std::uint32_t>{7, 7, 21, 22, 7, 7, 7, 7}));
    EXPECT_EQ(values(b), (std::vector<std::uint32_t>{1, 1, 1, 1, 7, 21, 22, 1}));
}

TEST(Commands, PushConstantsArriveInTheKernel) {
    const vk::Kernel kernel(device(), kernels::writeBehindEnd, {});
    const vk::Buffer buffer = upload<std::uint32_t>("values", {1, 1, 1});
    const vk::BindingRequest request{&kernel, {buffer.view()}};
    const vk::BindingSets sets(device(), {&request, 1});
    run([&](vk::Commands& commands) {
        const std::uint32_t past = ~0u; // -1: the last index but one
        commands.bind(kernel, sets[0]);
        commands.push(kernel, &past, sizeof past);
        commands.dispatch(1);
    });
    EXPECT_EQ(values(buffer), (std::vector<std::uint32_t>{1, 7, 1}));
}

TEST(Commands, FetchTexelsOfEachElementSize) {
    const vk::Kernel kernel(device(), kernels::fetchTexels, {});
    constexpr std::uint32_t count = 100;
    for (const std::uint32_t components : {1u, 2u, 4u}) {
        std::vector<float> halves;
        std::vector<std::uint32_t> thousands;
        for (std::uint32_t k = 0; k < components * count; ++k) {
            halves.push_back(0.5f * static_cast<float>(k));
            thousands.push_back(1000 * k);
        }
        const vk::Buffer weights = upload("weights", halves), codes = upload("codes", thousands);
        const auto elements = [&](const vk::Buffer& buffer) {
            vk::BufferView view = buffer.view();
            view.stride = 4 * components;
            return view;
        };
        const vk::Buffer sums(device(), {.name = "sums", .count = count, .stride = 16});
        const vk::BindingRequest request{&kernel, {elements(weights), elements(codes), sums.view()}};
        const vk::BindingSets sets(device(), {&request, 1});
        run([&](vk::Commands& commands) {
            commands.bind(kernel, sets[0]);
            commands.dispatch(2);
        });
        const auto result = queue().download<std::array<float, 4>>(sums.view());
        for (std::uint32_t k = 0; k < components * count; ++k)
            ASSERT_EQ(result[k / components][k % components], 1000.5f * static_cast<float>(k))
                << components << " components";
    }
}

TEST(Commands, HandStepsOverToTheHostAndToTheNextStepWithoutWaiting) {
    const vk::Kernel kernel(device(), kernels::addOne, {});
    const vk::Buffer buffer = upload<std::uint32_t>("values", {0, 0, 0});
    const vk::Buffer result(device(),
                            {.name = "result", .count = 3, .stride = 4, .kind = vk::MemoryKind::readback});
    const vk::BindingRequest request{&kernel, {buffer.view()}};
    const vk::BindingSets sets(device(), {&request, 1});
    for (int step = 0; step < 5; ++step) {
        VkCommandBuffer handle = queue().begin();
        vk::Commands commands(device(), handle);
        commands.beginStep();
        commands.bind(kernel, sets[0]);
        commands.dispatch(1);
        commands.barrier();
        commands.copy(buffer.view(), result.view());
        commands.endStep();
        commands.hostBarrier();
        queue().submit(handle);
    }
    queue().waitIdle();
    const auto* mapped = reinterpret_cast<const std::uint32_t*>(result.mapped());
    EXPECT_EQ(std::vector<std::uint32_t>(mapped, mapped + 3), (std::vector<std::uint32_t>{5, 5, 5}));
}

namespace {

PFN_vkGetPhysicalDeviceQueueFamilyProperties realFamilies = nullptr;
VkQueueFlags hiddenFlags = 0;
void VKAPI_CALL familiesWithout(VkPhysicalDevice physical, std::uint32_t* count,
                                VkQueueFamilyProperties* families) {
    realFamilies(physical, count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i) families[i].queueFlags &= ~hiddenFlags;
}

struct Barrier {
    VkPipelineStageFlags from, to;
    VkAccessFlags fromAccess, toAccess;
};
std::vector<Barrier> barriers;
void VKAPI_CALL keepBarrier(VkCommandBuffer, VkPipelineStageFlags from, VkPipelineStageFlags to,
                            VkDependencyFlags, std::uint32_t, const VkMemoryBarrier* memory, std::uint32_t,
                            const VkBufferMemoryBarrier*, std::uint32_t, const VkImageMemoryBarrier*) {
    barriers.push_back({from, to, memory->srcAccessMask, memory->dstAccessMask});
}

/// The barriers of a step (begin, middle, end, hand-over to the host) on a queue family without the hidden
/// abilities.
std::vector<Barrier> barriersWithout(VkQueueFlags hidden) {
    HostDevice host;
    realFamilies = host.instanceFunctions().vkGetPhysicalDeviceQueueFamilyProperties;
    hiddenFlags = hidden;
    barriers.clear();
    host.replace("vkGetPhysicalDeviceQueueFamilyProperties",
                 reinterpret_cast<PFN_vkVoidFunction>(&familiesWithout));
    host.replace("vkCmdPipelineBarrier", reinterpret_cast<PFN_vkVoidFunction>(&keepBarrier));
    const vk::Device borrowed = vk::Device::borrow(host.handles());
    vk::Commands commands(borrowed, VK_NULL_HANDLE);
    commands.beginStep();
    commands.barrier();
    commands.endStep();
    commands.hostBarrier();
    return barriers;
}

constexpr VkPipelineStageFlags drawing =
    VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;

} // namespace

TEST(Barriers, NameVertexStagesAtBothEndsOfAStepOnlyWhereTheFamilyDraws) {
    const auto drawn = barriersWithout(0);
    ASSERT_EQ(drawn.size(), 4u);
    EXPECT_EQ(drawn[0].from & drawing, drawing);
    EXPECT_EQ(drawn[2].to & drawing, drawing);
    EXPECT_NE(drawn[2].toAccess & VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT, 0u);
    EXPECT_NE(drawn[2].toAccess & VK_ACCESS_INDEX_READ_BIT, 0u);
    const auto computed = barriersWithout(VK_QUEUE_GRAPHICS_BIT);
    ASSERT_EQ(computed.size(), 4u);
    for (const Barrier& barrier : computed) {
        EXPECT_EQ((barrier.from | barrier.to) & drawing, 0u);
        EXPECT_EQ(barrier.toAccess & (VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT), 0u);
    }
}

TEST(Barriers, CoverComputeTransferAndIndirectInTheMiddleOfAStep) {
    const Barrier barrier = barriersWithout(0).at(1);
    // A source stage includes those before it in the pipeline: a compute shader the reading of its arguments.
    constexpr VkPipelineStageFlags from =
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    EXPECT_EQ(barrier.from, from);
    EXPECT_EQ(barrier.to, from | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT);
    EXPECT_EQ(barrier.fromAccess, VkAccessFlags{VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT});
    EXPECT_EQ(barrier.toAccess,
              VkAccessFlags{VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                            VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                            VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT});
}

TEST(Barriers, ReachTheHostOnlyWhenAsked) {
    const auto all = barriersWithout(0);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(all[i].to & VK_PIPELINE_STAGE_HOST_BIT, 0u);
    EXPECT_EQ(all.at(3).to, VkPipelineStageFlags{VK_PIPELINE_STAGE_HOST_BIT});
    EXPECT_EQ(all.at(3).toAccess, VkAccessFlags{VK_ACCESS_HOST_READ_BIT});
}

} // namespace sinew::test
