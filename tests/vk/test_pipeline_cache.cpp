// Pipelines of an earlier run: bytes go out and come back, and only whole ones reach the driver.
#include "support/device.hpp"
#include "support/host_device.hpp"
#include "vk/pipeline_cache.hpp"

#include <gtest/gtest.h>

namespace sinew::test {
namespace {

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
    std::vector<std::byte> bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

TEST(PipelineCache, DataComeBackFromWholeBytesAlone) {
    const std::vector<std::byte> data = bytesOf({1, 2, 3, 4, 5});
    const std::vector<std::byte> whole = vk::sealed(data);
    EXPECT_TRUE(std::ranges::equal(vk::unsealed(whole), data));
    EXPECT_TRUE(vk::unsealed(vk::sealed({})).empty());
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_TRUE(vk::unsealed(std::span(whole).first(size)).empty()) << size;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::vector<std::byte> damaged = whole;
        damaged[i] ^= std::byte{16};
        EXPECT_TRUE(vk::unsealed(damaged).empty()) << i;
    }
}

PFN_vkCreatePipelineCache createOriginal = nullptr;
std::vector<std::byte> passed; // to the driver

VkResult keepPassed(VkDevice device, const VkPipelineCacheCreateInfo* info,
                    const VkAllocationCallbacks* calls, VkPipelineCache* cache) {
    const auto* data = static_cast<const std::byte*>(info->pInitialData);
    passed.assign(data, data + info->initialDataSize);
    return createOriginal(device, info, calls, cache);
}

TEST(PipelineCache, OfAHostReachesTheDriver) {
    HostDevice host;
    createOriginal = reinterpret_cast<PFN_vkCreatePipelineCache>(host.original("vkCreatePipelineCache"));
    host.replace("vkCreatePipelineCache", reinterpret_cast<PFN_vkVoidFunction>(&keepPassed));
    std::vector<std::byte> kept;
    {
        const vk::Device first = vk::Device::borrow(host.handles());
        EXPECT_TRUE(passed.empty());
        kept = first.pipelineCacheData();
    }
    const std::span<const std::byte> data = vk::unsealed(kept);
    ASSERT_GE(data.size(), 32u); // at least the header that Vulkan prescribes
    vk::HostDevice handles = host.handles();
    handles.pipelineCache = kept;
    { const vk::Device second = vk::Device::borrow(handles); }
    EXPECT_TRUE(std::ranges::equal(passed, data));
    kept.back() ^= std::byte{1};
    { const vk::Device third = vk::Device::borrow(handles); }
    EXPECT_TRUE(passed.empty()) << "damaged bytes reached the driver";
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

} // namespace
} // namespace sinew::test
