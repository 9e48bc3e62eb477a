// The points of the blade's strip, from POINTS_BINDING: start and end position of point 0, of point 1, ...
#ifdef TEXELS
layout(binding = POINTS_BINDING) uniform samplerBuffer points;
#define POINT(n) texelFetch(points, int(n)).xyz
#else
layout(std430, binding = POINTS_BINDING) readonly buffer Points { vec4 points[]; };
#define POINT(n) points[n].xyz
#endif
