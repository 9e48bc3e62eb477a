// Breaks the rule: no images.
#version 460
layout(binding = 0, r32ui) uniform uimage2D picture;

void main() { imageStore(picture, ivec2(0), uvec4(1)); }
