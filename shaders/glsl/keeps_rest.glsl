// Whether a contact with a face or between edges keeps the distance that it has when the scene is loaded. In the names MARKS_BINDING and step.
layout(constant_id = 1) const bool keepsRest = false; // some do
layout(constant_id = 2) const bool isFirst = false;   // of the substeps of a step; only if keepsRest
#include "linked_marks.glsl"

bool keeps(uint i, uint j) { return keepsRest && ((marks[i] | marks[j]) & 1u) != 0u; }

// The first substep after the scene is loaded: only what touches when it begins has done so since.
bool isAtLoad() { return isFirst && step.hPrevious == 0.0; }
