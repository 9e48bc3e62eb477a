// A contact of two edges as both compute it, to the same bits: of the one with the smaller index, `first`, against the other.
layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 1) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; }; // of each edge: the first element, how many
layout(push_constant) uniform Push { FacePush push; };

struct EdgePair {
    ContactEdge first, second;
    bool isFirst; // the edge that asks
};

EdgePair pairOf(uint e, uint f) {
    const bool isFirst = e < f;
    return EdgePair(edges[isFirst ? e : f], edges[isFirst ? f : e], isFirst);
}

// Between the places s and t along both.
vec3 between(vec3 a, vec3 b, vec3 c, vec3 d, vec2 st) { return mix(a, b, st.x) - mix(c, d, st.y); }
