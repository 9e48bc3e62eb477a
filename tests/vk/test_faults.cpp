// Lets every fallible Vulkan call fail in turn. Each failure must throw a vk::Error without leaks, and a
// second try must succeed.
#include "support/device.hpp"
#include "support/faults.hpp"
#include "test_kernels.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/timestamps.hpp"

#include <gtest/gtest.h>

namespace sinew::test {

namespace {

void makeSetUpFallible(HostDevice& host) {
    FALLIBLE(vkCreateInstance);
    FALLIBLE(vkEnumerateInstanceExtensionProperties);
    FALLIBLE(vkEnumerateInstanceLayerProperties);
    FALLIBLE(vkCreateDebugUtilsMessengerEXT);
    FALLIBLE(vkEnumeratePhysicalDevices);
    FALLIBLE(vkCreateDevice);
    FALLIBLE(vkCreatePipelineCache);
    FALLIBLE(vkCreateBuffer);
    FALLIBLE(vkAllocateMemory);
    FALLIBLE(vkMapMemory);
    FALLIBLE(vkBindBufferMemory);
    FALLIBLE(vkCreateDescriptorSetLayout);
    FALLIBLE(vkCreatePipelineLayout);
    FALLIBLE(vkCreateShaderModule);
    FALLIBLE(vkCreateComputePipelines);
    FALLIBLE(vkCreateDescriptorPool);
    FALLIBLE(vkAllocateDescriptorSets);
    FALLIBLE(vkCreateQueryPool);
    FALLIBLE(vkCreateCommandPool);
    FALLIBLE(vkCreateSemaphore);
}

void makeSubmissionFallible(HostDevice& host) {
    FALLIBLE(vkGetSemaphoreCounterValue);
    FALLIBLE(vkAllocateCommandBuffers);
    FALLIBLE(vkBeginCommandBuffer);
    FALLIBLE(vkEndCommandBuffer);
    FALLIBLE(vkQueueSubmit);
    FALLIBLE(vkWaitSemaphores);
    FALLIBLE(vkGetQueryPoolResults);
}

/// Makes one object of each kind and runs it once; returns the result. `messages` receives messages,
/// including leaks.
std::vector<std::uint32_t> runOnce(HostDevice& host, std::vector<std::string>& messages) {
    const auto keep = [&](const std::string& message) { messages.push_back(message); };
    const vk::Device own = vk::Device::create(host.handles().getInstanceProcAddr,
                                              {.hasValidation = true, .onValidationMessage = keep});
    const vk::Kernel kernel(own, kernels::addOne, {});
    const vk::Buffer buffer(own, {.name = "values", .count = 2, .stride = 4});
    const vk::BindingRequest request{&kernel, {buffer.view()}};
    const vk::BindingSets sets(own, {&request, 1});
    vk::Timestamps timestamps(own, 1);
    vk::Queue queue(own);
    const std::uint32_t start[] = {1, 2};
    queue.upload(buffer.view(), start, sizeof start);
    VkCommandBuffer handle = queue.begin();
    vk::Commands commands(own, handle);
    timestamps.reset(commands);
    commands.beginStep();
    timestamps.begin(commands, 0);
    commands.bind(kernel, sets[0]);
    commands.dispatch(1);
    timestamps.end(commands, 0);
    commands.endStep();
    queue.wait(queue.submit(handle));
    timestamps.milliseconds();
    return queue.download<std::uint32_t>(buffer.view());
}

/// Lets the 1st, 2nd, 3rd ... call fail until a whole run succeeds; returns the names of the failed calls.
std::vector<std::string> sweep(HostDevice& host, VkResult result, vk::Failure expected) {
    std::vector<std::string> struck;
    for (int n = 0;; ++n) {
        fault = {n, result, {}};
        std::vector<std::string> messages;
        bool hasThrown = false;
        try {
            EXPECT_EQ(runOnce(host, messages), (std::vector<std::uint32_t>{2, 3}));
        } catch (const vk::Error& error) {
            hasThrown = true;
            EXPECT_EQ(error.failure(), expected) << error.what();
        }
        EXPECT_EQ(messages, std::vector<std::string>{}) << "after " << fault.struck;
        if (fault.struck.empty()) return struck;
        const bool hasSecondWay = result != VK_ERROR_DEVICE_LOST &&
                                  (fault.struck == "vkAllocateMemory" || fault.struck == "vkMapMemory");
        EXPECT_TRUE(hasThrown || hasSecondWay) << fault.struck; // or the buffer fits without a block
        struck.push_back(fault.struck);
    }
}

} // namespace

TEST(Faults, OutOfMemoryInAnySetUpCallIsAnErrorAndLeaksNothing) {
    HostDevice host;
    makeSetUpFallible(host);
    const auto struck = sweep(host, VK_ERROR_OUT_OF_DEVICE_MEMORY, vk::Failure::outOfMemory);
    EXPECT_GE(struck.size(), 25u);
    EXPECT_EQ(struck.front(), "vkEnumerateInstanceExtensionProperties");
}

TEST(Faults, ADeviceThatIsLostWhileMemoryIsTakenIsSaidToBeLost) {
    HostDevice host;
    FALLIBLE(vkAllocateMemory);
    EXPECT_GE(sweep(host, VK_ERROR_DEVICE_LOST, vk::Failure::deviceLost).size(), 1u)
        << "a block of each kind";
}

TEST(Faults, ALostDeviceInAnySubmissionCallIsAnErrorAndLeaksNothing) {
    HostDevice host;
    makeSubmissionFallible(host);
    const auto struck = sweep(host, VK_ERROR_DEVICE_LOST, vk::Failure::deviceLost);
    EXPECT_GE(struck.size(), 15u);
}

} // namespace sinew::test
