// Remainders of positions, which store what rounding loses. In float32 a displacement of less than half the distance
// between two numbers is lost, substep after substep. Scenes in which that shows (sim/model/rounding.hpp) keep a remainder:
// a buffer of positions then has two halves, x of all particles, and r of all particles [m]. The position is x + r.
// |r| is at most half the distance between two float32 numbers at x, so a kernel that reads x alone is correct to
// rounding.
#include "common/math.glsl"

layout(constant_id = 10) const bool hasRemainders = false;

// Index of the remainder of particle i in a buffer with this number of elements.
uint remainderOf(int elements, uint i) { return uint(elements) / 2u + i; }

// A sum in float32, and its rounding error.
struct Sum {
    vec3 rounded;
    vec3 remainder; // exact where |x| >= |way|, else within a rounding of `way`
};

Sum exactSum(vec3 x, vec3 way) {
    const vec3 rounded = x + way;
    const vec3 taken = rounded - x;
    const vec3 remainder = way - taken;
    return Sum(rounded, remainder);
}
