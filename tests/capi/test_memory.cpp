// Lack of memory at every allocation: a result and a sentence, and objects that stay usable. Allocations of
// this program and of Sinew fail, which is linked into it; those of the driver do not.
#include "capi/support.hpp"

#include <cstdlib>
#include <functional>
#include <new>

extern "C" const char __executable_start, etext; // of the linker: the code of the program

namespace {

thread_local std::size_t left = ~std::size_t{0}; // allocations that succeed

void* allocate(std::size_t size, const void* caller) {
    const bool isOurs = caller >= &__executable_start && caller < &etext;
    if (isOurs && left == 0) throw std::bad_alloc();
    if (isOurs && left != ~std::size_t{0}) --left;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

[[gnu::noinline]] void release(void* memory) noexcept { // GCC would see free() behind a new expression
    std::free(memory);
}

} // namespace

void* operator new(std::size_t size) {
    return allocate(size, __builtin_return_address(0));
}
void* operator new[](std::size_t size) {
    return allocate(size, __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
    release(memory);
}
void operator delete[](void* memory) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    release(memory);
}

namespace sinew::test {
namespace {

/// Calls `function` with room for 0, 1, ... allocations, until it succeeds. Returns how often it failed.
int failAtEveryAllocation(const std::function<SinewResult()>& function, const std::function<void()>& check) {
    for (int failures = 0;; ++failures) {
        left = static_cast<std::size_t>(failures);
        const SinewResult result = function();
        left = ~std::size_t{0};
        if (result == SINEW_OK) return failures;
        EXPECT_EQ(result, SINEW_ERROR_OUT_OF_MEMORY) << sinewLastError();
        EXPECT_NE(std::string(sinewLastError()).find("memory"), std::string::npos) << sinewLastError();
        check();
        if (::testing::Test::HasFailure() || failures > 100'000) return -1;
    }
}

std::uint32_t particlesOf(SinewScene scene) {
    SinewSceneCounts counts{};
    counts.size = sizeof counts;
    EXPECT_TRUE(isOk(sinewGetSceneCounts(scene, &counts)));
    return counts.particles + counts.links + counts.bodies + counts.skins + counts.grids;
}

TEST(CApiMemory, ScenesStayAsTheyWereWhereThereIsNone) {
    SinewScene made{};
    EXPECT_GT(failAtEveryAllocation([&] { return sinewCreateScene(&made); }, [&] { EXPECT_EQ(made.id, 0u); }),
              0);
    Scene scene;
    scene.handle = made;
    const SinewParticle particle{.position = {0, 5, 0}, .inverseMass = 1};
    ASSERT_TRUE(isOk(sinewAddParticles(scene, 1, &particle, nullptr)));
    const auto isUnchanged = [&] { EXPECT_EQ(particlesOf(scene), 1u); };
    SinewLattice lattice = sinewDefaultLattice();
    lattice.cells[0] = 2;
    lattice.hasSkin = 1;
    EXPECT_GT(failAtEveryAllocation([&] { return sinewAddLattice(scene, &lattice, nullptr); }, isUnchanged),
              20);
    EXPECT_GT(particlesOf(scene), 10u);
    const SinewSettings settings = sinewDefaultSettings();
    EXPECT_GT(failAtEveryAllocation([&] { return sinewValidate(scene, &settings); }, [] {}), 0);
    std::size_t size = 0;
    EXPECT_GT(failAtEveryAllocation([&] { return sinewDescribe(scene, &settings, &size, nullptr); }, [] {}),
              100);
}

TEST(CApiMemory, ASimulationIsMadeWholeOrNotAtAll) {
    Device device;
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    request.isSoftware = 1;
    ASSERT_TRUE(isOk(sinewCreateDevice(&request, &device)));
    Scene scene;
    makeCube(scene, 1);
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 2;
    SinewSimulation made{};
    // Most of the allocations are alike, so that a failure of every 29th one suffices.
    int failures = 0;
    for (std::size_t allowed = 0; made.id == 0; allowed += 29, ++failures) {
        left = allowed;
        const SinewResult result = sinewCreateSimulation(device, scene, &settings, &made);
        left = ~std::size_t{0};
        ASSERT_TRUE(result == SINEW_OK || result == SINEW_ERROR_OUT_OF_MEMORY) << sinewLastError();
        ASSERT_EQ(made.id != 0, result == SINEW_OK);
    }
    EXPECT_GT(failures, 20);
    Simulation simulation;
    simulation.handle = made;
    const SinewStep step = sinewDefaultStep();
    EXPECT_GT(failAtEveryAllocation([&] { return sinewStep(simulation, &step, 1); }, [] {}), 0);
    EXPECT_TRUE(isOk(sinewStep(simulation, &step, 10)));
    SinewState state{};
    EXPECT_GT(failAtEveryAllocation([&] { return sinewSaveState(simulation, &state); }, [] {}), 0);
    EXPECT_TRUE(isOk(sinewLoadState(simulation, state)));
    EXPECT_TRUE(isOk(sinewDestroyState(state)));
}

} // namespace
} // namespace sinew::test
