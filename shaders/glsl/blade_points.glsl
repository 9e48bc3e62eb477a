// The points of the strip of a blade, from POINTS_BINDING: from 0, to 0, from 1, to 1, ...
#ifdef TEXELS
layout(binding = POINTS_BINDING) uniform samplerBuffer points;
#define POINT(n) texelFetch(points, int(n)).xyz
#else
layout(std430, binding = POINTS_BINDING) readonly buffer Points { vec4 points[]; };
#define POINT(n) points[n].xyz
#endif
