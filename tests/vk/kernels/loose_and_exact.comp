#version 460
// Functions that a compiler may fuse, and one that it must not.
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Values { vec4 values[]; };

float fused(float a, float b, float c) { return a * b + c; }

float exact(float a, float b, float c) {
    precise const float sum = a * b + c;
    return sum;
}

float dotted(vec3 a, vec3 b) {
    precise const float sum = dot(a, b);
    return sum;
}

vec3 crossed(vec3 a, vec3 b) {
    precise const vec3 area = cross(a, b);
    return area;
}

void main() {
    const vec4 v = values[gl_GlobalInvocationID.x];
    values[gl_GlobalInvocationID.x] = vec4(crossed(v.xyz, v.zxy), fused(v.x, v.y, v.z) + exact(v.x, v.y, v.w) + dotted(v.xyz, v.yzx));
}
