// Rest positions to which bound vertices have moved beside a cut (snap_rims_to_blade), from MOVED_BINDING: valid if w =
// VERTEX_MOVED.
#ifdef TEXELS
layout(binding = MOVED_BINDING) uniform samplerBuffer moved;
#define MOVED(v) texelFetch(moved, int(v))
#else
layout(std430, binding = MOVED_BINDING) readonly buffer Moved { vec4 moved[]; };
#define MOVED(v) moved[v]
#endif
