// Events: what happened to bodies in a step. The rules of sinew.h on results, handles, sizes, threads and units
// hold here too.
//
// SinewSettings::events says which kinds a simulation lists. A list is ready when the status of its step is;
// nothing waits for it.
#ifndef SINEW_SINEW_EVENTS_H
#define SINEW_SINEW_EVENTS_H

#include "sinew/sinew_world.h"

#ifdef __cplusplus
extern "C" {
#endif

// Kinds; bit 1 << kind of SinewSettings::events asks for one. In a list they stand in this order. Later versions may
// have more.
enum {
    SINEW_EVENT_CONTACT_BEGINS = 0, // a body touches a partner that it did not touch before
    SINEW_EVENT_CONTACT_ENDS = 1,   // they have not touched for two steps
    SINEW_EVENT_CUT = 2,            // a blade or a ray has cut links of a body
    SINEW_EVENT_TEAR = 3,           // links of a body have torn
    SINEW_EVENT_PIECES = 4,         // the number of pieces of a body has changed by a cut or a tear
    SINEW_EVENT_SLEEPS = 5,         // the last awake particle of a body has fallen asleep
    SINEW_EVENT_WAKES = 6,          // particles of a body that slept have woken
    SINEW_EVENT_LACKS_ROOM = 7,     // the step is undone: it needs more SinewSettings::contactRoom
    SINEW_EVENT_FRAGMENTS = 8       // a cut or a tear has left fragments of a body that were removed
};
#define SINEW_ALL_EVENTS 0x1ffu

enum {
    SINEW_PARTNER_NONE = 0,
    SINEW_PARTNER_BODY = 1, // of a higher index than `body`
    SINEW_PARTNER_PLANE = 2,
    SINEW_PARTNER_HOST_COLLIDER = 3,
    SINEW_PARTNER_COLLIDER = 4
};

typedef struct SinewEvent {
    uint64_t frame; // of the step
    uint32_t kind;
    uint32_t body;    // 0xffffffff: LACKS_ROOM
    uint32_t partner; // kind of the partner of a contact
    uint32_t other;   // its index
    // CONTACT_BEGINS: touching pairs of particles, faces and edges, or particles at the partner, the mean of the
    // substeps rounded up. CUT, TEAR: links. PIECES: their number now. LACKS_ROOM: the room needed. FRAGMENTS:
    // those of this step. Else 0.
    uint32_t count;
    uint32_t reserved;
} SinewEvent;

// The events of a step: copies at most *count and sets *count to the number that there are; *lost, which may be
// null, becomes the number of those that SinewSettings::eventRoom had no room for. Indices are those of the scene
// that the step was recorded with. Does not wait: SINEW_NOT_READY as sinewGetStatus().
SINEW_C_API SinewResult sinewGetEvents(SinewSimulation simulation, uint64_t frame, uint32_t* count,
                                       SinewEvent* events, uint32_t* lost);
// The same for a step of a world, as sinewGetWorldStatus().
SINEW_C_API SinewResult sinewGetWorldEvents(SinewWorld world, uint64_t frame, uint32_t* count, SinewEvent* events,
                                            uint32_t* lost);

// --- Programs without an engine
// All events of the steps that the last sinewStep(), or sinewStepWorld(), of the simulation took, oldest first, as
// sinewGetEvents(). A repeated step is listed once, behind the LACKS_ROOM of its first try.
SINEW_C_API SinewResult sinewGetStepEvents(SinewSimulation simulation, uint32_t* count, SinewEvent* events,
                                           uint32_t* lost);

#ifdef __cplusplus
}
#endif

#endif
