// Points by how far they move in the substep or along their heading. The few that move farthest are kept out of the grid,
// so that all others are searched for in a smaller range. Class k begins at unit * 1.5^k.
#include "collision/face_points.h"
#define MOTION_FEW 6u // each costs about as much as a point near every face

// MOTION_CLASSES = in no class.
uint motionClass(float motion, float unit) {
    uint k = 0u;
    for (float least = unit; k < MOTION_CLASSES && motion >= least; least *= 1.5) ++k;
    return k > 0u ? k - 1u : MOTION_CLASSES;
}

// Motion above which points are kept out of the grid [m]. Exact, because several kernels decide by it. Requires the name
// apart.
float mostMotion() {
    uint items = 0u, k = MOTION_CLASSES;
    for (; k > 0u; --k) {
        items += apart[FACE_POINTS_CLASS + k - 1u];
        if (items > MOTION_FEW) break;
    }
    if (k == MOTION_CLASSES) return 1e30;
    float least = uintBitsToFloat(apart[FACE_POINTS_UNIT]);
    for (uint c = 0u; c < k; ++c) least *= 1.5;
    return least;
}
