// Whether a contact with a face or between edges keeps the distance that it has when the scene is loaded. In the name KEEPERS_BINDING.
layout(constant_id = 1) const bool keepsRest = false; // some do
layout(std430, binding = KEEPERS_BINDING) readonly buffer Keepers { uint keepers[]; }; // of each particle: 2 x linked body, + 1 = it does

bool keeps(uint i, uint j) { return keepsRest && ((keepers[i] | keepers[j]) & 1u) != 0u; }
bool areOfOneBody(uint i, uint j) { return keepers[i] / 2u == keepers[j] / 2u; }
