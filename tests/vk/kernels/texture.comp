// Breaks the rule: no images of two dimensions.
#version 460
layout(binding = 0) uniform sampler2D picture;
layout(std430, binding = 1) buffer Values { vec4 values[]; };

void main() { values[0] = texelFetch(picture, ivec2(0), 0); }
