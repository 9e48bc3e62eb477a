// A bend of three particles in a row, once for every solver form: XPBD [Macklin 2016], eq. 18, for the vector constraint
// C = x_a - 2 x_b + x_c, whose gradients 1, -2, 1 make the denominator w_a + 4 w_b + w_c + alpha, alpha = compliance / h^2.
#include "constraints/compliance.glsl"

// Takes positions or displacements. From differences, which float keeps: the value for displacements is the change of
// the value.
vec3 bendValue(vec3 a, vec3 b, vec3 c) { return (a - b) + (c - b); }

// The change of the multiplier lambda: end a moves by w_a times it, the middle by -2 w_b times, end c by w_c times.
vec3 solveBend(vec3 value, vec3 w, float alpha, vec3 lambda) {
    return -(value + alpha * lambda) / (w.x + 4.0 * w.y + w.z + alpha);
}
