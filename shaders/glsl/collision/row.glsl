// A row: a contact in the form that its passes use, four particles with a weight beta each. It is stored once, in the
// list of its owner. A point and a face: the point is the owner; 1 for the point, -b for the corners. areEdges: one of
// the two edges is the owner (near_edges.glsl); 1 - s and s for its ends, -(1 - t) and -t for those of the other.
// Requires the name WEIGHT of a kernel: b, or s and t; w: side and overlap. SHAPES_BINDING: binding of the faces, or
// edges; only for kernels that need the particles.
#include "collision/row_kind.glsl"
const uint otherPlace = areEdges ? 2u : 1u; // of the first particle of the other edge, or of the first corner
float betaOf(uint element, uint place) {
    if (!areEdges) return place == 0u ? 1.0 : -WEIGHT(element)[place - 1u];
    const float along = WEIGHT(element)[place / 2u], beta = (place & 1u) != 0u ? along : 1.0 - along;
    return place < otherPlace ? beta : -beta;
}

#ifdef SHAPES_BINDING
struct Row {
    uint particles[4];
    vec4 beta;
};

#include "common/fetched.glsl"
FETCHED_UVEC4(SHAPES_BINDING, Shapes, shapeAt) // ContactFace or ContactEdge
#define SHAPE(s) shapeAt(s)

Row rowOf(uint owner, uint other, vec4 weight) {
    const uvec4 one = SHAPE(other);
    if (!areEdges) return Row(uint[](owner, one.x, one.y, one.z), vec4(1.0, -weight.xyz));
    const uvec4 own = SHAPE(owner);
    return Row(uint[](own.x, own.y, one.x, one.y), vec4(1.0 - weight.x, weight.x, -(1.0 - weight.y), -weight.y));
}

// The weighted sum over a row: position, or velocity, of the owner relative to the other.
vec3 between(Row row, vec3 a, vec3 b, vec3 c, vec3 d) { return row.beta.x * a + (row.beta.y * b + row.beta.z * c + row.beta.w * d); }

#define BETWEEN(row, AT) \
    between(row, AT(row.particles[0]).xyz, AT(row.particles[1]).xyz, AT(row.particles[2]).xyz, AT(row.particles[3]).xyz)

// D = sum_k |beta_k| S_k w_k, from the weight sums of the particles (sum_row_weights).
#define SHARED(row, shares) \
    (abs(row.beta.x) * shares[row.particles[0]] + abs(row.beta.y) * shares[row.particles[1]] + \
     abs(row.beta.z) * shares[row.particles[2]] + abs(row.beta.w) * shares[row.particles[3]])

// The surfaces of both bodies are those of their first particles.
#define SURFACES(row) pairs[surfaces[row.particles[0]] * push.surfaces + surfaces[row.particles[otherPlace]]]
#endif
