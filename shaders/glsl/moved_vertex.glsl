// Where such a vertex has moved to beside a cut (move_rims), from MOVED_BINDING: w = VERTEX_MOVED, or it has not.
#ifdef TEXELS
layout(binding = MOVED_BINDING) uniform samplerBuffer moved;
#define MOVED(v) texelFetch(moved, int(v))
#else
layout(std430, binding = MOVED_BINDING) readonly buffer Moved { vec4 moved[]; };
#define MOVED(v) moved[v]
#endif
