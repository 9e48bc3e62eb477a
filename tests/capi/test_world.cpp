// Worlds by the C interface: parts come and go, and the handles of parts and simulations that are gone fail.
#include "capi/host_handles.hpp"
#include "capi/support.hpp"
#include "sinew/sinew_world.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace sinew::test {
namespace {

using World = Owned<SinewWorld, sinewDestroyWorld>;
using Positions = std::vector<std::array<float, 4>>;

void makeGround(Scene& scene) {
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    const SinewPlane plane = sinewDefaultPlane();
    ASSERT_TRUE(isOk(sinewAddPlane(scene, &plane)));
}

void makeBox(Scene& scene, float x, float radius = 0, std::uint32_t cells = 2) {
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    SinewLattice lattice = sinewDefaultLattice();
    for (std::uint32_t& side : lattice.cells) side = cells;
    lattice.origin = {x, 0.2f, 0};
    lattice.spacing = 0.05f;
    lattice.youngModulus = 5e4f;
    lattice.radius = radius;
    ASSERT_TRUE(isOk(sinewAddLattice(scene, &lattice, nullptr)));
}

SinewSettings worldSettings() {
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 6;
    return settings;
}

SinewSimulation simulationOf(SinewWorld world) {
    SinewSimulation simulation{};
    EXPECT_TRUE(isOk(sinewGetWorldSimulation(world, &simulation)));
    return simulation;
}

SinewWorldInfo infoOf(SinewWorld world) {
    SinewWorldInfo info{};
    info.size = sizeof info;
    EXPECT_TRUE(isOk(sinewGetWorldInfo(world, &info)));
    return info;
}

SinewPart addBox(SinewWorld world, float x, float radius = 0, std::uint32_t cells = 2) {
    Scene box;
    makeBox(box, x, radius, cells);
    SinewPart part{};
    EXPECT_TRUE(isOk(sinewAddPart(world, box, &part)));
    return part;
}

struct Place {
    SinewSceneCounts first{}, count{};
};
SinewResult find(SinewWorld world, SinewPart part, Place& place) {
    place.first.size = place.count.size = sizeof(SinewSceneCounts);
    return sinewFindPart(world, part, &place.first, &place.count);
}

class CApiWorld : public OnDevice {
protected:
    void SetUp() override {
        OnDevice::SetUp();
        Scene ground;
        makeGround(ground);
        const SinewSettings settings = worldSettings();
        ASSERT_TRUE(isOk(sinewCreateWorld(device, ground, &settings, &world)));
    }
    void TearDown() override {
        if (world.handle.id != 0) {
            EXPECT_TRUE(isOk(sinewDestroyWorld(world)));
        }
        world.handle.id = 0;
        OnDevice::TearDown();
    }
    void step(std::uint32_t count) {
        const SinewStep given = sinewDefaultStep();
        ASSERT_TRUE(isOk(sinewStepWorld(world, &given, count)));
    }
    Positions positionsOf(SinewPart part) {
        Place place;
        EXPECT_TRUE(isOk(find(world, part, place)));
        const Positions all = download(device, simulationOf(world), SINEW_POSITIONS);
        const auto first = all.begin() + place.first.particles;
        return {first, first + place.count.particles};
    }
    World world;
};

TEST_F(CApiWorld, OthersKeepTheirBitsWhenPartsComeAndGo) {
    const SinewPart first = addBox(world, -1), kept = addBox(world, 0);
    step(20);
    ASSERT_TRUE(isOk(sinewRemovePart(world, first))); // what stays moves to other indices
    const SinewPart other = addBox(world, 1, 0, 3);
    step(20);
    const Positions positions = positionsOf(kept);

    Scene ground;
    makeGround(ground);
    const SinewSettings settings = worldSettings();
    World alone;
    ASSERT_TRUE(isOk(sinewCreateWorld(device, ground, &settings, &alone)));
    const SinewPart same = addBox(alone, 0);
    const SinewStep given = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStepWorld(alone, &given, 40)));
    Place place;
    ASSERT_TRUE(isOk(find(alone, same, place)));
    EXPECT_EQ(place.first.particles, 0u);
    EXPECT_EQ(positions, download(device, simulationOf(alone), SINEW_POSITIONS));
    EXPECT_NE(positions[0][1], 0.2f);
    EXPECT_EQ(positionsOf(other).size(), 64u);
    const SinewWorldInfo info = infoOf(world);
    EXPECT_EQ(info.takeOvers, 2u);
    EXPECT_EQ(info.substeps, 6u);
    SinewSceneCounts counts{};
    counts.size = sizeof counts;
    ASSERT_TRUE(isOk(sinewGetWorldCounts(world, &counts)));
    EXPECT_EQ(counts.particles, 27u + 64u);
    EXPECT_EQ(counts.bodies, 2u);
    EXPECT_EQ(counts.planes, 1u);
}

