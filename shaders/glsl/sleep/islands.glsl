// Union-find over islands in one buffer: an element holds its parent, a root itself, and parents have lower indices
// than their children. Roots are only attached to smaller ones, by one atomic exchange that fails if another
// invocation was faster, so that in the end the root of an island is its first slot, whatever the order.
layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) coherent buffer Islands { uint islands[]; };

bool isAwake(uint i) { return weights[i] > 0.0 && velocities[i].w > 0.0; }

uint rootOf(uint i) {
    uint parent = islands[i];
    while (parent != i) {
        i = parent;
        parent = islands[i];
    }
    return i;
}

void join(uint i, uint j) {
    uint a = rootOf(i), b = rootOf(j);
    while (a != b) {
        const uint high = max(a, b), low = min(a, b);
        if (atomicCompSwap(islands[high], high, low) == high) return;
        a = rootOf(high);
        b = rootOf(low);
    }
}
