// The box around points of a work group, and the largest of two numbers, in shared memory.
struct GroupBox {
    vec3 low, high;
    vec2 most;
};

shared uint boxLow[3], boxHigh[3], boxMost[2]; // as ordered()

// Integers in the order of floats.
uint ordered(float f) {
    const uint bits = floatBitsToUint(f);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float fromOrdered(uint o) { return uintBitsToFloat((o & 0x80000000u) != 0u ? o & 0x7fffffffu : ~o); }

// The box around both points and the numbers of all invocations with `isIn`. Every invocation must call it. Without
// any of them all components are NaN.
GroupBox boxOfGroup(bool isIn, vec3 a, vec3 b, vec2 numbers) {
    if (gl_LocalInvocationID.x == 0u) {
        for (uint axis = 0u; axis < 3u; ++axis) {
            boxLow[axis] = ~0u;
            boxHigh[axis] = 0u;
        }
        boxMost[0] = boxMost[1] = 0u;
    }
    barrier();
    if (isIn) {
        const vec3 least = min(a, b), most = max(a, b);
        for (uint axis = 0u; axis < 3u; ++axis) {
            atomicMin(boxLow[axis], ordered(least[axis]));
            atomicMax(boxHigh[axis], ordered(most[axis]));
        }
        atomicMax(boxMost[0], ordered(numbers.x));
        atomicMax(boxMost[1], ordered(numbers.y));
    }
    barrier();
    return GroupBox(vec3(fromOrdered(boxLow[0]), fromOrdered(boxLow[1]), fromOrdered(boxLow[2])),
                    vec3(fromOrdered(boxHigh[0]), fromOrdered(boxHigh[1]), fromOrdered(boxHigh[2])),
                    vec2(fromOrdered(boxMost[0]), fromOrdered(boxMost[1])));
}
