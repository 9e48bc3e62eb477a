// Programs without an engine: steps, copies, states and impulses on a device and a queue of their own.
#include "sinew/sinew_events.h"

#include "capi/support.hpp"

#include <cmath>
#include <cstring>

namespace sinew::test {
namespace {

class CApiOwnQueue : public OnDevice {
protected:
    SinewSimulationInfo infoOf(SinewSimulation simulation) {
        SinewSimulationInfo info{};
        info.size = sizeof info;
        EXPECT_TRUE(isOk(sinewGetSimulationInfo(simulation, &info)));
        return info;
    }
};

TEST_F(CApiOwnQueue, ManyStepsAtOnceHaveTheBitsOfSingleOnes) {
    Scene scene;
    makeCube(scene);
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 8;
    Simulation one, many;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &one)));
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &many)));
    const SinewStep step = sinewDefaultStep();
    for (int i = 0; i < 30; ++i) ASSERT_TRUE(isOk(sinewStep(one, &step, 1)));
    ASSERT_TRUE(isOk(sinewStep(many, &step, 30)));
    const auto positions = download(device, one, SINEW_POSITIONS);
    EXPECT_EQ(positions, download(device, many, SINEW_POSITIONS));
    ASSERT_EQ(positions.size(), 27u);
    EXPECT_LT(positions[0][1], 0.19f);
    const SinewSimulationInfo info = infoOf(many);
    EXPECT_EQ(info.stepsDone, 30u);
    EXPECT_EQ(info.nextFrame, 30u);
    EXPECT_EQ(info.particles, 27u);
    EXPECT_EQ(info.substeps, 8u);
    EXPECT_EQ(info.oldestInFlight, UINT64_MAX);
    ASSERT_TRUE(isOk(sinewReset(many)));
    EXPECT_EQ(download(device, many, SINEW_POSITIONS)[0][1], 0.2f);
}

TEST_F(CApiOwnQueue, MemoryOfASoftwareDeviceIsReadInPlace) {
    Scene scene;
    makeCube(scene);
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 5)));
    const void* address = nullptr;
    std::size_t size = 0;
    ASSERT_TRUE(isOk(sinewMap(simulation, SINEW_POSITIONS, &address, &size)));
    auto positions = download(device, simulation, SINEW_POSITIONS);
    ASSERT_EQ(size, positions.size() * 16);
    EXPECT_EQ(std::memcmp(address, positions.data(), size), 0);
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 5)));
    EXPECT_NE(std::memcmp(address, positions.data(), size), 0);
    positions = download(device, simulation, SINEW_POSITIONS);
    EXPECT_EQ(std::memcmp(address, positions.data(), size), 0);
    ASSERT_TRUE(isOk(sinewUpdateSkin(simulation)));
    EXPECT_TRUE(isOk(sinewMap(simulation, SINEW_SKIN_VERTICES, &address, &size)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_UNSUPPORTED, "no such output",
                          sinewMap(simulation, SINEW_PIECES, &address, &size)));
}

// A tetrahedron whose faces are islands of a texture: no two share a vertex.
TEST_F(CApiOwnQueue, TextureCoordinatesStandBesideIndices) {
    constexpr SinewVec3 corners[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    constexpr std::uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    std::vector<SinewVec3> vertices;
    std::vector<float> texture;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < 12; ++i) {
        vertices.push_back(corners[faces[i]]);
        texture.insert(texture.end(), {static_cast<float>(i), 0.5f * static_cast<float>(i % 3)});
        triangles.push_back(i);
    }
    SinewMesh mesh = sinewDefaultMesh();
    mesh.vertices = vertices.data();
    mesh.vertexCount = 12;
    mesh.triangles = triangles.data();
    mesh.triangleCount = 4;
    mesh.resolution = 6;
    mesh.textureCoordinates = texture.data();
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    ASSERT_TRUE(isOk(sinewAddMesh(scene, &mesh, nullptr)));
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    SinewBufferView view{};
    ASSERT_TRUE(isOk(sinewReset(simulation))); // fills the buffers
    ASSERT_TRUE(isOk(sinewGetView(simulation, SINEW_TEXTURE_COORDINATES, &view)));
    ASSERT_EQ(view.stride, 8u);
    std::vector<float> seen(view.size / 4);
    ASSERT_TRUE(isOk(sinewDownload(device, &view, view.size, seen.data())));
    EXPECT_EQ(seen, texture);
    ASSERT_TRUE(isOk(sinewGetView(simulation, SINEW_CUT_TEXTURE_COORDINATES, &view)));
    EXPECT_EQ(view.size, 0u); // nothing can be cut
    texture[5] = NAN;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "vertex 2", sinewAddMesh(scene, &mesh, nullptr)));
}

