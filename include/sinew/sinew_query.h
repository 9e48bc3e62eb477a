// Queries: rays that meet bodies, and the particles inside a region. The rules of sinew.h on results,
// handles, sizes, threads and units hold here too.
//
// A query is made for a scene, and asks the simulations of that scene. Kernels find the answers; a few bytes
// come back with the commands that were recorded, and nothing waits. Rays meet skins, balls with the contact
// radius of particles of bodies without a skin, and surfaces of cuts; nothing meets removed fragments.
#ifndef SINEW_SINEW_QUERY_H
#define SINEW_SINEW_QUERY_H

#include "sinew/sinew_world.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct SinewQuery {
    uint64_t id;
} SinewQuery;

typedef struct SinewQueryRoom {
    uint32_t size;
    uint32_t rays;      // of one recording; at least 1
    uint32_t particles; // that one region returns at most
    uint32_t slots;     // recordings in flight at a time; at least 1
} SinewQueryRoom;

// Makes a query for simulations of `scene`, which may be changed or destroyed afterwards. Errors: as
// sinewCreateSimulation().
SINEW_C_API SinewResult sinewCreateQuery(SinewDevice device, SinewScene scene, const SinewQueryRoom* room,
                                         SinewQuery* query);
// The same for the present simulation of a world: after a take-over, make another one.
SINEW_C_API SinewResult sinewCreateWorldQuery(SinewWorld world, const SinewQueryRoom* room,
                                              SinewQuery* query);
// All commands recorded with it must have finished, or never be submitted.
SINEW_C_API SinewResult sinewDestroyQuery(SinewQuery query);
// Names the simulation that is asked from now on; commands recorded with the query must have finished. A
// query of a world names its simulation already. Errors: MISMATCH if it has another number of particles.
SINEW_C_API SinewResult sinewSetQuerySimulation(SinewQuery query, SinewSimulation simulation);

typedef struct SinewRay {
    SinewVec3 origin;    // [m]
    SinewVec3 direction; // unit length
    float length;        // nothing beyond is met [m]; 0 = without end
    uint32_t skipsFixed; // 1: no particle that never moves is returned
} SinewRay;

typedef struct SinewRayHit {
    uint32_t size;
    uint32_t isMet;    // 0: the ray met nothing, or only fixed particles that were not asked for
    uint32_t particle; // the nearest to the point of those that hold what is met there
    uint32_t body;     // 0xffffffff: the particle belongs to none
    SinewVec3 point;   // where the ray meets the body [m]
    SinewVec3 place;   // of the particle [m]
    float distance;    // from the origin to the point [m]
} SinewRayHit;

// A box along the axes, grown by a radius: a sphere if the half extents are 0.
typedef struct SinewRegion {
    SinewVec3 center;      // [m]
    SinewVec3 halfExtents; // [m]
    float radius;          // [m]
    uint32_t skipsFixed;   // 1: particles that never move do not count
} SinewRegion;

// --- Recording into command buffers of a host
// `slot` is below SinewQueryRoom::slots, and its previous commands must have finished. Balls and particles
// are those of the newest recorded step, skins those of the newest sinewRecordSkin(). Errors: INVALID_HANDLE
// if the simulation was destroyed or replaced.

// At most SinewQueryRoom::rays rays.
SINEW_C_API SinewResult sinewRecordRays(SinewQuery query, VkCommandBuffer commands, uint32_t slot,
                                        const SinewRay* rays, uint32_t count);
// Valid once the commands have finished, also once a step that was recorded behind them has.
SINEW_C_API SinewResult sinewGetRayHit(SinewQuery query, uint32_t slot, uint32_t ray, SinewRayHit* hit);
SINEW_C_API SinewResult sinewRecordRegion(SinewQuery query, VkCommandBuffer commands, uint32_t slot,
                                          const SinewRegion* region);
// As sinewGetRayHit(). *count: room in `particles` before, the number of particles in the region after; their
// indices are ascending, as many as fit in both rooms.
SINEW_C_API SinewResult sinewGetRegion(SinewQuery query, uint32_t slot, uint32_t* count, uint32_t* particles);

// --- Programs without an engine
// These submit to the queue of a device of sinewCreateDevice(), wait, and use slot 0. Skins are those of the
// present state.
SINEW_C_API SinewResult sinewCastRay(SinewQuery query, const SinewRay* ray, SinewRayHit* hit);
SINEW_C_API SinewResult sinewFindParticles(SinewQuery query, const SinewRegion* region, uint32_t* count,
                                           uint32_t* particles);

// The same of one of the last SinewSettings::outputFrames steps, in buffers that other steps do not write, for the
// outputs 0 to 3 and 6 to 10; those of skins after a sinewRecordSkin(). SINEW_NOT_READY if it is not kept.
SINEW_C_API SinewResult sinewGetFrameView(SinewSimulation simulation, uint64_t frame, uint32_t output,
                                          SinewBufferView* view);

#ifdef __cplusplus
}
#endif

#endif
