// Tests of pipelines and binding sets: every mismatch between C++ and GLSL is refused by name.
#include "support/device.hpp"
#include "support/host_device.hpp"
#include "test_kernels.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/kernel.hpp"

#include <gtest/gtest.h>

namespace sinew::test {

namespace {

/// Message of the vk::Error with this failure that `make` must throw.
std::string complaint(vk::Failure failure, const std::function<void()>& make) {
    try {
        make();
    } catch (const vk::Error& error) {
        EXPECT_EQ(error.failure(), failure) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

void expectParts(const std::string& message, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << '"' << part << "\" is not in: " << message;
}

std::string bindingComplaint(vk::Failure failure, const vk::Kernel& kernel,
                             std::vector<vk::BufferView> buffers) {
    const vk::BindingRequest request{&kernel, std::move(buffers)};
    return complaint(failure, [&] { vk::BindingSets(device(), {&request, 1}); });
}

} // namespace

TEST(Kernel, TakesItsGroupSizeFromAConstant) {
    const vk::SpecialisationConstant constants[] = {{3, 32}, {0, 1}};
    const vk::Kernel kernel(device(), kernels::everything, constants);
    EXPECT_EQ(kernel.interface().groupSize, (std::array<std::uint32_t, 3>{32, 2, 1}));
    EXPECT_NE(kernel.pipeline(), VkPipeline{VK_NULL_HANDLE});
    EXPECT_EQ(kernel.name(), "everything");
}

TEST(Kernel, RefusesAnUnknownSpecialisationIdByName) {
    const vk::SpecialisationConstant unknown{5, 1};
    const std::string message = complaint(vk::Failure::misuse, [&] {
        vk::Kernel(device(), kernels::everything, {&unknown, 1});
    });
    expectParts(message, {"everything", "specialisation constant 5"});
}

TEST(Kernel, RefusesAGroupLargerThanTheDevices) {
    const vk::SpecialisationConstant size{3, device().limits().maxGroupInvocations};
    const std::string message = complaint(vk::Failure::noDevice, [&] {
        vk::Kernel(device(), kernels::everything, {&size, 1});
    });
    expectParts(message, {"everything", std::to_string(2 * size.value), std::to_string(size.value)});
}

namespace {

PFN_vkGetPhysicalDeviceProperties realProperties = nullptr;
VkPhysicalDeviceLimits lowered{};
void VKAPI_CALL loweredProperties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties) {
    realProperties(physical, properties);
    properties->limits.maxPerStageDescriptorStorageBuffers = lowered.maxPerStageDescriptorStorageBuffers;
    properties->limits.maxPushConstantsSize = lowered.maxPushConstantsSize;
    properties->limits.maxComputeSharedMemorySize = lowered.maxComputeSharedMemorySize;
}

} // namespace

TEST(Kernel, NamesBothFiguresWhereALimitIsTooLow) {
    HostDevice host;
    realProperties = host.instanceFunctions().vkGetPhysicalDeviceProperties;
    host.replace("vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(&loweredProperties));
    std::vector<vk::SpecialisationConstant> constants;
    const auto complaintUnder = [&](std::uint32_t buffers, std::uint32_t push, std::uint32_t shared) {
        lowered.maxPerStageDescriptorStorageBuffers = buffers;
        lowered.maxPushConstantsSize = push;
        lowered.maxComputeSharedMemorySize = shared;
        const vk::Device borrowed = vk::Device::borrow(host.handles());
        EXPECT_EQ(borrowed.description().storageBuffers, buffers);
        return complaint(vk::Failure::noDevice,
                         [&] { vk::Kernel(borrowed, kernels::everything, constants); });
    };
    expectParts(complaintUnder(4, 128, 1024), {"everything", "5 storage buffers", "has 4"});
    expectParts(complaintUnder(8, 44, 1024), {"everything", "48 bytes of push constants", "has 44"});
    expectParts(complaintUnder(8, 128, 100), {"everything", "164 bytes of shared memory", "has 100"});
    constants = {{7, 40}}; // two vectors for each
    expectParts(complaintUnder(8, 128, 1024), {"everything", "1284 bytes of shared memory", "has 1024"});
}

TEST(Kernel, ThrowsWhatTheReaderSays) {
    EXPECT_THROW(vk::Kernel(device(), kernels::bindingGap, {}), std::runtime_error);
}

TEST(Kernel, MovesWithoutReleasingTwice) {
    vk::Kernel first(device(), kernels::addOne, {});
    const VkPipeline pipeline = first.pipeline();
    vk::Kernel second(std::move(first));
    vk::Kernel third(device(), kernels::copyValues, {});
    third = std::move(second);
    EXPECT_EQ(third.pipeline(), pipeline);
    EXPECT_EQ(third.name(), "add_one");
}

TEST(BindingSets, RefuseAStrideThatDiffersFromTheKernels) {
    const vk::Kernel kernel(device(), kernels::copyValues, {});
    const vk::Buffer good(device(), {.name = "good", .count = 4, .stride = 4});
    const vk::Buffer wide(device(), {.name = "wide", .count = 4, .stride = 16});
    const std::string message = bindingComplaint(vk::Failure::misuse, kernel, {good.view(), wide.view()});
    expectParts(message, {"copy_values", "binding 1 (Target)", "16", "4"});
}

TEST(BindingSets, RefuseAnotherNumberOfBuffersThanTheKernels) {
    const vk::Kernel kernel(device(), kernels::copyValues, {});
    const vk::Buffer buffer(device(), {.name = "values", .count = 4, .stride = 4});
    expectParts(bindingComplaint(vk::Failure::misuse, kernel, {buffer.view()}),
                {"copy_values", "2 bindings", "1 buffers"});
}

TEST(BindingSets, RefuseNoBufferMisalignedOffsetsAndRangesBeyondTheLimit) {
    const vk::Kernel kernel(device(), kernels::addOne, {});
    const vk::Buffer buffer(device(), {.name = "values", .count = 256, .stride = 4});
    expectParts(bindingComplaint(vk::Failure::misuse, kernel, {{}}), {"add_one", "Values", "no buffer"});
    vk::BufferView view = buffer.view();
    view.offset = 2;
    expectParts(bindingComplaint(vk::Failure::misuse, kernel, {view}), {"add_one", "Values", "offset 2"});
    view = buffer.view();
    view.size = device().limits().maxStorageBufferRange + 4;
    expectParts(bindingComplaint(vk::Failure::outOfMemory, kernel, {view}),
                {"add_one", "Values", std::to_string(view.size), "maxStorageBufferRange"});
}

TEST(BindingSets, MayBeEmptyAndMove) {
    vk::BindingSets sets(device(), {});
    const vk::Kernel kernel(device(), kernels::addOne, {});
    const vk::Buffer buffer(device(), {.name = "values", .count = 4, .stride = 4});
    const vk::BindingRequest request{&kernel, {buffer.view()}};
    vk::BindingSets filled(device(), {&request, 1});
    const VkDescriptorSet set = filled[0];
    sets = std::move(filled);
    EXPECT_EQ(sets[0], set);
}

TEST(Texels, AreRefusedWhereAnElementHasNoFormat) {
    const vk::Kernel kernel(device(), kernels::fetchTexels, {});
    const vk::Buffer three(device(), {.name = "three", .count = 4, .stride = 12});
    const vk::Buffer four(device(), {.name = "four", .count = 4, .stride = 16});
    const std::string message =
        bindingComplaint(vk::Failure::misuse, kernel, {three.view(), four.view(), four.view()});
    expectParts(message, {"fetch_texels", "weights", "12 bytes", "4, 8 or a multiple of 16"});
}

} // namespace sinew::test
