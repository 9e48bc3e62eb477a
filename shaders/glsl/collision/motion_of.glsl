// How far a particle may move in this substep, or along its heading, and its leeway [m]. Exact, because several kernels
// decide by it.
float motionOf(vec3 v, vec4 heading, float horizon) {
    return max(step.h * length3(v), horizon * length3(heading.xyz)) + heading.w;
}
