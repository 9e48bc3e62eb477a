// Lets calls fail while steps are in flight. No object may be destroyed before these steps have finished,
// which the validation layer checks.
#include "support/faults.hpp"

#include "app/guard.hpp"
#include "scenes/load.hpp"
#include "sinew/runner.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace sinew;
using test::fault;

namespace {

// Overlapping balls whose first contact capacity is too small, so the simulation is enlarged.
constexpr const char* balls = "[solver]\nsubsteps = 4\n[contacts]\n[[particles]]\nradius = 0.02\n"
                              "count = [8, 8, 8]\nspacing = 0.04\ncenter = [0, 0.4, 0]\n[[plane]]\n";

void makeFallible(test::HostDevice& host) {
    FALLIBLE(vkCreateBuffer);
    FALLIBLE(vkCreateComputePipelines);
    FALLIBLE(vkCreateDescriptorPool);
    FALLIBLE(vkCreateQueryPool);
    FALLIBLE(vkBeginCommandBuffer);
    FALLIBLE(vkEndCommandBuffer);
    FALLIBLE(vkQueueSubmit);
    FALLIBLE(vkWaitSemaphores);
}

class InFlight : public testing::Test {
protected:
    InFlight() {
        file_ = std::filesystem::temp_directory_path() /
                ("sinew-in-flight-" + std::to_string(::getpid()) + ".toml");
        std::ofstream(file_) << balls;
        loaded_ = scenes::load(file_);
        loaded_.settings.contactRoom = 4;
        makeFallible(host_);
    }
    ~InFlight() override { std::filesystem::remove(file_); }

    /// Runs steps, with `prepare` called before the first one; returns the message of the exception.
    std::string runWith(const std::function<void()>& prepare,
                        const std::function<void(std::uint64_t)>& onStep = {}) {
        fault = {};
        const auto keep = [this](const std::string& message) { messages_.push_back(message); };
        std::string thrown;
        tools::Session session(host_.handles().getInstanceProcAddr,
                               {.hasValidation = true, .onValidationMessage = keep});
        try {
            if (isOfSetUp_) prepare();
            tools::Runner runner(session, loaded_.scene, loaded_.settings);
            if (!isOfSetUp_) prepare();
            runner.advance(6, sim::Simulation::framesInFlight, onStep);
            grown_ = runner.contactRoom().grown;
        } catch (const std::exception& error) {
            thrown = error.what();
        }
        fault = {};
        return thrown;
    }

    /// Lets each call fail in turn; returns the number of calls.
    int sweep(VkResult result, int stride) {
        for (int n = 0;; n += stride) {
            const std::string thrown = runWith([&] { fault = {n, result, {}}; });
            const bool isOver = fault.struck.empty() && thrown.empty();
            EXPECT_EQ(messages_, std::vector<std::string>{}) << "call " << n << ": " << thrown;
            if (isOver || HasFailure()) return n;
        }
    }

    test::HostDevice host_;
    std::filesystem::path file_;
    scenes::LoadedScene loaded_;
    std::vector<std::string> messages_;
    std::uint32_t grown_ = 0;
    bool isOfSetUp_ = false;
};

} // namespace

TEST_F(InFlight, NothingDiesWhereGrowingFails) {
    ASSERT_EQ(runWith([] {}), "");
    ASSERT_GT(grown_, 0u) << "the scene must grow";
    EXPECT_GT(sweep(VK_ERROR_OUT_OF_DEVICE_MEMORY, 7), 20);
}

TEST_F(InFlight, NothingDiesWhereTheSetUpFailsAfterItsFirstSubmission) {
    isOfSetUp_ = true;
    EXPECT_GT(sweep(VK_ERROR_OUT_OF_HOST_MEMORY, 11), 20);
}

TEST_F(InFlight, NothingDiesWhereWhoListensThrows) {
    EXPECT_EQ(runWith([] {}, [](std::uint64_t) { throw app::Failure(app::outputFailed, "no space"); }),
              "no space");
    EXPECT_EQ(messages_, std::vector<std::string>{});
}
