// The faces that a particle is a corner of, and what touches them.
layout(std430, binding = 0) readonly buffer Lists { uvec2 lists[]; };        // faces near each point: the first element, how many
layout(std430, binding = 1) readonly buffer Directions { vec4 directions[]; }; // n, depth [m]
layout(std430, binding = 2) readonly buffer Weights { vec4 weights[]; };       // b, side
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };     // first of each particle; then 4 x face + corner
layout(std430, binding = 4) readonly buffer Links { uint links[]; };         // of each moving face: elements of contacts
layout(std430, binding = 5) readonly buffer LinkLists { uvec2 linkLists[]; }; // of each moving face, in links
layout(std430, binding = 6) readonly buffer CornerEnds { uint cornerEnds[]; }; // of each particle, in corners: behind the faces that there may be
layout(push_constant) uniform Push { FacePush push; };
