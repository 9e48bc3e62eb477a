// The points of the blade's strip, from POINTS_BINDING: start and end position of point 0, of point 1, ...
#include "common/fetched.glsl"
FETCHED_VEC4(POINTS_BINDING, Points, pointAt)
#define POINT(n) pointAt(n).xyz
