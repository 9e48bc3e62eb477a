// Motions: velocities, impulses and poses that a host gives to bodies or regions, once at the start of a step. The rules
// of sinew.h on results, sizes and units hold here too.
//
// SinewStep::motions lists them, as many as SinewSettings::motions at most; further ones are left out, with a complaint.
// sinewStep() applies them in the first of its steps. A motion that is wrong makes the call fail with INVALID_ARGUMENT
// and a sentence, and no step is taken. A step that is undone takes its motions back. They are read during the call.
#ifndef SINEW_SINEW_MOTIONS_H
#define SINEW_SINEW_MOTIONS_H

#include "sinew/sinew.h"

#ifdef __cplusplus
extern "C" {
#endif

// Each is a rigid motion of all particles that may move, which wake. Poses act first, then the others in their order.
// Momentum is exact to rounding.
enum {
    SINEW_MOTION_ADD_VELOCITY = 0, // adds `linear`, and `angular` about the centre of mass
    SINEW_MOTION_SET_VELOCITY = 1, // replaces all velocities by these
    SINEW_MOTION_IMPULSE = 2,      // adds what an impulse and its moment give
    SINEW_MOTION_POSE = 3,         // turns a body about its centre of mass and displaces it, without a path; no body
                                   // with a fixed or driven particle
    SINEW_MOTION_SPAWN = 4,        // puts a body of sinewSetAbsent() into the world as the scene has it, turned about its
                                   // centre of mass, then displaced; at rest, whole, without memory; also one that is there
    SINEW_MOTION_DESPAWN = 5       // takes it out of the world
};
typedef struct SinewMotion {
    uint32_t kind;
    uint32_t body;            // index, with all its pieces, or SINEW_ALL_BODIES; of kinds from POSE on an index
    SinewVec3 center;         // of the region [m]
    float radius;             // of the region [m], at least 1e-6; 0 = everywhere, as for a pose
    SinewVec3 linear;         // of the centre of mass: velocity [m/s]; impulse [N s]; of a pose or spawn: displacement [m]
    SinewVec3 angular;        // angular velocity [rad/s]; impulse: moment about the centre of mass [N m s]
    SinewQuaternion rotation; // of a pose or spawn; of unit length
} SinewMotion;
SINEW_C_API SinewMotion sinewDefaultMotion(void); // adds no velocity to all bodies

// Lets a body start outside of the world (isAbsent = 1), or in it (0, as at first). Room is reserved for it; motions spawn
// and despawn it. While it is absent it takes memory, and little time. An absent body stands in one point,
// SINEW_ABSENT_PLACE on all axes [m], and touches nothing. Simulations need SinewSettings::motions and the solver split, and refuse bodies that
// are fixed, driven, attached, or linked to others. One that was cut is whole when it is spawned or despawned.
#define SINEW_ABSENT_PLACE 1e6f
SINEW_C_API SinewResult sinewSetAbsent(SinewScene scene, uint32_t body, uint32_t isAbsent);

#ifdef __cplusplus
}
#endif

#endif
