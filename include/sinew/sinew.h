// The C interface of Sinew: soft bodies as Vulkan compute. C11, and C++ from C++98 on.
//
// Functions return SINEW_OK, a positive result that is no error, or a negative one; sinewLastError() then has
// a sentence. Nothing is thrown across this interface, lack of memory included, and a call that fails leaves
// its objects as they were unless its comment says otherwise.
//
// Handles are numbers. A handle that is null, destroyed or of another kind is detected and gives
// SINEW_ERROR_INVALID_HANDLE. A device lives until everything made with it is destroyed: destroying it
// earlier gives SINEW_ERROR_IN_USE.
// Descriptions begin with `size`, which sinewDefault...() fills in; results of sinewGet...() begin with it too,
// and the caller sets it. The library knows the sizes of earlier headers: members that one lacks have their
// defaults, and results leave them out. A larger description is accepted if all bytes beyond are 0, a larger
// result gets zeros there. Other sizes give SINEW_ERROR_INVALID_ARGUMENT. Elements of arrays have no size: they
// do not change before the version of the library file does. Pointers are read during the call only, except
// those of the log and of a buffer hook. Flags are 0 or 1.
//
// Threads: any thread may use any object, one at a time. A second thread that uses a scene, simulation or state
// meanwhile gets SINEW_ERROR_IN_USE; a device may be used by several threads. Scenes may be read by several ones.
//
// Units are SI: metres, seconds, kilograms, newtons, radians. y points up. A host can replace the memory of
// buffers (SinewHostDevice::createBuffer) and what Vulkan allocates (allocation); Sinew's own objects use malloc.
#ifndef SINEW_SINEW_H
#define SINEW_SINEW_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#if defined(_WIN32) && defined(SINEW_C_BUILDS)
#define SINEW_C_API __declspec(dllexport)
#elif defined(__GNUC__)
#define SINEW_C_API __attribute__((visibility("default")))
#else
#define SINEW_C_API
#endif
#ifdef __cplusplus
extern "C" {
#endif

// --- Results and messages
typedef int32_t SinewResult;
enum {
    SINEW_OK = 0,
    SINEW_NOT_READY = 1,               // the step has not finished, or its status is no longer kept
    SINEW_END = 2,                     // there is no such element: the end of a list
    SINEW_ERROR_INVALID_ARGUMENT = -1, // null, a wrong size, or a number out of its range
    SINEW_ERROR_INVALID_HANDLE = -2,   // null, destroyed, or of another kind
    SINEW_ERROR_IN_USE = -3,           // another thread uses the object, or others were made with it
    SINEW_ERROR_INVALID_SCENE = -4,    // sinewValidate() has complaints
    SINEW_ERROR_NO_DEVICE = -5,        // no loader, driver or device that can run Sinew
    SINEW_ERROR_OUT_OF_MEMORY = -6,    // of host or device, or a limit of the device
    SINEW_ERROR_DEVICE_LOST = -7,      // VK_ERROR_DEVICE_LOST
    SINEW_ERROR_FILE = -8,             // a file cannot be read
    SINEW_ERROR_UNSUPPORTED = -9,      // the device or this build of the library has no such function
    SINEW_ERROR_MISMATCH = -10,        // a state, simulation or buffer does not fit the simulation
    SINEW_ERROR_DIVERGED = -11,        // a state is not finite, or there are too many contacts
    SINEW_ERROR_INTERNAL = -12         // a fault of Sinew
};

// Version of the library, major << 22 | minor << 12 | patch: that of the library, not of this header.
SINEW_C_API uint32_t sinewVersion(void);
// "SINEW_ERROR_FILE"; "unknown result" for other numbers. Static text.
SINEW_C_API const char* sinewResultName(SinewResult result);
// Sentence on the last call of this thread that failed; empty before. Valid until this thread's next call.
SINEW_C_API const char* sinewLastError(void);

enum { SINEW_LOG_INFO = 0, SINEW_LOG_WARNING = 1, SINEW_LOG_ERROR = 2 };
// Gets a sentence, in the thread of the call that it is about. Must not call Sinew, throw or return by longjmp.
typedef void (*SinewLog)(void* user, uint32_t severity, const char* sentence);
// Sets the log of the process, null for none: the chosen device, messages of validation, warnings of scenes,
// and each failed call. Without a log nothing is printed.
SINEW_C_API SinewResult sinewSetLog(SinewLog log, void* user);

// Sets `size` and the defaults in a description of `size` bytes. The functions sinewDefault...() of descriptions
// call it with the size that this header gives them.
enum {
    SINEW_TYPE_DEVICE_REQUEST = 0, SINEW_TYPE_HOST_DEVICE = 1, SINEW_TYPE_PLANE = 2, SINEW_TYPE_COLLIDER = 3,
    SINEW_TYPE_CLOTH = 4, SINEW_TYPE_LATTICE = 5, SINEW_TYPE_MESH = 6, SINEW_TYPE_SETTINGS = 7, SINEW_TYPE_STEP = 8
};
SINEW_C_API SinewResult sinewSetDefaults(uint32_t type, void* description, size_t size);
#define SINEW_DEFAULTS(Type, TYPE) Type made; sinewSetDefaults(SINEW_TYPE_##TYPE, &made, sizeof made); return made

// --- Devices
typedef struct SinewDevice {
    uint64_t id;
} SinewDevice;
// A device for a program without an engine. It opens the Vulkan loader and has a queue of its own.
typedef struct SinewDeviceRequest {
    uint32_t size;
    uint32_t isSoftware;       // only a software device (lavapipe); `device` is then null
    const char* device;        // index as printed by `sinew devices`, or part of a name; null = the best
    uint32_t hasValidation;    // VK_LAYER_KHRONOS_validation; its messages go to the log
    uint32_t reserved;         // 0
    const void* pipelineCache; // bytes of sinewGetPipelineCache() of an earlier run, or null; unfit ones are ignored
    size_t pipelineCacheSize;  // [B]
} SinewDeviceRequest;

static inline SinewDeviceRequest sinewDefaultDeviceRequest(void) { SINEW_DEFAULTS(SinewDeviceRequest, DEVICE_REQUEST); }
// Errors: NO_DEVICE with what each device lacks, OUT_OF_MEMORY.
SINEW_C_API SinewResult sinewCreateDevice(const SinewDeviceRequest* request, SinewDevice* device);

enum { SINEW_MEMORY_DEVICE = 0, SINEW_MEMORY_UPLOAD = 1, SINEW_MEMORY_READBACK = 2 };
// A bound buffer of a host. Upload and readback memory is mapped. `memory` is null if it is host coherent;
// else it is what Sinew flushes and invalidates, mapped whole, with the buffer at `memoryOffset`.
typedef struct SinewBuffer {
    VkBuffer buffer;
    void* mapped;
    uint64_t token; // for the host's own use
    VkDeviceMemory memory;
    VkDeviceSize memoryOffset, memorySize; // [B]
} SinewBuffer;
// Returns SINEW_OK, SINEW_ERROR_OUT_OF_MEMORY or SINEW_ERROR_DEVICE_LOST. One call at a time.
typedef SinewResult (*SinewCreateBuffer)(void* user, const VkBufferCreateInfo* info, uint32_t memory, const char* name,
                                         SinewBuffer* buffer);
typedef void (*SinewDestroyBuffer)(void* user, const SinewBuffer* buffer);

// Handles of a host engine, which outlive the SinewDevice. Sinew destroys none of them, uses no queue and
// needs Vulkan 1.2, a family with compute and no optional feature.
typedef struct SinewHostDevice {
    uint32_t size;
    uint32_t apiVersion; // that the instance was made for; VK_API_VERSION_1_2 or later
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    uint32_t queueFamily;            // to which recorded steps are submitted
    uint32_t instanceExtensionCount; // enabled ones; Sinew looks for VK_EXT_debug_utils
    const char* const* instanceExtensions;
    SinewCreateBuffer createBuffer; // both null = blocks of Sinew's own
    SinewDestroyBuffer destroyBuffer;
    void* bufferUser;
    const void* pipelineCache; // as in SinewDeviceRequest
    size_t pipelineCacheSize;
    const VkAllocationCallbacks* allocation; // for each Vulkan object that Sinew makes; null = the driver's own
} SinewHostDevice;

static inline SinewHostDevice sinewDefaultHostDevice(void) { SINEW_DEFAULTS(SinewHostDevice, HOST_DEVICE); }
SINEW_C_API SinewResult sinewBorrowDevice(const SinewHostDevice* host, SinewDevice* device);
// Errors: IN_USE while simulations of the device exist.
SINEW_C_API SinewResult sinewDestroyDevice(SinewDevice device);

typedef struct SinewDeviceInfo {
    uint32_t size;
    uint32_t queueFamily;
    uint32_t isSoftware, hasQueue; // hasQueue: made by sinewCreateDevice()
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    char name[256], driver[256];
} SinewDeviceInfo;
SINEW_C_API SinewResult sinewGetDeviceInfo(SinewDevice device, SinewDeviceInfo* info);
// The pipelines made so far, for the next run. With bytes null, sets *size to the size needed [B]; else
// copies at most *size bytes and sets *size. Errors: INVALID_ARGUMENT if *size is too small.
SINEW_C_API SinewResult sinewGetPipelineCache(SinewDevice device, size_t* size, void* bytes);

// --- Scenes
typedef struct SinewVec3 {
    float x, y, z;
} SinewVec3;
typedef struct SinewQuaternion {
    float x, y, z, w;
} SinewQuaternion;
typedef struct SinewPose {
    SinewVec3 position;
    SinewQuaternion rotation;
} SinewPose;

typedef struct SinewScene {
    uint64_t id;
} SinewScene;
// An empty scene. Indices of what is added count from 0; nothing is removed.
SINEW_C_API SinewResult sinewCreateScene(SinewScene* scene);
// A scene file (TOML), or a mesh file, which is dropped on a floor. Blades and camera of the file are left
// out. Errors: FILE with the line and the reason; UNSUPPORTED if the library was built without files.
SINEW_C_API SinewResult sinewLoadScene(const char* path, SinewScene* scene);
SINEW_C_API SinewResult sinewDestroyScene(SinewScene scene);

typedef struct SinewSceneValues {
    uint32_t size;
    float dt;                       // length of a step [s], above 0 and at most 0.1
    SinewVec3 gravity;              // [m/s^2]
    float damping;                  // rate of velocity decay [1/s]
    float dampingTime;              // internal damping of links [s]
    float friction, staticFriction; // between particles and faces, Coulomb
    float restitution;              // 0 to 1
    float recoverySpeed;            // at which initial overlaps part [m/s]
    uint32_t debris;                // pieces with fewer particles are removed by a cut
} SinewSceneValues;
SINEW_C_API SinewResult sinewGetSceneValues(SinewScene scene, SinewSceneValues* values);
SINEW_C_API SinewResult sinewSetSceneValues(SinewScene scene, const SinewSceneValues* values);

typedef struct SinewSceneCounts {
    uint32_t size;
    uint32_t particles, links, bends, tethers, fixed, attachments, faces, planes, colliders, bodies, grids, skins;
} SinewSceneCounts;
SINEW_C_API SinewResult sinewGetSceneCounts(SinewScene scene, SinewSceneCounts* counts);

typedef struct SinewParticle {
    SinewVec3 position, velocity; // [m], [m/s]
    float inverseMass;            // [1/kg]; 0 = never moves
    float radius;                 // of contacts with other particles and faces [m]; 0 = none
    float contactOffset;          // distance kept from planes and colliders [m]
    uint32_t keepsRest;           // pairs that overlap at load keep that distance
} SinewParticle;
typedef struct SinewLink {
    uint32_t a, b;
    float restLength, compliance;
} SinewLink; // [m], [m/N]; 0 = rigid
typedef struct SinewBend {
    uint32_t a, b, c;
    float compliance;
} SinewBend; // b is the middle one; [m/N]
typedef struct SinewTether {
    uint32_t particle, anchor;
    float length;
} SinewTether; // at most [m]
// A spring to a point that SinewStep::anchors moves.
typedef struct SinewAttachment {
    uint32_t particle;
    SinewVec3 anchor; // [m]
    float compliance; // [m/N]; 0 = the particle is at the point
    float maxForce;   // [N]; 0 = unlimited
    float maxSpeed;   // of the point [m/s]; 0 = unlimited
} SinewAttachment;
typedef struct SinewFace {
    uint32_t particles[3];
    float thickness;
    uint32_t isSolid;
} SinewFace; // [m]

// Append arrays of `count` elements; `first`, if not null, receives the index of the first one. Indices may
// name particles that are added later: sinewValidate() checks them.
SINEW_C_API SinewResult sinewAddParticles(SinewScene scene, uint32_t count, const SinewParticle* particles,
                                          uint32_t* first);
SINEW_C_API SinewResult sinewAddLinks(SinewScene scene, uint32_t count, const SinewLink* links);
SINEW_C_API SinewResult sinewAddBends(SinewScene scene, uint32_t count, const SinewBend* bends);
SINEW_C_API SinewResult sinewAddTethers(SinewScene scene, uint32_t count, const SinewTether* tethers);
SINEW_C_API SinewResult sinewAddFixed(SinewScene scene, uint32_t count, const uint32_t* particles);
SINEW_C_API SinewResult sinewAddAttachments(SinewScene scene, uint32_t count, const SinewAttachment* attachments,
                                            uint32_t* first);
SINEW_C_API SinewResult sinewAddFaces(SinewScene scene, uint32_t count, const SinewFace* faces);
// Copies particles [first, first + count) at the start of the simulation. Errors: INVALID_ARGUMENT if there
// are fewer.
SINEW_C_API SinewResult sinewGetParticles(SinewScene scene, uint32_t first, uint32_t count, SinewParticle* particles);

typedef struct SinewBody {
    uint32_t size;
    uint32_t firstParticle, particleCount;
    float restVolume; // [m^3]; 0 = encloses none
    char name[64];    // cut short if longer
} SinewBody;
// Names a range of particles, for impulses and messages. `body`, if not null, receives its index.
SINEW_C_API SinewResult sinewAddBody(SinewScene scene, const char* name, uint32_t firstParticle, uint32_t particleCount,
                                     uint32_t* body);
// Returns SINEW_END behind the last one.
SINEW_C_API SinewResult sinewGetBody(SinewScene scene, uint32_t index, SinewBody* body);
// Rotates a body about its middle, and sets the velocity of its centre of mass [m/s] and its spin [rad/s].
SINEW_C_API SinewResult sinewSetMotion(SinewScene scene, uint32_t body, SinewVec3 velocity, SinewVec3 spin,
                                       SinewQuaternion rotation);

typedef struct SinewPlane {
    uint32_t size;
    SinewVec3 normal; // unit length, into the free side
    float offset;     // normal . x >= offset [m]
    float friction, staticFriction, restitution;
} SinewPlane;
static inline SinewPlane sinewDefaultPlane(void) { SINEW_DEFAULTS(SinewPlane, PLANE); }
SINEW_C_API SinewResult sinewAddPlane(SinewScene scene, const SinewPlane* plane);

enum { SINEW_SPHERE = 0, SINEW_CAPSULE = 1, SINEW_BOX = 2 };
typedef struct SinewKeyframe {
    float time;
    SinewPose pose;
} SinewKeyframe; // [s]
typedef struct SinewCollider {
    uint32_t size;
    uint32_t shape;
    float radius, halfLength; // of spheres and capsules, along y [m]
    SinewVec3 halfExtents;    // of boxes [m]
    float margin;             // [m]
    float friction, staticFriction, restitution;
    SinewPose pose; // without keyframes
    uint32_t keyframeCount, loops;
    const SinewKeyframe* keyframes; // times ascending
} SinewCollider;
static inline SinewCollider sinewDefaultCollider(void) { SINEW_DEFAULTS(SinewCollider, COLLIDER); }
SINEW_C_API SinewResult sinewAddCollider(SinewScene scene, const SinewCollider* collider);

// A sheet of columns x rows particles, with links along edges and diagonals, and a skin.
typedef struct SinewCloth {
    uint32_t size;
    uint32_t columns, rows;                   // at least 2
    float spacing;                            // [m]
    const char* name;                         // null = "cloth"
    SinewVec3 origin;                         // of particle 0 [m]
    SinewVec3 right, down;                    // unit directions of a row and a column
    float areaDensity;                        // [kg/m^2]
    float membraneStiffness;                  // Young's modulus x thickness [N/m]; 0 = by the two compliances
    float stretchCompliance, shearCompliance; // [m/N]
    float bendingStiffness;                   // [N m]; 0 = none
    float skipStiffness;                      // against folds [N/m]; 0 = none
    float thickness;                          // in contacts [m]; 0 = touches planes and colliders alone
    float radius;                             // of a particle in contacts [m]
    uint32_t tethers;                         // a particle, to fixed ones
    uint32_t isCuttable;
    float tearStrain; // 0 = never tears
    uint32_t pinnedCount;
    const uint32_t* pinned; // particles of the sheet that are fixed, row by row
    float toughness;        // as in SinewLattice [J/m]
} SinewCloth;
static inline SinewCloth sinewDefaultCloth(void) { SINEW_DEFAULTS(SinewCloth, CLOTH); }
SINEW_C_API SinewResult sinewAddCloth(SinewScene scene, const SinewCloth* cloth, uint32_t* body);

// A body of cubic cells with particles on their corners.
typedef struct SinewLattice {
    uint32_t size;
    uint32_t cells[3];
    const char* name;   // null = "lattice"
    SinewVec3 origin;   // low corner [m]
    float spacing;      // edge of a cell [m]
    float youngModulus; // [Pa]
    float poissonRatio; // 0.25 to 0.49
    float recovery;     // pressure that unfolds cells [shear moduli], 0 to 10
    float density;      // [kg/m^3]
    float radius;       // of a particle in contacts [m], at most half of the spacing
    uint32_t hasBodyDiagonals, isCuttable;
    float tearStrain;  // 0 = never tears
    uint32_t hasSkin, hasFaces; // of the outer faces; hasFaces: for contacts, needs a radius
    float toughness;   // work of a blade on what it cuts [J/m^2]: SINEW_IMPULSES_BLADE
    const float* fill; // share of each cell that is material, x fastest; null = all whole
    size_t fillCount;  // 0, or cells[0] x cells[1] x cells[2]
} SinewLattice;
static inline SinewLattice sinewDefaultLattice(void) { SINEW_DEFAULTS(SinewLattice, LATTICE); }
SINEW_C_API SinewResult sinewAddLattice(SinewScene scene, const SinewLattice* lattice, uint32_t* body);

// A voxel body of a triangle mesh, with the mesh as its skin. Small holes and seams are closed.
typedef struct SinewMesh {
    uint32_t size;
    uint32_t vertexCount;
    const char* name;          // null = "mesh"
    const SinewVec3* vertices; // [m]
    const uint32_t* triangles; // three a triangle, counter-clockwise from outside
    uint32_t triangleCount;
    float spacing;                                       // edge of a voxel [m]; 0 = by `resolution`
    uint32_t resolution;                                 // voxels along the longest side, 1 to 512
    float youngModulus, poissonRatio, recovery, density; // as in SinewLattice
    uint32_t touches, isCuttable; // touches: particles have a radius of half a voxel
    float tearStrain, toughness;
    const float* textureCoordinates; // u and v of each vertex; null = none. A seam is two vertices at one place
} SinewMesh;
static inline SinewMesh sinewDefaultMesh(void) { SINEW_DEFAULTS(SinewMesh, MESH); }
SINEW_C_API SinewResult sinewAddMesh(SinewScene scene, const SinewMesh* mesh, uint32_t* body);
// The same of a mesh in an OBJ, STL, PLY, glTF 2 or GLB file: coordinates times `scale` are metres; vertices
// and triangles of `mesh` are not used. Reads in a child process (fork). Errors as sinewLoadScene().
SINEW_C_API SinewResult sinewAddMeshFile(SinewScene scene, const char* path, float scale, const SinewMesh* mesh,
                                         uint32_t* body);

// --- Settings
enum { SINEW_SOLVER_JACOBI = 0, SINEW_SOLVER_SPLIT = 1, SINEW_SOLVER_GAUSS_SEIDEL = 2 };
typedef struct SinewSettings {
    uint32_t size;
    uint32_t solver;
    uint32_t substeps;                     // a step, 1 to 1000; 0 = chosen by stiffness and tolerance
    uint32_t iterations;                   // a substep; `split` has one
    float tolerance;                       // with substeps 0: share of stiffness that may be lost
    float contactMargin;                   // [median radii]
    uint32_t contactRoom;                  // mean capacity of contact lists, 1 to 1024
    uint32_t cutSurfaceRoom;               // triangles of the surface of cuts; 0 = by the scene
    uint32_t sleeps;                       // bodies at rest cost nothing
    uint32_t keepsForces;                  // for sinewGetBodyImpulses() and sinewGetImpulses()
    uint32_t grabs, hostColliders, fields, motions; // in a step: up to 8, 1024, 16 and 64
    uint32_t framesInFlight;               // steps recorded and not finished, 1 to 64
    float omega, theta;                    // of `split`
    float weight, overRelaxation, warmStart; // two of `jacobi`; of `gauss_seidel`
    uint32_t isReversed;                   // runs kernels in reversed order, with the same results
    uint32_t levels;                       // of `split`: coarse levels of bodies on grids, 0 to 6, or SINEW_AUTO_LEVELS
    uint32_t events, eventRoom;            // kinds listed, and events kept of a step: sinew_events.h
    uint32_t keepsPrevious;                // keeps SINEW_PREVIOUS_POSITIONS and SINEW_PREVIOUS_SKIN_VERTICES
    uint32_t hasSharpClamp;                // of `split`: links are clamped by the directions in which they meet
    uint32_t outputFrames;                 // steps of which sinewGetFrameView() of sinew_query.h has the outputs, 0 to 8
    uint32_t outputUsage, outputFamilies;  // of outputs: further VkBufferUsageFlags; bits of queue families that share them
} SinewSettings;
#define SINEW_AUTO_LEVELS 0xffffffffu // as many as win at equal error, by the kind and size of bodies and the substeps
static inline SinewSettings sinewDefaultSettings(void) { SINEW_DEFAULTS(SinewSettings, SETTINGS); }
// The settings of a scene that sinewLoadScene() read; else the default ones.
SINEW_C_API SinewResult sinewGetSceneSettings(SinewScene scene, SinewSettings* settings);
// Errors: INVALID_SCENE with a sentence a line, at most 20.
SINEW_C_API SinewResult sinewValidate(SinewScene scene, const SinewSettings* settings);
// The passes, buffers and barriers of a step as text; needs no device. With text null, sets *size to the size
// with its final zero [B]; else copies and sets it. Errors: INVALID_SCENE, INVALID_ARGUMENT if too small.
SINEW_C_API SinewResult sinewDescribe(SinewScene scene, const SinewSettings* settings, size_t* size, char* text);

// --- Simulations
typedef struct SinewSimulation {
    uint64_t id;
} SinewSimulation;
// Makes buffers and pipelines. The scene may be changed or destroyed afterwards. Errors: INVALID_SCENE,
// OUT_OF_MEMORY with the buffer and its size, NO_DEVICE if a kernel needs more than the device has.
SINEW_C_API SinewResult sinewCreateSimulation(SinewDevice device, SinewScene scene, const SinewSettings* settings,
                                              SinewSimulation* simulation);
// All commands recorded with it must have finished, or never be submitted.
SINEW_C_API SinewResult sinewDestroySimulation(SinewSimulation simulation);

typedef struct SinewSimulationInfo {
    uint32_t size;
    uint32_t particles, bodies, skins;
    uint32_t solver, substeps;
    uint32_t contactRoom, cutSurfaceRoom; // of its settings, which sinewStep() may have raised
    uint64_t stepsDone;                   // by sinewStep()
    uint64_t nextFrame;                   // number of the next step of sinewStep(); the newest one is the number before
    uint64_t stateSize;                   // of sinewRecordSaveState() [B]
    uint64_t stateKey;                    // equal if a saved state fits
    uint64_t oldestInFlight;              // frame of a step that has not finished; UINT64_MAX = none
} SinewSimulationInfo;
SINEW_C_API SinewResult sinewGetSimulationInfo(SinewSimulation simulation, SinewSimulationInfo* info);

// A pull on the particles near one particle. In its first step the held point is at the target; it follows from then on.
typedef struct SinewGrab {
    uint32_t particle;
    float radius;          // [m]; 0 = this particle alone
    SinewVec3 target;      // of the held point at the end of the step [m]
    float stiffness;       // [1/s^2]
    float damping;         // [1/s]
    float maxAcceleration; // [m/s^2]
    float maxSpeed;        // [m/s]
} SinewGrab;
typedef struct SinewHostCollider {
    uint32_t shape;
    float radius, halfLength; // [m]
    SinewVec3 halfExtents;    // [m]
    float friction, staticFriction;
    SinewPose pose; // at the end of the step
    float maxSpeed; // of its points [m/s]
} SinewHostCollider;
enum { SINEW_FIELD_UNIFORM = 0, SINEW_FIELD_RADIAL = 1, SINEW_FIELD_WIND = 2, SINEW_FIELD_TURBULENCE = 3 };
#define SINEW_ALL_BODIES 0xffffffffu
typedef struct SinewField {
    uint32_t kind;
    uint32_t body;    // index, or SINEW_ALL_BODIES
    SinewVec3 vector; // uniform: acceleration [m/s^2]; wind: velocity [m/s]; turbulence: displacement [m]
    SinewVec3 center; // of a radial field, and of the region [m]
    float radius;     // of the region [m]; 0 = everywhere
    float strength;   // radial, turbulence: acceleration [m/s^2]; wind: density x drag / 2 [kg/m^3]
    float scale;      // of turbulence [m]
} SinewField;
SINEW_C_API SinewGrab sinewDefaultGrab(void);
SINEW_C_API SinewHostCollider sinewDefaultHostCollider(void);
SINEW_C_API SinewField sinewDefaultField(void);

// Input of a step. Items beyond the numbers of SinewSettings are left out, with a complaint.
typedef struct SinewStep {
    uint32_t size;
    float dt;          // 1e-6 to 0.1 [s]
    uint64_t frame;    // one more with every step; sinewStep() counts by itself
    SinewVec3 gravity; // [m/s^2]
    uint32_t wakes;    // all sleeping particles
    uint32_t repeats;  // the host repeats steps with SinewStatus::lacksLists; sinewStep() does
    uint32_t anchorCount, grabCount, hostColliderCount, fieldCount, motionCount;
    uint32_t bladeCount;      // points of each poly-line, 2 to 256; 0 = no blade
    const SinewVec3* anchors; // of attachments at the end of the step [m]
    const SinewGrab* grabs;
    const SinewHostCollider* hostColliders;
    const SinewField* fields;
    const struct SinewMotion* motions; // sinew_motions.h
    const SinewVec3 *bladeFrom, *bladeTo; // edge of the blade before and after the step [m]
    uint32_t bladeIsCarried;              // continues the stroke of the step before
    SinewVec3 rayFrom, rayTo;             // cuts links nearer than rayRadius to this segment [m]
    float rayRadius;                      // [m]; 0 = no cut
} SinewStep;
static inline SinewStep sinewDefaultStep(void) { SINEW_DEFAULTS(SinewStep, STEP); }

// Record into a command buffer of the host, which is recording, outside a render pass, and submitted once and
// in order to one queue family. They submit, wait and allocate nothing. The first one is a reset. Afterwards
// the views are visible to vertex input, compute and transfer on that queue.
SINEW_C_API SinewResult sinewRecordReset(SinewSimulation simulation, VkCommandBuffer commands);
SINEW_C_API SinewResult sinewRecordStep(SinewSimulation simulation, VkCommandBuffer commands, const SinewStep* step);
// Writes vertices and normals of all skins.
SINEW_C_API SinewResult sinewRecordSkin(SinewSimulation simulation, VkCommandBuffer commands);
// Records the copies that continue `from` in `simulation`, of the same scene and device; all steps of `from`
// have finished. Instead of a reset. Errors: MISMATCH, and nothing is recorded.
SINEW_C_API SinewResult sinewRecordTakeOver(SinewSimulation simulation, VkCommandBuffer commands, SinewSimulation from);

enum {
    SINEW_POSITIONS = 0,     // a vec4 a particle: [m], inverse mass [1/kg] (0 while it sleeps)
    SINEW_VELOCITIES = 1,    // a vec4 a particle [m/s]
    SINEW_SKIN_VERTICES = 2, // position and normal, a vec4 each
    SINEW_SKIN_INDICES = 3,  // 32 bits, of triangles: ranges by sinewGetSkin()
    SINEW_PIECES = 4,        // of cuttable bodies: for each particle the one that names its piece
    SINEW_PIECE_SIZES = 5,   // particles of the piece that a particle names
    SINEW_PIECE_DRAWS = 6,   // VkDrawIndexedIndirectCommand a skin: torn parts of sheets
    SINEW_CUT_VERTICES = 7,  // surface of cuts: as SINEW_SKIN_VERTICES
    SINEW_CUT_REST = 8,      // 64 bytes a vertex: position in the uncut body first
    SINEW_CUT_INDICES = 9,
    SINEW_CUT_DRAWS = 10, // two VkDrawIndexedIndirectCommand: inside, pieces of skins
    SINEW_FORCE_SUMS = 11, // sums behind the impulses
    SINEW_PREVIOUS_POSITIONS = 12,    // at the start of the newest step; SinewSettings::keepsPrevious
    SINEW_PREVIOUS_SKIN_VERTICES = 13, // before the newest sinewRecordSkin(); SinewSettings::keepsPrevious
    SINEW_TEXTURE_COORDINATES = 14, // u, v of each of SINEW_SKIN_INDICES (SinewMesh::textureCoordinates)
    SINEW_CUT_TEXTURE_COORDINATES = 15 // u, v of each of SINEW_CUT_VERTICES that pieces of skins have
};
typedef struct SinewBufferView {
    VkBuffer buffer;           // null if there is nothing to view
    VkDeviceSize offset, size; // [B]
    uint32_t stride, reserved; // stride [B]
} SinewBufferView;
// Views stay valid as long as the simulation; sinewStep() may replace them when it needs more room.
SINEW_C_API SinewResult sinewGetView(SinewSimulation simulation, uint32_t output, SinewBufferView* view);

typedef struct SinewSkin {
    uint32_t size;
    uint32_t firstIndex, indexCount; // in SINEW_SKIN_INDICES
    SinewVec3 color;                 // linear RGB
    char name[64];
} SinewSkin;
// Returns SINEW_END behind the last one.
SINEW_C_API SinewResult sinewGetSkin(SinewSimulation simulation, uint32_t index, SinewSkin* skin);

typedef struct SinewStatus {
    uint32_t size;
    uint32_t frame;       // low 32 bits
    uint64_t stepsUndone; // since the simulation was made
    uint32_t isUndone;    // the state before the step stays: nonFinite, contactRoom or lacksLists says why
    uint32_t nonFinite, firstBadParticle;
    uint32_t contactRoom; // needed, if there is less; else 0
    uint32_t lacksLists, isCalm, laterLists;
    uint32_t slowed;   // particles, a substep, that were slowed so that contacts are found
    uint32_t sleeping; // particles
    float lostTime;    // [s]
    uint32_t linksCut, linksCutInAll, pieces, debris, debrisParticles;
    float debrisMass;           // [kg]
    uint32_t cutSurfaceMissing; // triangles that the surface of cuts needs, if there is less room; else 0
} SinewStatus;
// The status of one of the last SinewSettings::framesInFlight steps. Does not wait: SINEW_NOT_READY.
SINEW_C_API SinewResult sinewGetStatus(SinewSimulation simulation, uint64_t frame, SinewStatus* status);

typedef struct SinewImpulse {
    SinewVec3 linear, angular;
} SinewImpulse; // of one step [N s], [N m s]
typedef struct SinewBodyImpulses {
    SinewImpulse contacts, planes, colliders, holds, grabs;
} SinewBodyImpulses;
enum {
    SINEW_IMPULSES_PLANES = 0,
    SINEW_IMPULSES_COLLIDERS = 1,
    SINEW_IMPULSES_HOST_COLLIDERS = 2,
    SINEW_IMPULSES_GRABS = 3,
    SINEW_IMPULSES_ATTACHMENTS = 4,
    SINEW_IMPULSES_HOLDS = 5,
    SINEW_IMPULSES_BLADE = 6 // one, by `toughness` of bodies, without a moment; none if no body has any
};
// Impulses on bodies, or by things of a kind, in a step (SinewSettings::keepsForces): copies at most *count
// elements and sets *count to the number that there are. SINEW_NOT_READY as sinewGetStatus().
SINEW_C_API SinewResult sinewGetBodyImpulses(SinewSimulation simulation, uint64_t frame, uint32_t* count,
                                             SinewBodyImpulses* impulses);
SINEW_C_API SinewResult sinewGetImpulses(SinewSimulation simulation, uint64_t frame, uint32_t kind, uint32_t* count,
                                         SinewImpulse* impulses);

// A sentence on an ignored mistake in recording, each kind once, valid until the next call; SINEW_END after the last.
SINEW_C_API SinewResult sinewNextComplaint(SinewSimulation simulation, const char** sentence);

// --- Saved states
typedef struct SinewState {
    uint64_t id;
} SinewState;
// Records the copy of the state into a buffer of the host, of SinewSimulationInfo::stateSize bytes, or back;
// `state` is the host's part of it, and must be destroyed. Errors: MISMATCH if size or stateKey differ.
SINEW_C_API SinewResult sinewRecordSaveState(SinewSimulation simulation, VkCommandBuffer commands,
                                             const SinewBufferView* to, SinewState* state);
SINEW_C_API SinewResult sinewRecordLoadState(SinewSimulation simulation, VkCommandBuffer commands,
                                             const SinewBufferView* from, SinewState state);
SINEW_C_API SinewResult sinewDestroyState(SinewState state);

// --- Programs without an engine
// These submit to the queue of a device of sinewCreateDevice() and wait; for other devices they return
// SINEW_ERROR_UNSUPPORTED. A simulation is stepped either by them or by recording.

// Takes `count` steps with the same input, and waits for the last one. Resets before the first one. Repeats
// steps that lacked room, with more room, or lists. Errors: DIVERGED with the step; the state before it stays.
SINEW_C_API SinewResult sinewStep(SinewSimulation simulation, const SinewStep* step, uint32_t count);
SINEW_C_API SinewResult sinewReset(SinewSimulation simulation);
// Writes the skins of the newest state.
SINEW_C_API SinewResult sinewUpdateSkin(SinewSimulation simulation);
// The state with all its bytes, in host memory, and back. Errors: MISMATCH.
SINEW_C_API SinewResult sinewSaveState(SinewSimulation simulation, SinewState* state);
SINEW_C_API SinewResult sinewLoadState(SinewSimulation simulation, SinewState state);
// Copy `size` bytes, a multiple of 4, from or to the start of a view of a buffer on the device that can be
// copied. What is written to views of a simulation does not change its state.
SINEW_C_API SinewResult sinewDownload(SinewDevice device, const SinewBufferView* view, size_t size, void* bytes);
SINEW_C_API SinewResult sinewUpload(SinewDevice device, const SinewBufferView* view, size_t size, const void* bytes);
// Host address of an output, to read between calls: valid until the simulation is destroyed. When sinewStep()
// has needed more room it shows the state before; sinewMap() then gives another address. Errors: UNSUPPORTED
// if the memory is not host visible, as on most GPUs.
SINEW_C_API SinewResult sinewMap(SinewSimulation simulation, uint32_t output, const void** bytes, size_t* size);

#undef SINEW_DEFAULTS
#ifdef __cplusplus
}
#endif
#endif
