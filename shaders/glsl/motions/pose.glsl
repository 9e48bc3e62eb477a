// Rigid motion of a placed body. Requires the names requests and frames of a kernel.

vec3 rotated(vec4 q, vec3 v) {
    const vec3 t = 2.0 * cross3(q.xyz, v);
    return v + q.w * t + cross3(q.xyz, t);
}

// The place of x after motion k, and what rounding loses of it.
Sum placedAt(uint k, vec3 x) {
    const MotionFrame frame = frames[k];
    const vec3 way = rotated(requests[k].rotation, x - frame.origin.xyz - frame.center.xyz);
    return exactSum(frame.origin.xyz, frame.linear.xyz + (frame.center.xyz + way));
}