TEST_F(CApiWorld, ASimulationThatWasReplacedIsStale) {
    step(3); // without a body
    const SinewSimulation before = simulationOf(world);
    SinewBufferView view{};
    EXPECT_TRUE(isOk(sinewGetView(before, SINEW_POSITIONS, &view)));
    addBox(world, 0);
    EXPECT_TRUE(isOk(sinewGetView(before, SINEW_POSITIONS, &view))); // until the part arrives
    ASSERT_TRUE(isOk(sinewUpdateWorld(world)));
    const SinewSimulation now = simulationOf(world);
    EXPECT_NE(now.id, before.id);
    EXPECT_EQ(infoOf(world).simulation.id, now.id);
    const SinewStep given = sinewDefaultStep();
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "taken changes over",
                          sinewGetView(before, SINEW_POSITIONS, &view)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "taken changes over", sinewReset(before)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "taken changes over", sinewDestroySimulation(before)));
    // The present one works, and is the world's to destroy and to step.
    EXPECT_TRUE(isOk(sinewGetView(now, SINEW_POSITIONS, &view)));
    EXPECT_EQ(view.size, 27u * 16u);
    EXPECT_TRUE(failsWith(SINEW_ERROR_IN_USE, "belongs to a world", sinewDestroySimulation(now)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_UNSUPPORTED, "sinewStepWorld", sinewStep(now, &given, 1)));
    EXPECT_TRUE(isOk(sinewReset(now)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_IN_USE, "1 simulation or world", sinewDestroyDevice(device)));
    ASSERT_TRUE(isOk(sinewDestroyWorld(world)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "destroyed", sinewReset(now)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "destroyed", sinewUpdateWorld(world)));
    world.handle.id = 0;
}

TEST_F(CApiWorld, PartsThatAreNoneAreRefused) {
    const SinewPart part = addBox(world, 0);
    Place place;
    EXPECT_EQ(find(world, part, place), SINEW_NOT_READY);
    EXPECT_EQ(infoOf(world).isChanging, 1u);
    step(1);
    EXPECT_EQ(infoOf(world).isChanging, 0u);
    EXPECT_TRUE(isOk(find(world, part, place)));
    EXPECT_EQ(place.count.particles, 27u);

    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "null", sinewRemovePart(world, {})));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "null", find(world, {}, place)));
    SinewPart wrong = part;
    ++wrong.generation;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "not, or no longer", sinewRemovePart(world, wrong)));
    wrong = {world.handle.id, 77, 0};
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "not, or no longer", sinewRemovePart(world, wrong)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "not, or no longer", find(world, wrong, place)));
    wrong = part;
    ++wrong.world;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "another world", sinewRemovePart(world, wrong)));
    std::uint32_t isContained = 9;
    EXPECT_TRUE(isOk(sinewContainsPart(world, wrong, &isContained)));
    EXPECT_EQ(isContained, 0u);
    EXPECT_TRUE(isOk(sinewContainsPart(world, part, &isContained)));
    EXPECT_EQ(isContained, 1u);

    ASSERT_TRUE(isOk(sinewRemovePart(world, part)));
    EXPECT_TRUE(isOk(find(world, part, place))); // until it leaves
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "no longer", sinewRemovePart(world, part)));
    const SinewPart next = addBox(world, 0); // takes the place of the part in the list of the world
    step(1);
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "no longer", find(world, part, place)));
    EXPECT_TRUE(isOk(find(world, next, place)));
}

