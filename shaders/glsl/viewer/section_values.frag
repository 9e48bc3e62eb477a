#version 460
// Values of a color map in the section plane, between the particles of bodies with a skin: a mean in which each
// particle counts up to its reach. Added to the sums of section_count.frag: weight times value, and weight.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // color.x: the value of the last color
layout(location = 0) in vec3 worldPosition; // on a ball around the particle
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in float value; // below 0: unknown
layout(location = 3) in float reach;
layout(location = 0) out vec4 sum;

void main() {
    if (gl_FrontFacing || value < 0.0 || push.color.x <= 0.0 || reach <= 0.0) discard; // a back face for each ball
    const vec3 ray = worldPosition - frame.eye.xyz;
    const float height = dot(frame.section.xyz, frame.eye.xyz) - frame.section.w;
    const float approach = -dot(frame.section.xyz, ray);
    if (height <= 0.0 || approach <= 0.0) discard;
    const vec3 place = (height / approach - 1.0) * ray / reach + worldNormal; // of the plane, from the particle
    const float near = max(1.0 - dot(place, place) / (ICOSAHEDRON_INNER * ICOSAHEDRON_INNER), 0.0), weight = near * near;
    sum = vec4(weight * min(value / push.color.x, 4.0), weight, 0.0, 0.0);
}
