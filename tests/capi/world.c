// A program in C11 without an engine: boxes are added to a floor and removed again while they are stepped.
#include "sinew/sinew_world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void require(SinewResult result, int line) {
    if (result == SINEW_OK) return;
    fprintf(stderr, "line %d: %s: %s\n", line, sinewResultName(result), sinewLastError());
    exit(1);
}
#define REQUIRE(call) require(call, __LINE__)

static SinewScene makeBox(float x) {
    SinewScene scene;
    REQUIRE(sinewCreateScene(&scene));
    SinewLattice lattice = sinewDefaultLattice();
    lattice.cells[0] = lattice.cells[1] = lattice.cells[2] = 2;
    lattice.spacing = 0.05f;
    lattice.youngModulus = 3e4f;
    lattice.origin.x = x;
    lattice.origin.y = 0.2f;
    REQUIRE(sinewAddLattice(scene, &lattice, NULL));
    return scene;
}

static SinewPart addBox(SinewWorld world, float x) {
    const SinewScene box = makeBox(x);
    SinewPart part;
    REQUIRE(sinewAddPart(world, box, &part));
    REQUIRE(sinewDestroyScene(box));
    return part;
}

// Position of the first particle of a part.
static void readPart(SinewDevice device, SinewWorld world, SinewPart part, float position[4]) {
    SinewSceneCounts first, count;
    first.size = count.size = sizeof first;
    REQUIRE(sinewFindPart(world, part, &first, &count));
    if (count.particles != 27 || count.bodies != 1) exit(2);
    SinewSimulation simulation;
    REQUIRE(sinewGetWorldSimulation(world, &simulation));
    SinewBufferView view;
    REQUIRE(sinewGetView(simulation, SINEW_POSITIONS, &view));
    view.offset += (VkDeviceSize)first.particles * view.stride;
    view.size = (VkDeviceSize)count.particles * view.stride;
    REQUIRE(sinewDownload(device, &view, 4 * sizeof(float), position));
}

int main(void) {
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    request.isSoftware = 1;
    SinewDevice device;
    REQUIRE(sinewCreateDevice(&request, &device));
    SinewScene base;
    REQUIRE(sinewCreateScene(&base));
    const SinewPlane ground = sinewDefaultPlane();
    REQUIRE(sinewAddPlane(base, &ground));
    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 8;
    SinewWorld world;
    REQUIRE(sinewCreateWorld(device, base, &settings, &world));
    REQUIRE(sinewDestroyScene(base));

    const SinewPart left = addBox(world, 0);
    SinewStep step = sinewDefaultStep();
    REQUIRE(sinewStepWorld(world, &step, 10));
    SinewSimulation before;
    REQUIRE(sinewGetWorldSimulation(world, &before));
    const SinewPart right = addBox(world, 1);
    REQUIRE(sinewStepWorld(world, &step, 110));
    float atLeft[4], atRight[4];
    readPart(device, world, left, atLeft);
    readPart(device, world, right, atRight);
    printf("the boxes are at %.4f, %.4f m and at %.4f, %.4f m\n", (double)atLeft[0], (double)atLeft[1],
           (double)atRight[0], (double)atRight[1]);
    if (fabsf(atLeft[1]) > 1e-3f || fabsf(atRight[1]) > 1e-3f) return 3; // both lie on the floor
    if (fabsf(atLeft[0]) > 0.01f || fabsf(atRight[0] - 1) > 0.01f) return 4;

    SinewSimulationInfo info;
    memset(&info, 0, sizeof info);
    info.size = sizeof info;
    if (sinewGetSimulationInfo(before, &info) != SINEW_ERROR_INVALID_HANDLE) return 5; // it was replaced
    REQUIRE(sinewRemovePart(world, left));
    REQUIRE(sinewStepWorld(world, &step, 5));
    SinewWorldInfo state;
    memset(&state, 0, sizeof state);
    state.size = sizeof state;
    REQUIRE(sinewGetWorldInfo(world, &state));
    if (state.takeOvers != 3 || state.isChanging || state.isReady || state.substeps != 8) return 6;
    REQUIRE(sinewGetSimulationInfo(state.simulation, &info));
    if (info.particles != 27 || info.stepsDone != 125) return 7;
    uint32_t isContained = 1;
    REQUIRE(sinewContainsPart(world, left, &isContained));
    if (isContained) return 8;
    if (sinewRemovePart(world, left) != SINEW_ERROR_INVALID_HANDLE) return 9;
    printf("%s\n", sinewLastError());
    if (sinewDestroyDevice(device) != SINEW_ERROR_IN_USE) return 10;
    REQUIRE(sinewDestroyWorld(world));
    if (sinewDestroyWorld(world) != SINEW_ERROR_INVALID_HANDLE) return 11;
    REQUIRE(sinewDestroyDevice(device));
    return 0;
}
