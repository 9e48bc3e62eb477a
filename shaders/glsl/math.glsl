// Products and sums that are the same bits in every kernel. A compiler may fuse a product and a sum unless both are `precise`, and dot(),
// cross() and length() never are. tests/vk/test_exact.cpp knows which functions promise this.
#ifndef MATH_GLSL
#define MATH_GLSL

float dot3(vec3 a, vec3 b) {
    precise const float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
}

vec3 cross3(vec3 a, vec3 b) {
    precise const vec3 area = a.yzx * b.zxy - a.zxy * b.yzx;
    return area;
}

float length3(vec3 a) { return sqrt(dot3(a, a)); }

// A radius, and how far its owner goes with velocity v in a substep of length h.
float sizeOf(float radius, float h, vec3 v) {
    precise const float size = radius + h * length3(v);
    return size;
}

#endif
