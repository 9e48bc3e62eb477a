// Data of the kernels of events (sim/events/events.hpp). Defined once for C++ (sinew::sim::layout) and GLSL.
#ifndef SINEW_EVENTS_H
#define SINEW_EVENTS_H

#ifdef __cplusplus
#include "common/layout.h"

namespace sinew::sim::layout {
#endif

// The body of a slot whose particle belongs to none, or that holds no particle.
#define NO_BODY 0xffffffffu

// Kinds of events that the device lists: as sim::EventKind, but for the last (events::kindOf).
#define EVENT_CONTACT_BEGINS 0
#define EVENT_CONTACT_ENDS 1
#define EVENT_CUT 2
#define EVENT_TEAR 3
#define EVENT_PIECES 4
#define EVENT_SLEEPS 5
#define EVENT_WAKES 6
#define EVENT_FRAGMENTS 7
#define EVENT_KINDS 8

// A contact ends in the step in which nothing has touched for so many steps: a contact at rest opens and closes.
#define EVENT_STEPS_APART 2u

// The events of a body in a step, as counts.
struct BodyEvents {
    uint awake, asleep; // 1 = some of its particles are, at the end of the step
    uint cut, torn;     // links
    uint fragments;     // that were removed
};

// An event. The first entry of a list is its head: the number of events as `kind`.
struct EventEntry {
    uint kind, body;
    uint partner; // among bodies, planes, host colliders and colliders, one after another
    uint count;
};

// Sets are bits of words: for a kind of contact a row of words for each body, with a bit for each partner; for any
// other kind a bit for each body.
struct EventPush {
    uint count;    // items
    uint bodies;
    uint partners;
    uint rowWords;
    uint poses;    // first pose of the colliders in this substep
    uint kinds;    // bits of the kinds that are listed
    uint room;     // entries of the list behind its head
};

// Cut bodies: slots as in CutPush.
struct EventCutPush {
    uint first, count;
    uint stiffLinks; // bits of the links that count
    uint run;
    uint bodies;
};

#ifdef __cplusplus
} // namespace sinew::sim::layout
#endif

#endif
