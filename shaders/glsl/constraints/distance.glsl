// A distance constraint between two particles, used by every solver form: XPBD [Macklin 2016], eq. 18, with
// C = |x_b - x_a| - L and alpha = compliance / h^2:
//
//   dl = -(C + alpha l) / (w_a + w_b + alpha).
#include "constraints/compliance.glsl"

struct DistanceChange {
    vec3 n;       // unit direction from a to b; 0 where the ends coincide: no direction, no correction
    float lambda; // dl; end a moves by -w_a dl n, end b by w_b dl n
};

// d = x_b - x_a; w = w_a + w_b, the inverse masses of the ends [1/kg]; w + alpha is above 0.
DistanceChange solveDistance(vec3 d, float w, float restLength, float alpha, float lambda) {
    const float distance = length(d);
    const vec3 n = distance > 1e-12 ? d / distance : vec3(0.0);
    return DistanceChange(n, -(distance - restLength + alpha * lambda) / (w + alpha));
}

// With damping, eq. 26: gamma = damping coefficient x h / compliance acts on `moved`, the relative displacement of
// the ends so far.
DistanceChange solveDampedDistance(vec3 d, float w, float restLength, float alpha, float lambda, float gamma, vec3 moved) {
    const float distance = length(d);
    const vec3 n = distance > 1e-12 ? d / distance : vec3(0.0);
    const float value = distance - restLength + alpha * lambda + gamma * dot(n, moved);
    return DistanceChange(n, -value / (w * (1.0 + gamma) + alpha));
}
