/* A program that is compiled with the header of now and with one of an earlier version, whose structs are shorter. It prints
   their sizes and a hash of the state after some steps of a cloth and a body of a mesh. */
#include "sinew/sinew.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void require(SinewResult result, int line) {
    if (result == SINEW_OK) return;
    fprintf(stderr, "line %d: %s: %s\n", line, sinewResultName(result), sinewLastError());
    exit(1);
}
#define REQUIRE(call) require(call, __LINE__)

/* A description between bytes that the library must not write, nor read as a part of it. */
#define GUARDED(Type)                                                                                                  \
    struct {                                                                                                           \
        unsigned char before[64];                                                                                      \
        Type value;                                                                                                    \
        unsigned char after[64];                                                                                       \
    }
static void requireGuards(const unsigned char* before, const unsigned char* after, int line) {
    for (int i = 0; i < 64; ++i)
        if (before[i] != 0xa5 || after[i] != 0xa5) {
            fprintf(stderr, "line %d: the library wrote beside a struct\n", line);
            exit(1);
        }
}
#define REQUIRE_GUARDS(guarded) requireGuards((guarded).before, (guarded).after, __LINE__)

int main(void) {
    GUARDED(SinewCloth) cloth;
    GUARDED(SinewMesh) mesh;
    GUARDED(SinewSettings) settings, read;
    memset(&cloth, 0xa5, sizeof cloth);
    memset(&mesh, 0xa5, sizeof mesh);
    memset(&settings, 0xa5, sizeof settings);
    memset(&read, 0xa5, sizeof read);
    REQUIRE(sinewSetDefaults(SINEW_TYPE_CLOTH, &cloth.value, sizeof cloth.value));
    REQUIRE(sinewSetDefaults(SINEW_TYPE_MESH, &mesh.value, sizeof mesh.value));
    REQUIRE(sinewSetDefaults(SINEW_TYPE_SETTINGS, &settings.value, sizeof settings.value));
    REQUIRE_GUARDS(cloth);
    REQUIRE_GUARDS(mesh);
    REQUIRE_GUARDS(settings);

    SinewScene scene;
    REQUIRE(sinewCreateScene(&scene));
    cloth.value.columns = cloth.value.rows = 6;
    cloth.value.isCuttable = 1;
    cloth.value.membraneStiffness = 500;
    REQUIRE(sinewAddCloth(scene, &cloth.value, NULL));
    const SinewVec3 corners[] = {{0, 1, 0}, {0.4f, 1, 0}, {0, 1.4f, 0}, {0, 1, 0.4f}};
    const uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    mesh.value.vertices = corners;
    mesh.value.vertexCount = 4;
    mesh.value.triangles = triangles;
    mesh.value.triangleCount = 4;
    mesh.value.resolution = 6;
    REQUIRE(sinewAddMesh(scene, &mesh.value, NULL));
    settings.value.substeps = 8;
    read.value.size = sizeof read.value;
    REQUIRE(sinewGetSceneSettings(scene, &read.value));
    REQUIRE_GUARDS(read);
    if (read.value.size != sizeof read.value) return 2;

    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    request.isSoftware = 1;
    SinewDevice device;
    REQUIRE(sinewCreateDevice(&request, &device));
    SinewSimulation simulation;
    REQUIRE(sinewCreateSimulation(device, scene, &settings.value, &simulation));
    const SinewStep step = sinewDefaultStep();
    REQUIRE(sinewStep(simulation, &step, 20));
    SinewBufferView view;
    REQUIRE(sinewGetView(simulation, SINEW_POSITIONS, &view));
    unsigned char* bytes = malloc((size_t)view.size);
    if (bytes == NULL) return 3;
    REQUIRE(sinewDownload(device, &view, (size_t)view.size, bytes));
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    for (size_t i = 0; i < (size_t)view.size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
    free(bytes);
    printf("sizes %u %u %u %u\n", (unsigned)sizeof cloth.value, (unsigned)sizeof mesh.value, (unsigned)sizeof settings.value,
           (unsigned)sizeof(SinewHostDevice));
    printf("state %016llx\n", (unsigned long long)hash);
    REQUIRE(sinewDestroySimulation(simulation));
    REQUIRE(sinewDestroyDevice(device));
    REQUIRE(sinewDestroyScene(scene));
    return 0;
}
