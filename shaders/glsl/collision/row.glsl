// A row: a contact in the form that its passes use, four particles with a weight beta each. It is stored once, in the
// list of its owner. A point and a face: the point is the owner; 1 for the point, -b for the corners. EDGES: one of
// the two edges is the owner (near_edges.glsl); 1 - s and s for its ends, -(1 - t) and -t for those of the other.
// Requires the name WEIGHT of a kernel: b, or s and t; w: side and overlap. SHAPES_BINDING: binding of the faces, or
// edges; only for kernels that need the particles.
#ifdef EDGES
#define OTHER_PLACE 2u // place of the first particle of the other edge
float betaOf(uint element, uint place) {
    const float along = WEIGHT(element)[place / 2u], beta = (place & 1u) != 0u ? along : 1.0 - along;
    return place < OTHER_PLACE ? beta : -beta;
}
#else
#define OTHER_PLACE 1u
float betaOf(uint element, uint place) { return place == 0u ? 1.0 : -WEIGHT(element)[place - 1u]; }
#endif

#ifdef SHAPES_BINDING
struct Row {
    uint particles[4];
    vec4 beta;
};

#ifdef TEXELS
layout(binding = SHAPES_BINDING) uniform usamplerBuffer shapes;
#define SHAPE(s) texelFetch(shapes, int(s))
#else
layout(std430, binding = SHAPES_BINDING) readonly buffer Shapes { uvec4 shapes[]; }; // ContactFace or ContactEdge, in one load
#define SHAPE(s) shapes[s]
#endif

#ifdef EDGES
Row rowOf(uint owner, uint other, vec4 weight) {
    const uvec4 own = SHAPE(owner), one = SHAPE(other);
    return Row(uint[](own.x, own.y, one.x, one.y), vec4(1.0 - weight.x, weight.x, -(1.0 - weight.y), -weight.y));
}
#else
Row rowOf(uint owner, uint other, vec4 weight) {
    const uvec4 face = SHAPE(other);
    return Row(uint[](owner, face.x, face.y, face.z), vec4(1.0, -weight.xyz));
}
#endif

// The weighted sum over a row: position, or velocity, of the owner relative to the other.
vec3 between(Row row, vec3 a, vec3 b, vec3 c, vec3 d) { return row.beta.x * a + (row.beta.y * b + row.beta.z * c + row.beta.w * d); }

#define BETWEEN(row, AT) \
    between(row, AT(row.particles[0]).xyz, AT(row.particles[1]).xyz, AT(row.particles[2]).xyz, AT(row.particles[3]).xyz)

// D = sum_k |beta_k| S_k w_k, from the weight sums of the particles (sum_row_weights).
#define SHARED(row, shares) \
    (abs(row.beta.x) * shares[row.particles[0]] + abs(row.beta.y) * shares[row.particles[1]] + \
     abs(row.beta.z) * shares[row.particles[2]] + abs(row.beta.w) * shares[row.particles[3]])

// The surfaces of both bodies are those of their first particles.
#define SURFACES(row) pairs[surfaces[row.particles[0]] * push.surfaces + surfaces[row.particles[OTHER_PLACE]]]
#endif
