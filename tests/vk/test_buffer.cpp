// Tests of buffers: sizes, names, moves.
#include "support/device.hpp"

#include "sinew/vk/check.hpp"
#include "vk/allocator.hpp"

#include <gtest/gtest.h>

namespace sinew::test {

namespace {

vk::Error errorOf(const vk::BufferRequest& request) {
    try {
        const vk::Buffer buffer(device(), request);
    } catch (const vk::Error& error) {
        return error;
    }
    throw std::logic_error("buffer " + request.name + " was made");
}

} // namespace

TEST(Buffer, ViewsAllItsElements) {
    const vk::Buffer buffer(device(), {.name = "values", .count = 65, .stride = 12});
    EXPECT_EQ(buffer.view().size, 65u * 12u);
    EXPECT_EQ(buffer.view().stride, 12u);
    EXPECT_EQ(buffer.count(), 65u);
    EXPECT_EQ(buffer.name(), "values");
}

TEST(Buffer, WithoutElementsCanStillBeBound) {
    const vk::Buffer buffer(device(), {.name = "empty", .count = 0, .stride = 16});
    EXPECT_EQ(buffer.count(), 0u);
    EXPECT_EQ(buffer.view().size, 16u);
}

TEST(Buffer, MayFillMaxStorageBufferRangeButNotExceedIt) {
    const VkDeviceSize largest = device().limits().maxStorageBufferRange;
    if (largest <= 256u << 20) { // a machine may lack the memory for larger ones
        EXPECT_NO_THROW(vk::Buffer(device(), {.name = "full", .count = largest / 16, .stride = 16}));
    }
    const vk::Error error = errorOf({.name = "lattice.links", .count = largest / 16 + 1, .stride = 16});
    EXPECT_EQ(error.failure(), vk::Failure::outOfMemory);
    const std::string message = error.what();
    EXPECT_NE(message.find("lattice.links"), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(largest / 16 + 1)), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(largest)), std::string::npos) << message;
}

TEST(Buffer, RefusesASizeThatOverflows) {
    EXPECT_EQ(errorOf({.name = "huge", .count = ~VkDeviceSize{0} / 2, .stride = 16}).failure(),
              vk::Failure::outOfMemory);
}

TEST(Buffer, RefusesAStrideThatIsNoMultipleOfFour) {
    EXPECT_EQ(errorOf({.name = "bytes", .count = 4, .stride = 3}).failure(), vk::Failure::misuse);
    EXPECT_EQ(errorOf({.name = "nothing", .count = 4, .stride = 0}).failure(), vk::Failure::misuse);
}

TEST(Buffer, IsMappedForUploadAndReadback) {
    for (const vk::MemoryKind kind : {vk::MemoryKind::upload, vk::MemoryKind::readback}) {
        const vk::Buffer buffer(device(), {.name = "mapped", .count = 4, .stride = 4, .kind = kind});
        EXPECT_NE(buffer.mapped(), nullptr);
    }
}

TEST(Buffer, MovesWithoutReleasingTwice) {
    const std::uint32_t before = device().allocator().statistics().buffers;
    {
        vk::Buffer first(device(), {.name = "first", .count = 4, .stride = 4});
        const VkBuffer handle = first.view().buffer;
        vk::Buffer second(std::move(first));
        EXPECT_EQ(second.view().buffer, handle);
        vk::Buffer third(device(), {.name = "third", .count = 4, .stride = 4});
        third = std::move(second);
        EXPECT_EQ(third.view().buffer, handle);
        EXPECT_EQ(device().allocator().statistics().buffers, before + 1);
    }
    EXPECT_EQ(device().allocator().statistics().buffers, before);
}

TEST(Buffer, IsNamedInValidationMessages) {
    const vk::Buffer buffer(device(), {.name = "cloth.positions", .count = 4, .stride = 4});
    VkCommandBuffer commands = queue().begin();
    device().functions().vkCmdFillBuffer(commands, buffer.view().buffer, 1024, 4, 0); // beyond its end
    queue().wait(queue().submit(commands));
    const auto messages = takeMessages();
    ASSERT_FALSE(messages.empty());
    EXPECT_NE(messages[0].find("cloth.positions"), std::string::npos) << messages[0];
}

} // namespace sinew::test
