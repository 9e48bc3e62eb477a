// The point of a triangle nearest to another point, without branches: inside by the signs of three areas, else on one
// of the edges. Coordinates are relative to corner a, so that large ones do not cancel.
struct Triangle {
    vec3 ab, ac; // [m]
    vec3 normal; // its length is twice the area [m^2]
};

Triangle triangleOf(vec3 ab, vec3 ac) { return Triangle(ab, ac, cross(ab, ac)); }

// True if a triangle is so thin (height below a thousandth of its length) that float32 gives no normal. Its
// neighbours cover the place.
bool isSliver(Triangle triangle) {
    const vec3 bc = triangle.ac - triangle.ab;
    const float longest = max(max(dot(triangle.ab, triangle.ab), dot(triangle.ac, triangle.ac)), dot(bc, bc));
    return !(dot(triangle.normal, triangle.normal) > 1e-6 * longest * longest);
}

// Weights of a, b, c of the foot of the perpendicular from a point, ap from a; they sum to 1.
vec3 weightsOf(vec3 ap, Triangle triangle) {
    const float scale = 1.0 / max(dot(triangle.normal, triangle.normal), 1e-37);
    const float b = scale * dot(cross(ap, triangle.ac), triangle.normal);
    const float c = scale * dot(cross(triangle.ab, ap), triangle.normal);
    return vec3(1.0 - b - c, b, c);
}

struct Nearest {
    vec3 weights;  // weights of the corners, none below 0
    vec3 d;        // from there to the point [m]
    bool isInside; // the point projects onto the inside of the triangle
};

// Values of a triangle that a loop over points computes beforehand: a software device computes them anew in every turn.
struct Squares {
    vec3 edges;    // squared lengths of ab, ac and bc, not 0 [m^2]
    float normal;  // of the normal [m^4]
    bool isSliver;
};

Squares squaresOf(Triangle triangle) {
    const vec3 ab = triangle.ab, ac = triangle.ac, bc = ac - ab;
    return Squares(max(vec3(dot(ab, ab), dot(ac, ac), dot(bc, bc)), vec3(1e-37)), dot(triangle.normal, triangle.normal), isSliver(triangle));
}

Nearest nearestOf(vec3 ap, Triangle triangle, Squares squares) {
    const vec3 ab = triangle.ab, ac = triangle.ac, bc = ac - ab;
    const vec3 inside = weightsOf(ap, triangle);
    const float s = clamp(dot(ap, ab) / squares.edges.x, 0.0, 1.0), t = clamp(dot(ap, ac) / squares.edges.y, 0.0, 1.0);
    const float u = clamp(dot(ap - ab, bc) / squares.edges.z, 0.0, 1.0);
    const vec3 dAB = ap - s * ab, dAC = ap - t * ac, dBC = ap - ab - u * bc;
    Nearest nearest = Nearest(vec3(1.0 - s, s, 0.0), dAB, false);
    if (dot(dAC, dAC) < dot(nearest.d, nearest.d)) nearest = Nearest(vec3(1.0 - t, 0.0, t), dAC, false);
    if (dot(dBC, dBC) < dot(nearest.d, nearest.d)) nearest = Nearest(vec3(0.0, 1.0 - u, u), dBC, false);
    if (!squares.isSliver && min(inside.x, min(inside.y, inside.z)) >= 0.0) {
        const float height = dot(ap, triangle.normal) / squares.normal;
        nearest = Nearest(inside, height * triangle.normal, true);
    }
    return nearest;
}

Nearest nearestOf(vec3 ap, Triangle triangle) { return nearestOf(ap, triangle, squaresOf(triangle)); }
