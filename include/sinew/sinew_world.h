// Worlds: simulations to which bodies, colliders and other parts of a scene are added, and from which they
// are removed, while they run. The rules of sinew.h on results, handles, sizes, threads and units hold here
// too.
//
// A world has one simulation at a time. After a change, a thread of the library makes another one of the new
// scene, while the present one goes on; between two steps that one takes over all that lives on. The handle
// of the simulation before is then stale: calls with it give SINEW_ERROR_INVALID_HANDLE.
//
// One thread at a time uses a world and its simulation. A second one gets SINEW_ERROR_IN_USE.
#ifndef SINEW_SINEW_WORLD_H
#define SINEW_SINEW_WORLD_H

#include "sinew/sinew.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct SinewWorld {
    uint64_t id;
} SinewWorld;

// Names a part of one world, and never another part, even after the part is gone. All zeros name none.
typedef struct SinewPart {
    uint64_t world; // SinewWorld::id
    uint32_t index, generation;
} SinewPart;

// Makes a world and the simulation of `base`, whose elements stay for good. `base` may be changed or
// destroyed afterwards. `settings` hold for all simulations; with 0 substeps or SINEW_AUTO_LEVELS the number
// is chosen for `base`, and grows with parts that need more. Errors: as sinewCreateSimulation().
SINEW_C_API SinewResult sinewCreateWorld(SinewDevice device, SinewScene base, const SinewSettings* settings,
                                         SinewWorld* world);
// Destroys the simulation too; waits for the library's thread. All commands recorded with its simulations,
// also with those that were replaced, must have finished, or never be submitted.
SINEW_C_API SinewResult sinewDestroyWorld(SinewWorld world);

typedef struct SinewWorldInfo {
    uint32_t size;
    uint32_t isChanging;        // changes have not arrived yet
    uint32_t isReady;           // sinewRecordChanges() takes over as soon as no step is in flight
    uint32_t substeps;          // of a step of the present simulation
    uint64_t takeOvers;         // since the world was made; each gave new indices, views and a new handle
    SinewSimulation simulation; // the present one, as by sinewGetWorldSimulation()
} SinewWorldInfo;
SINEW_C_API SinewResult sinewGetWorldInfo(SinewWorld world, SinewWorldInfo* info);
// The present simulation. It belongs to the world: sinewDestroySimulation() gives SINEW_ERROR_IN_USE, and
// sinewStep() SINEW_ERROR_UNSUPPORTED; all other functions work with it. Its handle, its views, and addresses
// by sinewMap(), hold until the next take-over.
SINEW_C_API SinewResult sinewGetWorldSimulation(SinewWorld world, SinewSimulation* simulation);

// Adds a copy of `scene` as a part, at its positions and velocities; it arrives with a later take-over. Each
// of its particles belongs to a body of its own. Place it where it overlaps nothing else. Gravity, length of
// a step, damping and default contact properties are those of the base. Errors: INVALID_SCENE with a sentence
// a line.
SINEW_C_API SinewResult sinewAddPart(SinewWorld world, SinewScene scene, SinewPart* part);
// Removes a part, also one that has not arrived yet; it leaves with a later take-over. Errors: INVALID_HANDLE
// for parts of other worlds, and for those that were removed.
SINEW_C_API SinewResult sinewRemovePart(SinewWorld world, SinewPart part);
// Whether the part was added and not removed since; it may not have arrived. 0 also for parts of other
// worlds.
SINEW_C_API SinewResult sinewContainsPart(SinewWorld world, SinewPart part, uint32_t* isContained);
// Elements of the part in the present simulation: `count` of each kind, from `first` on. SINEW_NOT_READY
// before it has arrived; a removed part is found until it has left. Errors: INVALID_HANDLE after that, and
// for parts of other worlds.
SINEW_C_API SinewResult sinewFindPart(SinewWorld world, SinewPart part, SinewSceneCounts* first,
                                      SinewSceneCounts* count);
// Elements in the present simulation.
SINEW_C_API SinewResult sinewGetWorldCounts(SinewWorld world, SinewSceneCounts* counts);

// --- Recording into command buffers of a host

// Called before each step, with the command buffer that the step will be recorded into. Begins to make a
// simulation if there are changes and none is being made. While one is made, may record copies into its
// buffers and sets *isTakenOver to 0; the commands must be submitted. If it is ready, records the take-over
// and sets *isTakenOver to 1: indices, views and the handle of the simulation are then new. Steps may be in
// flight, except those that may have to be repeated, those of another length than the last that was finished,
// those of a scene with colliders that move or with host colliders, and all after sinewObserveStatus() has
// asked for more room for contacts. No step may wait to be repeated. Does not wait. The host resets the first
// simulation by sinewRecordReset(); a take-over needs no reset. Errors: those of sinewCreateSimulation() if
// the making failed: parts that were to arrive are then removed, and the world goes on without them; parts
// that were to leave stay until the next change, sinewUpdateWorld(), or sinewReleaseReplaced() with memory.
SINEW_C_API SinewResult sinewRecordChanges(SinewWorld world, VkCommandBuffer commands, uint32_t* isTakenOver);
// The status of any step since the last sinewReleaseReplaced(), before a take-over or after. As
// sinewGetStatus().
SINEW_C_API SinewResult sinewGetWorldStatus(SinewWorld world, uint64_t frame, SinewStatus* status);
// Reads the status of a finished step: if it lacked room for contacts or for the surface of cuts, a
// simulation with more is made, and taken over as other changes are. *isEnough becomes 0 if there is no more
// room to be had.
SINEW_C_API SinewResult sinewObserveStatus(SinewWorld world, const SinewStatus* status, uint32_t* isEnough);
// Destroys, on a thread, the simulations that were replaced. All commands recorded with them must have
// finished: take-overs, and all that reads their buffers.
SINEW_C_API SinewResult sinewReleaseReplaced(SinewWorld world);

// --- Programs without an engine
// These submit to the queue of a device of sinewCreateDevice() and wait; for other devices they return
// SINEW_ERROR_UNSUPPORTED. They release what was replaced. A world is stepped either by them or by recording.

// Waits until all changes have arrived; tries those that failed again. Resets before the first step. Errors: as sinewRecordChanges().
SINEW_C_API SinewResult sinewUpdateWorld(SinewWorld world);
// sinewUpdateWorld(), then `count` steps as by sinewStep(): indices in `step` are those after the changes.
// A step that needs more room changes the handle of the simulation too. Errors: as both; DIVERGED with the
// step, and the state before it stays.
SINEW_C_API SinewResult sinewStepWorld(SinewWorld world, const SinewStep* step, uint32_t count);

#ifdef __cplusplus
}
#endif

#endif
