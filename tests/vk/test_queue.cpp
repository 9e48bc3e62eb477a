// Tests of submission, reuse of command buffers, and transfers.
#include "support/device.hpp"

#include "sinew/vk/check.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace sinew::test {

TEST(Queue, CountsSubmissionsUpwards) {
    vk::Queue own(device());
    EXPECT_EQ(own.submitted(), 0u);
    for (std::uint64_t value = 1; value <= 3; ++value) EXPECT_EQ(own.submit(own.begin()), value);
    own.wait(3);
    EXPECT_EQ(own.submitted(), 3u);
}

TEST(Queue, ReusesACommandBufferOnceItsSubmissionHasFinished) {
    vk::Queue own(device());
    VkCommandBuffer first = own.begin();
    own.wait(own.submit(first));
    EXPECT_EQ(own.begin(), first);
}

TEST(Queue, NeverReusesOneThatIsStillRecording) {
    vk::Queue own(device());
    VkCommandBuffer first = own.begin();
    VkCommandBuffer second = own.begin();
    EXPECT_NE(first, second);
    own.submit(second);
    own.submit(first);
    own.waitIdle();
}

TEST(Queue, CarriesBytesThereAndBackBeyondTheStagingSize) {
    std::vector<std::uint32_t> sent((20u << 20) / 4 + 1); // slightly more than 20 MiB
    std::iota(sent.begin(), sent.end(), 17u);
    const vk::Buffer buffer = upload("large", sent);
    EXPECT_EQ(queue().download<std::uint32_t>(buffer.view()), sent);
}

TEST(Queue, CarriesAPartOfABuffer) {
    const vk::Buffer buffer = upload<std::uint32_t>("values", {1, 2, 3, 4, 5, 6});
    const std::uint32_t news[] = {30, 40};
    queue().upload({buffer.view().buffer, 8, 8, 4}, news, sizeof news);
    EXPECT_EQ(queue().download<std::uint32_t>({buffer.view().buffer, 4, 16, 4}),
              (std::vector<std::uint32_t>{2, 30, 40, 5}));
}

TEST(Queue, RefusesATransferBeyondTheView) {
    const vk::Buffer buffer(device(), {.name = "values", .count = 2, .stride = 4});
    const std::uint32_t three[] = {1, 2, 3};
    EXPECT_THROW(queue().upload(buffer.view(), three, sizeof three), vk::Error);
    EXPECT_THROW(queue().upload(buffer.view(), three, 3), vk::Error);
}

} // namespace sinew::test
