// A program in C11 without an engine: it makes a cube, lets it fall on a floor, grabs it, and saves a state.
#include "sinew/sinew.h"

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

static void print(void* user, uint32_t severity, const char* sentence) {
    ++*(int*)user;
    printf("log %u: %s\n", (unsigned)severity, sentence);
}

static float lowest(const float* positions, uint32_t count) {
    float low = positions[1];
    for (uint32_t i = 1; i < count; ++i)
        if (positions[4 * i + 1] < low) low = positions[4 * i + 1];
    return low;
}

int main(void) {
    int logged = 0;
    REQUIRE(sinewSetLog(print, &logged));
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    request.isSoftware = 1;
    SinewDevice device;
    REQUIRE(sinewCreateDevice(&request, &device));
    if (logged != 1) return 2; // the chosen device

    SinewScene scene;
    REQUIRE(sinewCreateScene(&scene));
    SinewLattice lattice = sinewDefaultLattice();
    lattice.name = "cube";
    lattice.cells[0] = lattice.cells[1] = lattice.cells[2] = 4;
    lattice.spacing = 0.05f;
    lattice.youngModulus = 3e4f;
    lattice.hasSkin = 1;
    uint32_t body = 99;
    REQUIRE(sinewAddLattice(scene, &lattice, &body));
    SinewPlane floor_ = sinewDefaultPlane();
    floor_.offset = -0.1f;
    floor_.friction = 0.5f;
    REQUIRE(sinewAddPlane(scene, &floor_));

    SinewSettings settings = sinewDefaultSettings();
    settings.substeps = 16;
    settings.grabs = 1;
    SinewSimulation simulation;
    REQUIRE(sinewCreateSimulation(device, scene, &settings, &simulation));
    REQUIRE(sinewDestroyScene(scene));

    SinewStep step = sinewDefaultStep();
    REQUIRE(sinewStep(simulation, &step, 60));
    SinewBufferView view;
    REQUIRE(sinewGetView(simulation, SINEW_POSITIONS, &view));
    const uint32_t count = (uint32_t)(view.size / view.stride);
    float* positions = malloc((size_t)view.size);
    if (positions == NULL) return 3;
    REQUIRE(sinewDownload(device, &view, (size_t)view.size, positions));
    const float landed = lowest(positions, count);
    printf("body %u has %u particles; the lowest is at %.4f m\n", (unsigned)body, (unsigned)count, (double)landed);
    if (body != 0 || count != 125 || fabsf(landed + 0.1f) > 1e-3f) return 4;

    SinewState state;
    REQUIRE(sinewSaveState(simulation, &state));
    SinewGrab grab = sinewDefaultGrab();
    grab.particle = 124;
    grab.radius = 0.1f;
    memcpy(&grab.target, positions + 4 * 124, sizeof grab.target);
    step.grabs = &grab;
    step.grabCount = 1;
    REQUIRE(sinewStep(simulation, &step, 1)); // the grab begins where the particle is
    grab.target.y += 0.4f;
    REQUIRE(sinewStep(simulation, &step, 60));
    REQUIRE(sinewDownload(device, &view, (size_t)view.size, positions));
    printf("pulled, the lowest is at %.4f m\n", (double)lowest(positions, count));
    if (!(lowest(positions, count) > landed + 0.05f)) return 5;
    REQUIRE(sinewLoadState(simulation, state));
    REQUIRE(sinewDownload(device, &view, (size_t)view.size, positions));
    if (lowest(positions, count) != landed) return 6;
    REQUIRE(sinewDestroyState(state));

    SinewStatus status;
    memset(&status, 0, sizeof status);
    status.size = sizeof status;
    REQUIRE(sinewGetStatus(simulation, 120, &status));
    if (status.nonFinite != 0 || status.isUndone != 0) return 7;
    if (sinewDestroyDevice(device) != SINEW_ERROR_IN_USE) return 8;
    REQUIRE(sinewDestroySimulation(simulation));
    if (sinewDestroySimulation(simulation) != SINEW_ERROR_INVALID_HANDLE) return 9;
    REQUIRE(sinewDestroyDevice(device));
    free(positions);
    REQUIRE(sinewSetLog(NULL, NULL));
    return 0;
}
