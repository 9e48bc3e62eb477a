// Tests of GPU times of spans.
#include "support/device.hpp"
#include "support/host_device.hpp"
#include "test_kernels.hpp"

#include "sinew/vk/timestamps.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace sinew::test {

TEST(Timestamps, GiveADurationForEachRecordedSpan) {
    vk::Timestamps timestamps(device(), 3);
    const vk::Buffer buffer(device(), {.name = "filled", .count = 1 << 18, .stride = 4});
    VkCommandBuffer handle = queue().begin();
    vk::Commands commands(device(), handle);
    timestamps.reset(commands);
    for (std::uint32_t span = 0; span < 2; ++span) {
        timestamps.begin(commands, span);
        commands.fill(buffer.view(), span);
        commands.barrier();
        timestamps.end(commands, span);
    }
    queue().wait(queue().submit(handle));
    const std::vector<double> durations = timestamps.milliseconds();
    ASSERT_EQ(durations.size(), 2u);
    for (const double duration : durations) {
        EXPECT_GT(duration, 0);
        EXPECT_LT(duration, 60e3); // detects a wrong unit of the period
    }
}

TEST(Timestamps, StartAnewAfterReset) {
    vk::Timestamps timestamps(device(), 2);
    for (const std::size_t spans : {2u, 1u, 0u}) {
        VkCommandBuffer handle = queue().begin();
        vk::Commands commands(device(), handle);
        timestamps.reset(commands);
        for (std::uint32_t span = 0; span < spans; ++span) {
            timestamps.begin(commands, span);
            timestamps.end(commands, span);
        }
        queue().wait(queue().submit(handle));
        EXPECT_EQ(timestamps.milliseconds().size(), spans);
    }
}

namespace {

PFN_vkGetPhysicalDeviceQueueFamilyProperties realFamilies = nullptr;
std::uint32_t pretendedBits = 0;
void VKAPI_CALL familiesWithBits(VkPhysicalDevice physical, std::uint32_t* count,
                                 VkQueueFamilyProperties* families) {
    realFamilies(physical, count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i)
        families[i].timestampValidBits = pretendedBits;
}

VkResult VKAPI_CALL wrappedTicks(VkDevice, VkQueryPool, std::uint32_t, std::uint32_t, std::size_t, void* data,
                                 VkDeviceSize, VkQueryResultFlags) {
    const std::uint64_t ticks[] = {0xfffffff0, 0x10}; // 32 ticks with an overflow of a 32-bit counter
    std::memcpy(data, ticks, sizeof ticks);
    return VK_SUCCESS;
}

/// Records one span on a host's device whose queue family has `bits` valid bits.
std::vector<double> spanWithBits(HostDevice& host, std::uint32_t bits, double& period) {
    realFamilies = host.instanceFunctions().vkGetPhysicalDeviceQueueFamilyProperties;
    pretendedBits = bits;
    host.replace("vkGetPhysicalDeviceQueueFamilyProperties",
                 reinterpret_cast<PFN_vkVoidFunction>(&familiesWithBits));
    const vk::Device borrowed = vk::Device::borrow(host.handles());
    period = static_cast<double>(borrowed.limits().timestampPeriod);
    vk::Timestamps timestamps(borrowed, 1);
    host.submit([&](VkCommandBuffer handle) {
        vk::Commands commands(borrowed, handle);
        timestamps.reset(commands);
        timestamps.begin(commands, 0);
        timestamps.end(commands, 0);
    });
    return timestamps.milliseconds();
}

} // namespace

TEST(Timestamps, AreEmptyOnAFamilyThatWritesNone) {
    HostDevice host;
    double period = 0;
    EXPECT_TRUE(spanWithBits(host, 0, period).empty());
    EXPECT_EQ(period, 0);
}

TEST(Timestamps, SurviveTheEndOfANarrowCounter) {
    HostDevice host;
    host.replace("vkGetQueryPoolResults", reinterpret_cast<PFN_vkVoidFunction>(&wrappedTicks));
    double period = 0;
    const std::vector<double> durations = spanWithBits(host, 32, period);
    ASSERT_EQ(durations.size(), 1u);
    EXPECT_DOUBLE_EQ(durations[0], 32 * period * 1e-6);
}

} // namespace sinew::test
