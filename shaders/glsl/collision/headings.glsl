// The heading of a particle: its velocity relative to the frame of its body when lists were made. Particles are expected
// to go on like that for GridBounds::horizon. A deformed body needs new lists much less often for it, because most
// particles keep their velocities for longer than they take to cross the margin.

// `frame` after it was advanced; v: velocity in the substep that ended at x. No longer than `most` [m/s].
vec3 headingOf(BodyFrame frame, vec3 x, vec3 v, float h, float most) {
    const vec3 together = frame.speed.xyz - h * frame.gravity.xyz + matrixOf(frame.rates) * (x - frame.from.xyz);
    const vec3 own = v - together;
    return min(1.0, most / max(length(own), 1e-30)) * own;
}

// Leeway of a particle [m]: the distance by which it will be off its heading at the horizon if that changes as fast as
// since the lists before, beyond the slack of all. Few particles need any, so that it costs few pairs.
float leewayOf(vec3 heading, vec3 before, GridBounds bounds, float margin, float most) {
    if (bounds.lasted <= 0.0) return 0.0;
    const float off = 0.5 * length(heading - before) * bounds.horizon * bounds.horizon / bounds.lasted;
    const float more = off - 0.49 * margin;
    return more > 0.0 ? min(more, most) : 0.0; // also if it is NaN
}
