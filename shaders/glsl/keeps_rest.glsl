// Whether a contact with a face or between edges keeps the distance that it has when the scene is loaded. In the names KEEPERS_BINDING and step.
layout(constant_id = 1) const bool keepsRest = false; // some do
layout(constant_id = 2) const bool isFirst = false;   // of the substeps of a step; only if keepsRest
layout(std430, binding = KEEPERS_BINDING) readonly buffer Keepers { uint keepers[]; }; // of each particle: 2 x linked body, + 1 = it does

bool keeps(uint i, uint j) { return keepsRest && ((keepers[i] | keepers[j]) & 1u) != 0u; }
uint bodyOf(uint i) { return keepers[i] / 2u; }

// The first substep after the scene is loaded: only what touches when it begins has done so since.
bool isAtLoad() { return isFirst && step.hPrevious == 0.0; }