TEST_F(CApiWorld, NullWrongSizesAndInvalidScenesAreRefused) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    const SinewSettings settings = worldSettings();
    SinewPart part{1, 2, 3};
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "world is null",
                          sinewCreateWorld(device, scene, &settings, nullptr)));
    World none;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewCreateWorld(device, scene, nullptr, &none)));
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_HANDLE, "null", sinewCreateWorld({0}, scene, &settings, &none)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "part is null", sinewAddPart(world, scene, nullptr)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "the world is null", sinewAddPart({0}, scene, &part)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "that of a scene",
                          sinewAddPart({scene.handle.id}, scene, &part)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "that of a world",
                          sinewAddPart(world, {world.handle.id}, &part)));
    const SinewParticle particle{
        .position = {}, .velocity = {}, .inverseMass = 1, .radius = 0, .contactOffset = 0, .keepsRest = 0};
    ASSERT_TRUE(isOk(sinewAddParticles(scene, 1, &particle, nullptr)));
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_SCENE, "belongs to no body", sinewAddPart(world, scene, &part)));
    const SinewLink link{0, 5, 1, 0};
    ASSERT_TRUE(isOk(sinewAddLinks(scene, 1, &link)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "distance[0]", sinewAddPart(world, scene, &part)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "distance[0]",
                          sinewCreateWorld(device, scene, &settings, &none)));
    EXPECT_EQ(part.world, 1u); // untouched
    EXPECT_EQ(none.handle.id, 0u);
    EXPECT_EQ(infoOf(world).isChanging, 0u);

    SinewWorldInfo info{};
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "size of SinewWorldInfo is 0",
                          sinewGetWorldInfo(world, &info)));
    SinewSceneCounts counts{};
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "is 0", sinewGetWorldCounts(world, &counts)));
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewFindPart(world, part, nullptr, &counts)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewContainsPart(world, part, nullptr)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewGetWorldSimulation(world, nullptr)));
    std::uint32_t flag = 0;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "commands", sinewRecordChanges(world, nullptr, &flag)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewObserveStatus(world, nullptr, &flag)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewStepWorld(world, nullptr, 1)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewGetWorldStatus(world, 0, nullptr)));
}

// Loose balls that fall onto each other need more room than there is: the world makes it in the midst of the
// steps, and anchors of attachments in a part are those of the present scene.
TEST_F(CApiWorld, StepsThatLackRoomAreRepeatedWithMore) {
    Scene ground;
    makeGround(ground);
    SinewSettings settings = worldSettings();
    settings.contactRoom = 1;
    World small;
    ASSERT_TRUE(isOk(sinewCreateWorld(device, ground, &settings, &small)));
    Scene balls;
    ASSERT_TRUE(isOk(sinewCreateScene(&balls)));
    std::vector<SinewParticle> particles;
    for (int i = 0; i < 64; ++i)
        particles.push_back(
            {.position = {0.06f * float(i % 4), 0.05f + 0.06f * float(i / 16), 0.06f * float(i / 4 % 4)},
             .velocity = {0, -1, 0},
             .inverseMass = 10,
             .radius = 0.03f,
             .contactOffset = 0.03f,
             .keepsRest = 0});
    ASSERT_TRUE(isOk(sinewAddParticles(balls, 64, particles.data(), nullptr)));
    ASSERT_TRUE(isOk(sinewAddBody(balls, "balls", 0, 64, nullptr)));
    const SinewAttachment attachment{
        .particle = 63, .anchor = {0.18f, 0.4f, 0.18f}, .compliance = 1e-3f, .maxForce = 0, .maxSpeed = 0};
    ASSERT_TRUE(isOk(sinewAddAttachments(balls, 1, &attachment, nullptr)));
    SinewPart part{};
    ASSERT_TRUE(isOk(sinewAddPart(small, balls, &part)));
    SinewStep given = sinewDefaultStep();
    const SinewVec3 anchor{0.18f, 0.5f, 0.18f};
    given.anchors = &anchor;
    given.anchorCount = 1;
    ASSERT_TRUE(isOk(sinewStepWorld(small, &given, 60)));
    const SinewWorldInfo info = infoOf(small);
    EXPECT_GT(info.takeOvers, 1u); // the part, and room
    SinewSimulationInfo made{};
    made.size = sizeof made;
    ASSERT_TRUE(isOk(sinewGetSimulationInfo(info.simulation, &made)));
    EXPECT_GT(made.contactRoom, 1u);
    EXPECT_EQ(made.stepsDone, 60u);
    const char* complaint = nullptr;
    EXPECT_EQ(sinewNextComplaint(info.simulation, &complaint), SINEW_END) << complaint;
    const Positions positions = download(device, info.simulation, SINEW_POSITIONS);
    EXPECT_NEAR(positions[63][1], 0.5f, 0.1f);
    for (const std::array<float, 4>& position : positions) EXPECT_GT(position[1], 0.0f);
}

