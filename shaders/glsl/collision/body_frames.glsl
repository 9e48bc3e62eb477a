// Expected positions of the particles of a body (BodyFrame in layout.h).

vec3 mapped(vec4 rows[3], vec3 r) {
    return vec3(dot3(rows[0].xyz, r), dot3(rows[1].xyz, r), dot3(rows[2].xyz, r)) + vec3(rows[0].w, rows[1].w, rows[2].w);
}

mat3 matrixOf(vec4 rows[3]) { return transpose(mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz)); }

vec3 placeOf(BodyFrame frame) { return vec3(frame.rates[0].w, frame.rates[1].w, frame.rates[2].w); }

void setMap(inout BodyFrame frame, mat3 a, vec3 to) {
    const mat3 t = transpose(a);
    const vec3 shift = to - a * frame.from.xyz;
    frame.map[0] = vec4(t[0], shift.x);
    frame.map[1] = vec4(t[1], shift.y);
    frame.map[2] = vec4(t[2], shift.z);
    frame.rates[0].w = to.x;
    frame.rates[1].w = to.y;
    frame.rates[2].w = to.z;
}

void setRates(inout BodyFrame frame, mat3 w) {
    const mat3 t = transpose(w);
    frame.rates[0].xyz = t[0];
    frame.rates[1].xyz = t[1];
    frame.rates[2].xyz = t[2];
}

// Squared Frobenius norm.
float squaredNorm(mat3 a) { return dot(a[0], a[0]) + dot(a[1], a[1]) + dot(a[2], a[2]); }

// Least factor by which a frame may shorten distances while lists stay valid.
#define LEAST_STRETCH 0.9

// Slack: the distance from their expected positions that two particles of bodies with a common frame may have before
// a pair that is missing in the lists can touch. The pair was farther apart than reach + margin; A makes d no shorter
// than s |d|, where s^2 >= 1 - |A^T A - 1|; on the straight path from one position to the next, a rotation by the
// angle a shortens it by a^2 / 8. Headings change d in the substep, by up to twice their pace: the path is then off the
// expected one by up to a quarter of the product of both changes.
float slackOf(mat3 a, mat3 turnOfSubstep, float reach, float margin, float pace) {
    const mat3 strain = transpose(a) * a - mat3(1.0);
    const float turn2 = squaredNorm(turnOfSubstep), s = sqrt(max(0.0, 1.0 - sqrt(squaredNorm(strain)))) - turn2 / 8.0;
    if (s < LEAST_STRETCH) return -1e18;
    return 0.49 * (s * margin - (1.0 - s) * reach - sqrt(turn2) * pace);
}

// Advances the frame to the next substep, of length h. The rounding of positions far from the origin is subtracted
// from the slack.
void advance(inout BodyFrame frame, float h, float reach, float margin, float pace) {
    const mat3 w = h * matrixOf(frame.rates);
    const vec3 to = placeOf(frame), u = frame.speed.xyz + h * frame.gravity.xyz, far = abs(to);
    const mat3 before = matrixOf(frame.map), change = w * before, a = before + change;
    frame.before = frame.map;
    setMap(frame, a, to + h * u);
    const float slack = min(slackOf(before, w, reach, margin, pace), slackOf(a, w, reach, margin, pace));
    frame.gravity.w = sqrt(squaredNorm(change));
    frame.speed = vec4(u, slack - 1e-6 * max(far.x, max(far.y, far.z)));
}

// Restarts the expectation after lists were made of particles at, or near, their expected positions.
void restart(inout BodyFrame frame, bool stands) {
    const vec3 to = placeOf(frame);
    frame.from.xyz = to;
    setMap(frame, mat3(1.0), to);
    if (!stands) return;
    setRates(frame, mat3(0.0));
    frame.speed.xyz = vec3(0.0);
    frame.gravity = vec4(0.0);
}
