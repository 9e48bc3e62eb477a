// The shape of a region of a sheet, and the least distance of its points that follows from it. Requires the names
// POSITION, VELOCITY and step of a kernel.
//
// Seen along an axis, the region is a map of the flat sheet into a plane. If the symmetric part of its derivative M is at
// least m in every triangle, then so is its mean along any straight line of the flat sheet: two points that are d apart at
// rest are at least m d apart, because u . (x(p) - x(q)) >= m d for u, the direction from q to p at rest. Waves are
// allowed; folds are not. M is linear in time where nodes go straight, and its least eigenvalue concave: what holds at both
// ends of a way holds on it.

// The plane in which a region is seen: axes near the directions of its rows and columns, over the spacing [1/m].
struct View {
    vec3 right, down;
};

vec3 unit(vec3 a) { return a / max(length(a), 1e-30); }

uint regionNode(SheetPatch own, uint x, uint y) { return own.first + x + own.stride * y; }

vec3 regionEdge(SheetPatch own, uvec2 from, uvec2 to) {
    return POSITION(regionNode(own, to.x, to.y)).xyz - POSITION(regionNode(own, from.x, from.y)).xyz;
}

View viewOf(SheetPatch own) {
    const uint last = PATCH_REGION - 1u, middle = last / 2u;
    vec3 right = vec3(0.0), down = vec3(0.0);
    [[unroll]] for (uint k = 0u; k <= last; k += middle) {
        right += regionEdge(own, uvec2(0u, k), uvec2(last, k));
        down += regionEdge(own, uvec2(k, 0u), uvec2(k, last));
    }
    right = unit(right);
    down = unit(down);
    const vec3 between = unit(right + down), across = unit(right - down);
    const float scale = sqrt(0.5) / own.spacing;
    return View(scale * (between + across), scale * (between - across));
}

// Whether M - least is positive in a triangle with the edges `right` and `down`, at both ends of the way.
bool isWide(vec4 right, vec4 down, float least) {
    const vec2 a = right.xz - least, b = down.yw - least, c = 0.5 * (right.yw + down.xz);
    return min(a.x, a.y) > 0.0 && min(b.x, b.y) > 0.0 && a.x * b.x >= c.x * c.x && a.y * b.y >= c.y * c.y;
}

// With all rows of squares: true if no two points of the region that are at least SheetPatch::nearest apart at rest come
// nearer than `reach` in the substep, nor in `ahead` more if all keep their velocities. Some rows may be looked at apart:
// all must be wide in the same view. False if something is NaN.
bool keepsApart(SheetPatch own, float reach, float ahead, uint firstRow, uint rows) {
    const View view = viewOf(own);
    const float least = reach / own.nearest;
    const vec3 origin = POSITION(own.first).xyz; // keeps sums small
    vec4 above[PATCH_REGION]; // nodes of the row before; xy: at the start, zw: at the end
    bool isWhole = true;
    for (uint y = firstRow; y <= firstRow + rows; ++y) {
        vec4 left = vec4(0.0), leftDown = vec4(0.0), aboveLeft = vec4(0.0);
        [[unroll]] for (uint x = 0u; x < PATCH_REGION; ++x) {
            const uint i = regionNode(own, x, y);
            const vec3 v = step.h * VELOCITY(i).xyz, end = POSITION(i).xyz - origin + ahead * v, start = end - (1.0 + ahead) * v;
            const vec4 node = vec4(dot(start, view.right), dot(start, view.down), dot(end, view.right), dot(end, view.down));
            const vec4 down = node - above[x], right = node - left, rightAbove = above[x] - aboveLeft;
            if (x > 0u && y > firstRow) // all four triangles of the square: its diagonal may be either
                isWhole = isWhole && isWide(right, down, least) && isWide(right, leftDown, least) && isWide(rightAbove, down, least) && isWide(rightAbove, leftDown, least);
            aboveLeft = above[x];
            above[x] = node;
            left = node;
            leftDown = down;
        }
    }
    return isWhole;
}
