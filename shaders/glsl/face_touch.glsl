// How a point touches a face in a substep, and on which side. In the names and buffers of touch_faces.
struct Touch {
    vec3 n;
    float depth;    // > 0 where they touch [m]
    vec3 b;
    float remembered; // the side, 1 = where the normal points, and the overlap
    bool isThrough; // the point is beyond the face's plane, and came through the face
    ContactFace face;
};

// Whether a point that has passed a plane went through the face in it: on straight ways, where it was in the plane. A face
// that turns was not quite there; what it never was within reach of may be in no list.
bool hasPassed(vec3 ap, vec3 ab, vec3 ac, float reach, out vec3 b) {
    b = weightsOf(ap, triangleOf(ab, ac));
    const bool isInside = min(b.x, min(b.y, b.z)) >= -1e-3; // of two faces at an edge at least one sees it
    b = max(b, vec3(0.0));
    b /= b.x + b.y + b.z;
    const vec3 d = ap - b.y * ab - b.z * ac;
    return isInside && dot(d, d) < reach * reach;
}

// `through`: the side that a neighbouring face is being passed from, as a unit vector; 0 = none.
Touch touchOf(uint i, uint element, vec3 through) {
    const uvec2 candidate = contacts[element];
    const ContactFace face = faces[candidate.x];
    const float reach = uintBitsToFloat(candidate.y), h = step.h;
    const vec3 a = predicted[face.a].xyz, va = velocities[face.a].xyz;
    const vec3 ap = predicted[i].xyz - a, ab = predicted[face.b].xyz - a, ac = predicted[face.c].xyz - a;
    const vec3 vp = velocities[i].xyz - va, vb = velocities[face.b].xyz - va, vc = velocities[face.c].xyz - va;
    const Triangle triangle = triangleOf(ab, ac), before = triangleOf(ab - h * vb, ac - h * vc);
    Touch touch = Touch(vec3(0.0), 0.0, vec3(0.0), 0.0, false, face);
    if (isSliver(triangle)) return touch;
    const Nearest nearest = nearestOf(ap, triangle);
    const vec3 normal = normalize(triangle.normal);
    const float height = dot(normal, ap);
    const float heightBefore = dot(before.normal, ap - h * vp) / max(length(before.normal), 1e-30);
    const bool isForced = dot(through, through) > 0.0;
    float side = isForced ? (dot(normal, through) < 0.0 ? -1.0 : 1.0) : sideOf(memory[element].w);
    const bool hasTouched = side != 0.0;
    if (!hasTouched) side = heightBefore < 0.0 ? -1.0 : 1.0;
    vec3 b = nearest.weights;
    if (side * height < 0.0) {
        if (isForced || hasTouched && side * heightBefore < 0.0) {
            touch.isThrough = dot(nearest.d, nearest.d) < reach * reach; // what is farther may be in no list: let go
        } else {
            vec3 passed;
            const float back = h * height / (height - heightBefore); // since it was in the plane [s]
            touch.isThrough = hasPassed(ap - back * vp, ab - back * vb, ac - back * vc, reach, passed);
            if (touch.isThrough && !nearest.isInside) b = passed;
        }
        if (!touch.isThrough) side = -side; // it went around, or is far beyond
    }
    const float distance = length(nearest.d);
    const bool isAbove = touch.isThrough || nearest.isInside || distance < 1e-15;
    touch.n = isAbove ? side * normal : nearest.d / distance;
    touch.b = b;
    const float overlap = reach - (isAbove ? side * height : distance), approach = -h * dot(touch.n, vp - b.y * vb - b.z * vc);
    const float left = overlapLeft(memory[element].w, overlap, approach, push.recoverySpeed * h);
    touch.depth = max(0.0, overlap - left);
    if (candidate.x >= push.moving) touch.depth = withCorners(touch.depth, b, triangle, reach);
    touch.remembered = rememberedOf(side, touch.depth, left);
    return touch;
}
