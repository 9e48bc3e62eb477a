// A GoogleTest environment owns the device, a listener turns messages into failures.
#include "support/device.hpp"

#include "vk/loader.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <utility>

// The validation layer keeps memory until the process ends, which the leak detector reports in every binary
// that loads it. Device objects that leak are reported by the layer itself.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}

namespace sinew::test {

namespace {

class SharedDevice final : public testing::Environment {
public:
    void ensure() {
        if (device_) return;
        vk::enableQueueSubmitValidation();
        loader_ = std::make_unique<vk::Loader>();
        const auto keep = [this](const std::string& message) {
            const std::lock_guard lock(mutex_);
            messages_.push_back(message);
        };
        device_ = std::make_unique<vk::Device>(vk::Device::create(
            loader_->getInstanceProcAddr(), {.hasValidation = true, .onValidationMessage = keep}));
        queue_ = std::make_unique<vk::Queue>(*device_);
    }

    void TearDown() override { // GoogleTest's spelling
        queue_.reset();
        device_.reset();
        for (const std::string& message : take())
            ADD_FAILURE() << "when the device was destroyed: " << message;
    }

    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(messages_, {});
    }
    const vk::Device& device() const { return *device_; }
    vk::Queue& queue() const { return *queue_; }

private:
    std::unique_ptr<vk::Loader> loader_;
    std::mutex mutex_;
    std::vector<std::string> messages_;
    std::unique_ptr<vk::Device> device_;
    std::unique_ptr<vk::Queue> queue_;
};

class MessagesFailTests final : public testing::EmptyTestEventListener {
public:
    explicit MessagesFailTests(SharedDevice& shared) : shared_(shared) {}
    void OnTestEnd(const testing::TestInfo&) override {
        for (const std::string& message : shared_.take()) ADD_FAILURE() << "validation: " << message;
    }

private:
    SharedDevice& shared_;
};

SharedDevice& registerSharedDevice() {
    auto* shared = new SharedDevice; // GoogleTest owns environment and listener
    testing::AddGlobalTestEnvironment(shared);
    testing::UnitTest::GetInstance()->listeners().Append(new MessagesFailTests(*shared));
    return *shared;
}

SharedDevice& sharedDevice = registerSharedDevice();

} // namespace

const vk::Device& device() {
    sharedDevice.ensure();
    return sharedDevice.device();
}

vk::Queue& queue() {
    sharedDevice.ensure();
    return sharedDevice.queue();
}

std::vector<std::string> takeMessages() {
    return sharedDevice.take();
}

} // namespace sinew::test
