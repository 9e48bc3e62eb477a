// Part of the kernels that need the skin in the state before a step with a blade: positions of its particles in that
// state and at rest, from bindings 4 and 5.
#include "lattice/saved_links.glsl"
#ifdef TEXELS
layout(binding = 4) uniform samplerBuffer places;
layout(binding = 5) uniform samplerBuffer rest;
#define AT(i) texelFetch(places, int(i)).xyz
#define REST(i) texelFetch(rest, int(i)).xyz
#else
layout(std430, binding = 4) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 5) readonly buffer Rest { vec4 rest[]; };
#define AT(i) places[i].xyz
#define REST(i) rest[i].xyz
#endif
#define ALIVE(i) SAVED(i)
#define TURN(i) gradientAt(i)
#include "surface/gradient.glsl"
#include "surface/skin_place.glsl"
