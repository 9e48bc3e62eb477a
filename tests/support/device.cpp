// A GoogleTest environment owns the device, and a listener turns validation messages into failures.
#include "support/device.hpp"

#include "support/full.hpp"

#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/loader.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

// The validation layer keeps memory until the process ends, and the leak detector would report it in every
// binary that loads the layer. The layer itself reports leaked device objects.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}

namespace sinew::test {

namespace {

class SharedDevice final : public testing::Environment {
public:
    explicit SharedDevice(bool hasValidation) : hasValidation_(hasValidation) {}

    SharedDevice& ensure() {
        if (device_) return *this;
        if (hasValidation_) vk::enableQueueSubmitValidation();
        loader_ = std::make_unique<vk::Loader>();
        const auto keep = [this](const std::string& message) {
            const std::lock_guard lock(mutex_);
            messages_.push_back(message);
        };
        device_ = std::make_unique<vk::Device>(vk::Device::create(
            loader_->getInstanceProcAddr(), {.hasValidation = hasValidation_, .onValidationMessage = keep}));
        queue_ = std::make_unique<vk::Queue>(*device_);
        kept_.emplace(*device_);
        return *this;
    }

    void TearDown() override { // name given by GoogleTest
        kept_.reset();
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
    bool hasValidation_;
    std::unique_ptr<vk::Loader> loader_;
    std::mutex mutex_;
    std::vector<std::string> messages_;
    std::unique_ptr<vk::Device> device_;
    std::unique_ptr<vk::Queue> queue_;
    std::optional<vk::KeptKernels> kept_; // tests often make several simulations in a row
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

SharedDevice& registerSharedDevice(bool hasValidation) {
    auto* shared = new SharedDevice(hasValidation); // GoogleTest owns the environment and the listener
    testing::AddGlobalTestEnvironment(shared);
    testing::UnitTest::GetInstance()->listeners().Append(new MessagesFailTests(*shared));
    return *shared;
}

SharedDevice& validated = registerSharedDevice(!isUnvalidated());
SharedDevice& tested = isPlayed() ? registerSharedDevice(false) : validated;

} // namespace

bool isPlayed() {
    return std::getenv("SINEW_PLAYED") != nullptr && !isFull();
}

const vk::Device& device() {
    return tested.ensure().device();
}

vk::Queue& queue() {
    return tested.ensure().queue();
}

const vk::Device& validatedDevice() {
    return validated.ensure().device();
}

vk::Queue& validatedQueue() {
    return validated.ensure().queue();
}

std::vector<std::string> takeMessages() {
    return validated.take();
}

} // namespace sinew::test
