// Contains one of each construct that the reader must support.
#version 460
layout(local_size_x_id = 3, local_size_y = 2, local_size_z = 1) in;
layout(constant_id = 0) const bool isReversed = false;
layout(constant_id = 7) const uint width = 5;
layout(constant_id = 8) const float scale = 0.5;

struct Link {
    vec3 direction;
    float length;
    uvec2 ends;
};
struct Frame {
    mat3 rotation;
    vec3 origin;
};

layout(push_constant) uniform Push {
    uvec2 range;
    float dt;
    Link extra;
} push;
layout(std430, binding = 0) readonly buffer Links { Link links[]; };
layout(std430, binding = 1) writeonly buffer Frames { Frame frames[]; };
layout(std430, binding = 2) buffer Positions { vec4 positions[]; };
layout(std430, binding = 3) readonly buffer Step { vec3 gravity; float dt; uint counts[3]; } params;
layout(std430, binding = 4) readonly buffer Masks { uint masks[][3]; };

shared vec3 partial[width * 2];
shared uint count;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    partial[gl_LocalInvocationIndex % (width * 2)] = params.gravity * scale;
    count = params.counts[1];
    barrier();
    positions[i] += vec4(partial[0] * push.dt, float(count + links[i].ends.x + masks[i][2]));
    frames[i].origin = isReversed ? positions[i].xyz : push.extra.direction;
    frames[i].rotation = mat3(params.dt);
}
