// Tests of kernels shared by several users of a device, and of their lifetime.
#include "support/host_device.hpp"
#include "test_kernels.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace sinew::test {

namespace {

// A device with a kernel store of its own; leaks fail the test.
class KernelStore : public testing::Test {
protected:
    std::shared_ptr<const vk::Kernel> get(const vk::ShaderCode& code,
                                          std::span<const vk::SpecialisationConstant> constants = {}) {
        return device_->kernels().get(*device_, code, constants);
    }
    void TearDown() override {
        device_.reset();
        for (const std::string& message : host_.finish()) ADD_FAILURE() << message;
    }
    HostDevice host_;
    std::optional<vk::Device> device_ = vk::Device::borrow(host_.handles());
};

} // namespace

TEST_F(KernelStore, GivesAKernelThatSomebodyHas) {
    const vk::SpecialisationConstant small{3, 16}, large{3, 32};
    const auto first = get(kernels::everything, {&small, 1});
    EXPECT_EQ(get(kernels::everything, {&small, 1}), first);
    EXPECT_NE(get(kernels::everything, {&large, 1}), first);
    EXPECT_NE(get(kernels::everything), first);
    EXPECT_NE(get(kernels::copyValues), get(kernels::addOne));
    EXPECT_EQ(get(kernels::everything, {&large, 1})->interface().groupSize[0], 32u);
}

TEST_F(KernelStore, KeepsNothingUnasked) {
    std::weak_ptr<const vk::Kernel> gone = get(kernels::copyValues);
    EXPECT_TRUE(gone.expired());
    EXPECT_NE(get(kernels::copyValues), nullptr);
}

TEST_F(KernelStore, KeepsWhatItGivesWhileSomebodyAsksItTo) {
    auto user = get(kernels::addOne);
    std::weak_ptr<const vk::Kernel> made, found = user;
    {
        const vk::KeptKernels kept(*device_);
        {
            const vk::KeptKernels within(*device_);
            made = get(kernels::copyValues);
        }
        EXPECT_FALSE(made.expired());
        EXPECT_EQ(get(kernels::copyValues), made.lock());
        EXPECT_EQ(get(kernels::addOne), user);
        user.reset();
        EXPECT_FALSE(found.expired());
    }
    EXPECT_TRUE(made.expired());
    EXPECT_TRUE(found.expired());
}

TEST_F(KernelStore, GivesAllThreadsTheSame) {
    std::array<std::shared_ptr<const vk::Kernel>, 4> got;
    std::vector<std::thread> threads;
    for (auto& kernel : got) threads.emplace_back([&] { kernel = get(kernels::everything); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& kernel : got) EXPECT_EQ(kernel, got[0]);
}

TEST_F(KernelStore, MakesManyOnSeveralThreads) {
    vk::KernelStore& store = device_->kernels();
    std::vector<vk::KernelStore::Request> requests;
    for (std::uint32_t size = 1; size <= 8; ++size) requests.push_back({&kernels::everything, {{3, size}}});
    requests.push_back({&kernels::copyValues, {}});
    requests.push_back(requests[2]); // a second time
    for (const unsigned threads : {1u, 4u, 64u}) {
        store.useThreads(threads);
        const std::size_t before = store.pipelinesMade();
        const auto made = store.getAll(*device_, requests);
        EXPECT_GE(store.pipelinesMade() - before, 9u);
        EXPECT_LE(store.pipelinesMade() - before, 10u);
        ASSERT_EQ(made.size(), requests.size());
        for (std::uint32_t k = 0; k < 8; ++k) EXPECT_EQ(made[k]->interface().groupSize[0], k + 1);
        EXPECT_EQ(made[8]->name(), "copy_values");
        EXPECT_EQ(made[9], made[2]);
    }
    requests[5].constants[0].id = 99; // there is none
    EXPECT_THROW(store.getAll(*device_, requests), vk::Error);
    EXPECT_TRUE(store.getAll(*device_, {}).empty());
}

TEST_F(KernelStore, KnowsWhichThreadMadePipelines) {
    std::shared_ptr<const vk::Kernel> there;
    std::size_t made = 0;
    std::thread([&] {
        there = get(kernels::copyValues);
        made = device_->kernels().pipelinesMade();
    }).join();
    EXPECT_EQ(made, 1u);
    EXPECT_EQ(get(kernels::copyValues), there);
    EXPECT_EQ(device_->kernels().pipelinesMade(), 0u) << "it was there";
    const auto other = get(kernels::addOne);
    EXPECT_EQ(device_->kernels().pipelinesMade(), 1u);
}

} // namespace sinew::test
