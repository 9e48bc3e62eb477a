// Rest positions to which bound vertices have moved beside a cut (snap_rims_to_blade), from MOVED_BINDING: valid if w
// is at least VERTEX_MOVED.
#include "common/fetched.glsl"
FETCHED_VEC4(MOVED_BINDING, Moved, movedPlace)
#define MOVED(v) movedPlace(v)
