// Buffers of gather_contacts for pairs with contact memory, selected by its macros; PLANE_BINDING is the first
// binding after them.
#if defined HAS_MEMORY || defined HAS_REBOUND
#ifdef TEXELS
layout(binding = 11) uniform samplerBuffer before;
#define BEFORE(i) texelFetch(before, int(i)).xyz
#else
layout(std430, binding = 11) readonly buffer Before { vec4 before[]; }; // velocities before the substep
#define BEFORE(i) before[i].xyz
#endif
#endif
#ifdef HAS_MEMORY
layout(std430, binding = 12) buffer Slips { vec4 slips[]; }; // slip; w = remaining overlap, below 0 = keeps its rest distance [m]
layout(constant_id = 3) const bool hasFriction = true;
layout(constant_id = 4) const bool hasRecovery = false;
layout(constant_id = 5) const bool keepsRest = false;
#ifdef HAS_SURFACES
layout(std430, binding = 13) readonly buffer Surfaces { uint surfaces[]; }; // by particle
layout(std430, binding = 14) readonly buffer Pairs { SurfacePair pairs[]; };
#define PAIR(i, j) pairs[surfaces[i] * push.surfaces + surfaces[j]]
#define PLANE_BINDING 15
#else
#define PAIR(i, j) push
#define PLANE_BINDING 13
#endif
#elif defined HAS_REBOUND
#define PLANE_BINDING 12
#else
#define PLANE_BINDING 11
#endif
