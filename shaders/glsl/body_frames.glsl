// Where particles of a body are expected (BodyFrame in layout.h).

vec3 turned(vec4 rows[3], vec3 d) { return vec3(dot3(rows[0].xyz, d), dot3(rows[1].xyz, d), dot3(rows[2].xyz, d)); }

vec3 placeIn(vec4 rows[3]) { return vec3(rows[0].w, rows[1].w, rows[2].w); }

// Of a particle that was at r when lists were made.
vec3 expectedAt(vec4 rows[3], vec4 from, vec3 r) { return turned(rows, r - from.xyz) + placeIn(rows); }

mat3 matrixOf(vec4 rows[3]) { return transpose(mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz)); }

void setRows(out vec4 rows[3], mat3 a, vec3 place) {
    const mat3 t = transpose(a);
    rows[0] = vec4(t[0], place.x);
    rows[1] = vec4(t[1], place.y);
    rows[2] = vec4(t[2], place.z);
}

// The sum of the squares of all entries.
float squaredNorm(mat3 a) { return dot(a[0], a[0]) + dot(a[1], a[1]) + dot(a[2], a[2]); }

// How far from where they are expected two particles of bodies that share a frame may be, so that no pair that is missing in
// lists touches. It was farther apart than reach + margin; A makes d no shorter than s |d|, where s^2 >= 1 - |A^T A - 1|; on
// the way from one place to the next, which is straight, a rotation by the angle a makes it shorter by a^2 / 8.
float slackOf(mat3 a, mat3 turnOfSubstep, float reach, float margin) {
    const mat3 strain = transpose(a) * a - mat3(1.0);
    const float s = sqrt(max(0.0, 1.0 - sqrt(squaredNorm(strain)))) - squaredNorm(turnOfSubstep) / 8.0;
    return 0.49 * (s * margin - (1.0 - s) * reach);
}

// At most |W d| / |d|.
float normOf(mat3 w) {
    const mat3 t = transpose(w);
    return sqrt(squaredNorm(0.5 * (w + t))) + sqrt(0.5 * squaredNorm(0.5 * (w - t)));
}

// On to the next substep, of length h. A particle that is e away from where it is expected when the substep ends, with the
// velocity v, was at most e + h |v - u| + h |W| |x - to| away when it began: the last summand is taken off here.
void advance(inout BodyFrame frame, float h, float reach, float margin) {
    const mat3 w = h * matrixOf(frame.rates);
    const vec3 to = placeIn(frame.now), u = placeIn(frame.rates) + h * frame.gravity.xyz;
    const mat3 before = matrixOf(frame.now), a = before + w * before;
    setRows(frame.now, a, to + h * u);
    setRows(frame.rates, matrixOf(frame.rates), u);
    frame.from.w = min(slackOf(before, w, reach, margin), slackOf(a, w, reach, margin)) - normOf(w) * frame.gravity.w;
}

// Lists have been made of particles where they are expected, or near there: from now on expectations start from it.
void restart(inout BodyFrame frame, bool stands) {
    frame.from.xyz = placeIn(frame.now);
    setRows(frame.now, mat3(1.0), frame.from.xyz);
    if (!stands) return;
    setRows(frame.rates, mat3(0.0), vec3(0.0));
    frame.gravity = vec4(0.0);
}
