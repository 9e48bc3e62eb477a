// Host memory of Vulkan's objects from a host's allocator: everything comes back, and lack of it is an error
// that leaves other objects usable.
#include "capi/host_handles.hpp"
#include "capi/support.hpp"

#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>

namespace sinew::test {
namespace {

// Counts what it gives, and refuses every `failEvery`-th request.
struct Counting {
    std::map<void*, std::size_t> live;
    std::size_t requests = 0, refused = 0, failEvery = 0;
    std::mutex mutex; // drivers may ask from threads of their own

    VkAllocationCallbacks callbacks() {
        return {.pUserData = this,
                .pfnAllocation = allocate,
                .pfnReallocation = reallocate,
                .pfnFree = free,
                .pfnInternalAllocation = nullptr,
                .pfnInternalFree = nullptr};
    }
    static void* VKAPI_CALL allocate(void* user, std::size_t size, std::size_t alignment,
                                     VkSystemAllocationScope) {
        auto& self = *static_cast<Counting*>(user);
        const std::lock_guard lock(self.mutex);
        ++self.requests;
        if (self.failEvery > 0 && self.requests % self.failEvery == 0) {
            ++self.refused;
            return nullptr;
        }
        alignment = std::max(alignment, alignof(std::max_align_t));
        void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        self.live[memory] = size;
        return memory;
    }
    static void* VKAPI_CALL reallocate(void* user, void* memory, std::size_t size, std::size_t alignment,
                                       VkSystemAllocationScope scope) {
        if (memory == nullptr) return allocate(user, size, alignment, scope);
        void* larger = size > 0 ? allocate(user, size, alignment, scope) : nullptr;
        if (larger != nullptr)
            std::memcpy(larger, memory, std::min(size, static_cast<Counting*>(user)->live.at(memory)));
        if (larger != nullptr || size == 0) free(user, memory);
        return larger;
    }
    static void VKAPI_CALL free(void* user, void* memory) {
        if (memory == nullptr) return;
        auto& self = *static_cast<Counting*>(user);
        const std::lock_guard lock(self.mutex);
        EXPECT_EQ(self.live.erase(memory), 1u) << "freed what was not given";
        std::free(memory);
    }
};

void borrow(HostDevice& host, Counting& counting, Device& device) {
    const VkAllocationCallbacks callbacks = counting.callbacks();
    SinewHostDevice handles = handlesOf(host);
    handles.allocation = &callbacks;
    ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
}

void step(HostDevice& host, SinewSimulation simulation, std::uint64_t frame) {
    host.submit([&](VkCommandBuffer commands) {
        if (frame == 0) {
            ASSERT_TRUE(isOk(sinewRecordReset(simulation, commands)));
        }
        SinewStep input = sinewDefaultStep();
        input.frame = frame;
        ASSERT_TRUE(isOk(sinewRecordStep(simulation, commands, &input)));
    });
    SinewStatus status{};
    status.size = sizeof status;
    ASSERT_TRUE(isOk(sinewGetStatus(simulation, frame, &status)));
    EXPECT_EQ(status.nonFinite, 0u);
}

} // namespace

TEST(CApiAllocation, OfABorrowedDeviceComesBack) {
    Counting counting;
    HostDevice host;
    {
        Device device;
        borrow(host, counting, device);
        EXPECT_GT(counting.requests, 0u) << "the cache of pipelines";
        Scene scene;
        makeCube(scene);
        SinewSettings settings = sinewDefaultSettings();
        settings.substeps = 2;
        Simulation simulation;
        const std::size_t before = counting.requests;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
        EXPECT_GT(counting.requests, before + 20) << "buffers, memory, kernels, sets";
        step(host, simulation, 0);
    }
    EXPECT_EQ(counting.live.size(), 0u);
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

TEST(CApiAllocation, ThatFailsLeavesTheOthersUsable) {
    Counting counting;
    HostDevice host;
    {
        Device device;
        borrow(host, counting, device);
        Scene scene;
        makeCube(scene);
        SinewSettings settings = sinewDefaultSettings();
        settings.substeps = 2;
        Simulation simulation;
        ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
        step(host, simulation, 0);
        const std::size_t live = counting.live.size();
        std::uint64_t frame = 1;
        for (const std::size_t every : {1u, 2u, 3u, 5u, 8u, 13u, 21u, 34u}) {
            SinewSettings other = settings;
            other.substeps = 3;
            counting.failEvery = every;
            const std::size_t refused = counting.refused;
            Simulation made;
            const SinewResult result = sinewCreateSimulation(device, scene, &other, &made);
            counting.failEvery = 0;
            EXPECT_GT(counting.refused, refused);
            EXPECT_TRUE(failsWith(SINEW_ERROR_OUT_OF_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY", result))
                << "every " << every;
            EXPECT_EQ(counting.live.size(), live) << "every " << every;
            step(host, simulation, frame++);
        }
    }
    EXPECT_EQ(counting.live.size(), 0u);
    EXPECT_EQ(host.finish(), std::vector<std::string>{});
}

} // namespace sinew::test
