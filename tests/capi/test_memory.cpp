// Lack of memory at every allocation: a result and a sentence, and objects that stay usable. Allocations of
// this program and of Sinew fail, which is linked into it; those of the driver do not.
#include "capi/support.hpp"
#include "sinew/sinew_query.h"
#include "sinew/sinew_world.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>

extern "C" const char __executable_start, etext; // of the linker: the code of the program

namespace {

constexpr std::size_t all = ~std::size_t{0};
std::atomic<std::size_t> left = all; // allocations that succeed, in any thread

void* allocate(std::size_t size, const void* caller) {
    const bool isOurs = caller >= &__executable_start && caller < &etext;
    for (std::size_t now = left; isOurs && now != all;) {
        if (now == 0) throw std::bad_alloc();
        if (left.compare_exchange_weak(now, now - 1)) break;
    }
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

/// Calls `function` with room for 0, 1, ... allocations, or for each `apart`-th of these numbers, until it
/// succeeds. Returns how often it failed.
int failAtEveryAllocation(const std::function<SinewResult()>& function, const std::function<void()>& check,
                          std::size_t apart = 1) {
    for (int failures = 0;; ++failures) {
        left = static_cast<std::size_t>(failures) * apart;
        const SinewResult result = function();
        left = all;
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

constexpr std::size_t alike = 29; // most allocations of a simulation are

void open(Device& device) {
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    request.isSoftware = 1;
    ASSERT_TRUE(isOk(sinewCreateDevice(&request, &device)));
}

TEST(CApiMemory, ASimulationIsMadeWholeOrNotAtAll) {
    Device device;
    open(device);
    Scene scene;
    makeCube(scene, 1);
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 2;
    SinewSimulation made{};
    EXPECT_GT(failAtEveryAllocation([&] { return sinewCreateSimulation(device, scene, &settings, &made); },
                                    [&] { EXPECT_EQ(made.id, 0u); }, alike),
              20);
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

// A part that cannot arrive is given up; all that is there stays.
TEST(CApiMemory, AWorldGoesOnWithWhatItHas) {
    Device device;
    open(device);
    Scene ground, cube;
    ASSERT_TRUE(isOk(sinewCreateScene(&ground)));
    const SinewPlane plane = sinewDefaultPlane();
    ASSERT_TRUE(isOk(sinewAddPlane(ground, &plane)));
    makeCube(cube, 1);
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 2;
    Owned<SinewWorld, sinewDestroyWorld> world;
    EXPECT_GT(
        failAtEveryAllocation([&] { return sinewCreateWorld(device, ground, &settings, &world.handle); },
                              [&] { EXPECT_EQ(world.handle.id, 0u); }, alike),
        2);
    SinewPart part{};
    const auto particles = [&] {
        SinewSceneCounts counts{};
        counts.size = sizeof counts;
        EXPECT_TRUE(isOk(sinewGetWorldCounts(world, &counts)));
        return counts.particles;
    };
    SinewWorldInfo info{};
    info.size = sizeof info;
    EXPECT_GT(failAtEveryAllocation([&] { return sinewAddPart(world, cube, &part); },
                                    [&] {
                                        EXPECT_EQ(part.world, 0u);
                                        EXPECT_TRUE(isOk(sinewGetWorldInfo(world, &info)));
                                        EXPECT_EQ(info.isChanging, 0u);
                                    }),
              20);
    const auto update = [&] { return sinewUpdateWorld(world); };
    const auto addAgain = [&] {
        std::uint32_t isContained = 0;
        EXPECT_TRUE(isOk(sinewContainsPart(world, part, &isContained)));
        if (isContained == 0) {
            EXPECT_TRUE(isOk(sinewAddPart(world, cube, &part)));
        }
        EXPECT_EQ(particles(), 0u);
    };
    EXPECT_GT(failAtEveryAllocation(update, addAgain, alike), 20);
    EXPECT_GT(particles(), 0u);
    const SinewStep step = sinewDefaultStep();
    EXPECT_GT(failAtEveryAllocation([&] { return sinewStepWorld(world, &step, 1); }, [] {}), 0);
    EXPECT_TRUE(isOk(sinewStepWorld(world, &step, 10)));

    constexpr SinewQueryRoom room{sizeof(SinewQueryRoom), 1, 10, 1};
    Owned<SinewQuery, sinewDestroyQuery> query;
    EXPECT_GT(failAtEveryAllocation([&] { return sinewCreateWorldQuery(world, &room, &query.handle); },
                                    [&] { EXPECT_EQ(query.handle.id, 0u); }, 3),
              20);
    const SinewRay down{{0.05f, 3, 0.05f}, {0, -1, 0}, 0, 0};
    SinewRayHit hit{};
    hit.size = sizeof hit;
    failAtEveryAllocation([&] { return sinewCastRay(query, &down, &hit); }, [] {});
    EXPECT_EQ(hit.isMet, 1u);

    EXPECT_EQ(failAtEveryAllocation([&] { return sinewRemovePart(world, part); }, [] {}), 0)
        << "to remove takes no memory";
    const auto remains = [&] { EXPECT_GT(particles(), 0u) << "until it leaves"; };
    EXPECT_GT(failAtEveryAllocation(update, remains, alike), 1);
    EXPECT_EQ(particles(), 0u);
    EXPECT_TRUE(isOk(sinewStepWorld(world, &step, 2)));
}

TEST(CApiMemory, AFileIsLoadedWholeOrNotAtAll) {
    const std::string file = ::testing::TempDir() + "sinew_memory.toml";
    std::ofstream(file) << "name = \"one\"\n[[box]]\nname = \"box\"\nparticles = [3, 3, 3]\nspacing = "
                           "0.1\ncenter = [0, 1, 0]\n"
                           "young_modulus = 1e5\n";
    SinewScene made{};
    EXPECT_GT(failAtEveryAllocation([&] { return sinewLoadScene(file.c_str(), &made); },
                                    [&] { EXPECT_EQ(made.id, 0u); }, 3),
              20);
    Scene scene;
    scene.handle = made;
    EXPECT_GT(particlesOf(scene), 27u);
    std::filesystem::remove(file);
}

} // namespace
} // namespace sinew::test