// Loose balls that fall onto each other need more room than one candidate for each.
TEST_F(CApiOwnQueue, StepsThatLackRoomAreRepeatedWithMore) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    std::vector<SinewParticle> balls;
    for (int i = 0; i < 6 * 6 * 6; ++i)
        balls.push_back(
            {.position = {0.1f * static_cast<float>(i % 6), 0.2f + 0.1f * static_cast<float>(i / 6 % 6),
                          0.1f * static_cast<float>(i / 36)},
             .inverseMass = 1,
             .radius = 0.049f});
    ASSERT_TRUE(
        isOk(sinewAddParticles(scene, static_cast<std::uint32_t>(balls.size()), balls.data(), nullptr)));
    const SinewPlane plane = sinewDefaultPlane();
    ASSERT_TRUE(isOk(sinewAddPlane(scene, &plane)));
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 16;
    settings.contactRoom = 64;
    Simulation roomy, scarce;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &roomy)));
    settings.contactRoom = 1;
    settings.events = 1u << SINEW_EVENT_LACKS_ROOM;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &scarce)));
    const void *before = nullptr, *after = nullptr;
    std::size_t size = 0;
    ASSERT_TRUE(isOk(sinewMap(scarce, SINEW_POSITIONS, &before, &size)));
    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStep(roomy, &step, 40)));
    ASSERT_TRUE(isOk(sinewStep(scarce, &step, 40)));
    EXPECT_EQ(infoOf(roomy).contactRoom, 64u);
    EXPECT_GT(infoOf(scarce).contactRoom, 1u);
    EXPECT_EQ(infoOf(scarce).stepsDone, 40u);
    std::uint32_t lacks = 1;
    SinewEvent lack{};
    ASSERT_TRUE(isOk(sinewGetStepEvents(scarce, &lacks, &lack, nullptr)));
    EXPECT_GE(lacks, 1u);
    EXPECT_EQ(lack.kind, static_cast<std::uint32_t>(SINEW_EVENT_LACKS_ROOM));
    EXPECT_GT(lack.count, 1u) << "the room needed";
    EXPECT_EQ(download(device, roomy, SINEW_POSITIONS), download(device, scarce, SINEW_POSITIONS));
    ASSERT_TRUE(isOk(sinewMap(scarce, SINEW_POSITIONS, &after, &size)));
    EXPECT_NE(before, after);
    float sum = 0; // the address that was given out first can still be read
    for (std::size_t i = 0; i < size / 4; ++i) sum += static_cast<const float*>(before)[i];
    EXPECT_TRUE(std::isfinite(sum));
}

TEST_F(CApiOwnQueue, StatesAreSavedAndLoaded) {
    Scene scene;
    makeCube(scene);
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation, other;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 10)));
    State state;
    ASSERT_TRUE(isOk(sinewSaveState(simulation, &state)));
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 10)));
    const auto expected = download(device, simulation, SINEW_POSITIONS);
    ASSERT_TRUE(isOk(sinewLoadState(simulation, state)));
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 10)));
    EXPECT_EQ(download(device, simulation, SINEW_POSITIONS), expected);
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &other))); // of the same scene
    ASSERT_TRUE(isOk(sinewLoadState(other, state)));
    ASSERT_TRUE(isOk(sinewStep(other, &step, 10)));
    EXPECT_EQ(download(device, other, SINEW_POSITIONS), expected);
}

TEST_F(CApiOwnQueue, ImpulsesCarryTheWeight) {
    Scene scene;
    makeCube(scene, 2, 0);
    SinewSettings settings = sinewDefaultSettings();
    settings.keepsForces = 1;
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    const SinewStep step = sinewDefaultStep();
    ASSERT_TRUE(isOk(sinewStep(simulation, &step, 240)));
    const std::uint64_t last = infoOf(simulation).nextFrame - 1;
    SinewBodyImpulses body{};
    std::uint32_t count = 1;
    ASSERT_TRUE(isOk(sinewGetBodyImpulses(simulation, last, &count, &body)));
    EXPECT_EQ(count, 1u);
    const float weight = 1000 * 0.2f * 0.2f * 0.2f * 9.81f; // [N]
    EXPECT_NEAR(body.planes.linear.y / step.dt, weight, 0.02f * weight);
    SinewImpulse plane{};
    ASSERT_TRUE(isOk(sinewGetImpulses(simulation, last, SINEW_IMPULSES_PLANES, &count, &plane)));
    EXPECT_NEAR(plane.linear.y / step.dt, -weight, 0.02f * weight);
    EXPECT_EQ(sinewGetImpulses(simulation, last + 1, SINEW_IMPULSES_PLANES, &count, &plane), SINEW_NOT_READY);
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "kind 9",
                          sinewGetImpulses(simulation, last, 9, &count, &plane)));
}

TEST_F(CApiOwnQueue, AStateThatIsNotFiniteIsRefusedAndUndone) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    const SinewParticle particles[] = {
        {.position = {0, 0, 0}, .inverseMass = 1},
        {.position = {1, 0, 0}, .velocity = {3e38f, 3e38f, 0}, .inverseMass = 1}};
    const SinewLink link{0, 1, 1, 1e-4f};
    ASSERT_TRUE(isOk(sinewAddParticles(scene, 2, particles, nullptr)));
    ASSERT_TRUE(isOk(sinewAddLinks(scene, 1, &link)));
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 4;
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    const SinewStep step = sinewDefaultStep();
    EXPECT_TRUE(failsWith(SINEW_ERROR_DIVERGED, "not finite", sinewStep(simulation, &step, 200)));
    for (const auto& position : download(device, simulation, SINEW_POSITIONS))
        EXPECT_TRUE(std::isfinite(position[0]));
    EXPECT_TRUE(isOk(sinewReset(simulation)));
}

TEST_F(CApiOwnQueue, CopiesCheckTheirSizes) {
    Scene scene;
    makeCube(scene);
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    SinewBufferView view{};
    ASSERT_TRUE(isOk(sinewGetView(simulation, SINEW_SKIN_VERTICES, &view)));
    std::vector<float> values(view.size / 4, 1.5f), back(view.size / 4);
    ASSERT_TRUE(isOk(sinewUpload(device, &view, view.size, values.data())));
    ASSERT_TRUE(isOk(sinewDownload(device, &view, view.size, back.data())));
    EXPECT_EQ(back, values);
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "multiple of 4",
                          sinewDownload(device, &view, 3, back.data())));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "at most",
                          sinewDownload(device, &view, view.size + 4, back.data())));
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "bytes is null", sinewUpload(device, &view, 4, nullptr)));
    ASSERT_TRUE(isOk(sinewGetView(simulation, SINEW_PIECES, &view)));
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "no buffer", sinewDownload(device, &view, 0, back.data())));
}

} // namespace
} // namespace sinew::test
