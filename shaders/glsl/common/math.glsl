// Products and sums of vectors with equal bits in every kernel: a compiler chooses how to compute dot(), cross() and
// length(), but may not fuse these products and sums (vk::withoutContraction). tests/vk/test_exact.cpp lists the
// functions that promise equal bits.
#ifndef MATH_GLSL
#define MATH_GLSL

float dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

vec3 cross3(vec3 a, vec3 b) { return a.yzx * b.zxy - a.zxy * b.yzx; }

float length3(vec3 a) { return sqrt(dot3(a, a)); }

// A radius plus the distance covered at velocity v in a substep of length h.
float sizeOf(float radius, float h, vec3 v) { return radius + h * length3(v); }

#endif