TEST_F(CApiWorld, ASecondThreadIsRefusedMeanwhile) {
    addBox(world, 0, 0, 4);
    step(1);
    const SinewSimulation simulation = simulationOf(world);
    std::atomic<bool> isOver = false;
    std::atomic<int> stepped = SINEW_OK;
    std::thread other([&] {
        const SinewStep given = sinewDefaultStep();
        while (!isOver)
            if (const SinewResult result = sinewStepWorld(world, &given, 64); result != SINEW_ERROR_IN_USE)
                stepped = result;
    });
    const auto tries = [](const auto& call) { // the other thread works nearly all of the time
        for (int i = 0; i < 5000; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const SinewResult result = call();
            EXPECT_TRUE(result == SINEW_OK || result == SINEW_ERROR_IN_USE) << sinewLastError();
            if (result == SINEW_ERROR_IN_USE) return true;
        }
        return false;
    };
    EXPECT_TRUE(tries([&] {
        SinewSceneCounts counts{};
        counts.size = sizeof counts;
        return sinewGetWorldCounts(world, &counts);
    }));
    EXPECT_TRUE(tries([&] { // its simulation is in use too
        SinewSimulationInfo info{};
        info.size = sizeof info;
        return sinewGetSimulationInfo(simulation, &info);
    }));
    isOver = true;
    other.join();
    EXPECT_EQ(stepped, SINEW_OK);
}

// An engine steps on while the library makes the next simulation.
TEST(CApiWorldRecording, TakesChangesOverBetweenSteps) {
    HostDevice host;
    const SinewHostDevice handles = handlesOf(host);
    Device device;
    ASSERT_TRUE(isOk(sinewBorrowDevice(&handles, &device)));
    Scene ground;
    makeGround(ground);
    const SinewSettings settings = worldSettings();
    World world;
    ASSERT_TRUE(isOk(sinewCreateWorld(device, ground, &settings, &world)));
    host.submit([&](VkCommandBuffer commands) {
        EXPECT_TRUE(isOk(sinewRecordReset(simulationOf(world), commands)));
    });
    SinewStep step = sinewDefaultStep();
    EXPECT_TRUE(failsWith(SINEW_ERROR_UNSUPPORTED, "borrowed", sinewStepWorld(world, &step, 1)));
    const SinewPart part = addBox(world, 0);
    const SinewSimulation before = simulationOf(world);
    std::uint64_t arrivedAt = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (arrivedAt == 0 && std::chrono::steady_clock::now() < end) {
        ++step.frame;
        host.submit([&](VkCommandBuffer commands) { // waits
            std::uint32_t isTakenOver = 9;
            EXPECT_TRUE(isOk(sinewRecordChanges(world, commands, &isTakenOver)));
            if (isTakenOver == 1) arrivedAt = step.frame;
            EXPECT_TRUE(isOk(sinewRecordStep(simulationOf(world), commands, &step)));
        });
    }
    ASSERT_GT(arrivedAt, 1u); // the first call begins to make it
    SinewStatus status{};
    status.size = sizeof status;
    EXPECT_TRUE(isOk(sinewGetWorldStatus(world, arrivedAt - 1, &status))); // of the simulation before
    EXPECT_EQ(status.frame, arrivedAt - 1);
    EXPECT_TRUE(isOk(sinewGetWorldStatus(world, arrivedAt, &status)));
    EXPECT_EQ(sinewGetWorldStatus(world, arrivedAt + 1, &status), SINEW_NOT_READY);
    std::uint32_t isEnough = 9;
    EXPECT_TRUE(isOk(sinewObserveStatus(world, &status, &isEnough)));
    EXPECT_EQ(isEnough, 1u);
    EXPECT_EQ(infoOf(world).isChanging, 0u);
    status.contactRoom = 200; // as if the step had lacked room
    EXPECT_TRUE(isOk(sinewObserveStatus(world, &status, &isEnough)));
    EXPECT_EQ(isEnough, 1u);
    EXPECT_EQ(infoOf(world).isChanging, 1u);
    EXPECT_TRUE(isOk(sinewReleaseReplaced(world)));
    EXPECT_EQ(sinewGetWorldStatus(world, arrivedAt - 1, &status), SINEW_NOT_READY);
    Place place;
    EXPECT_TRUE(isOk(find(world, part, place)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "taken changes over",
                          sinewRecordSkin(before, reinterpret_cast<VkCommandBuffer>(&place))));
}

} // namespace
} // namespace sinew::test
