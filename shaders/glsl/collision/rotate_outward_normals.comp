#version 460
// Rotates the outward normals of interlocked lattices with their bodies: like normals of a surface, by the cofactor
// of the deformation gradient from a node's neighbours along the three axes, n = +-(N_x b x c + N_y c x a + N_z a x
// b).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer Nodes { InterlockNode nodes[]; };
layout(std430, binding = 2) readonly buffer Depths { vec4 depths[]; };           // along the axes of the grid; w: depth [m]
layout(std430, binding = 3) writeonly buffer Normals { vec4 normals[]; };
layout(push_constant) uniform Push { InterlockPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const vec4 rest = depths[i];
    vec3 axes[3];
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis) {
        const uint before = nodes[i].before[axis], after = nodes[i].after[axis];
        axes[axis] = (predicted[after].xyz - predicted[before].xyz) * (before != i && after != i ? 0.5 : 1.0);
    }
    const vec3 yz = cross(axes[1], axes[2]), zx = cross(axes[2], axes[0]), xy = cross(axes[0], axes[1]);
    const vec3 n = sign(dot(axes[0], yz)) * (rest.x * yz + rest.y * zx + rest.z * xy); // opposite if mirrored
    const float squared = dot(n, n);
    normals[i] = vec4(squared > 1e-30 ? n * inversesqrt(squared) : vec3(0.0), rest.w);
}
