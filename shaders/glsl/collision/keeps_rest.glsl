// True if a contact with a face or between edges keeps the distance that it had when the scene was loaded. Requires
// MARKS_BINDING and the name step.
layout(constant_id = 1) const bool keepsRest = false; // some contacts of the scene keep theirs
layout(constant_id = 2) const bool isFirst = false;   // the first substep of a step; only if keepsRest
#include "collision/linked_marks.glsl"

bool keeps(uint i, uint j) { return keepsRest && ((marks[i] | marks[j]) & 1u) != 0u; }

// True in the first substep after the scene was loaded: contacts at its start have existed since then.
bool isAtLoad() { return isFirst && step.hPrevious == 0.0; }
