// Marks absent bodies among the events of a step.
#include "common/absent.glsl"

// BodyEvents::awake of an absent body, which neither sleeps nor rests on anything.
#define EVENT_ABSENT 2u
