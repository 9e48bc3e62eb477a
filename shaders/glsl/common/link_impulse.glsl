// The times of a substep of `split`, and the impulse of a link (split.glsl). The kernel declares `step`.
#extension GL_EXT_spirv_intrinsics : require

// Values that are equal for all particles of a substep.
struct Substep {
    float hh;      // H^2 [s^2]
    float kick;    // k [s]
    float impulse; // k / H^2 [1/s]
    float thetaH;  // theta H of the stored positions [s]
};

Substep substepOf(bool isFirst) {
    const float h = step.h, longest = step.longestH;
    const float kick = isFirst ? 0.5 * (step.hPrevious + h) : h;
    return Substep(longest * longest, kick, kick / (longest * longest), isFirst ? step.thetaHPrevious : step.thetaH);
}

// dl n of a link from a to b [kg m]; its stiffness [kg] is clamped by the caller. Coincident ends give exactly 0.
vec3 linkImpulse(vec3 a, vec3 b, float restLength, float stiffness) {
    const vec3 d = b - a;
    return stiffness * (1.0 - restLength * inversesqrt(dot3(d, d) + 1e-30)) * d;
}
