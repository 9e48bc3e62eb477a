#version 460
// Vertices of skins and of the surface of cuts, as the simulation stores them.
layout(push_constant) uniform Push { mat4 clipFromWorld; vec4 color; } push;
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 normal;
layout(location = 0) out vec3 outNormal;

void main() {
    outNormal = normal.xyz;
    gl_Position = push.clipFromWorld * vec4(position.xyz, 1.0);
}
