#version 460
// A picture that was drawn smaller than it is shown.
layout(set = 0, binding = 7) uniform sampler2D drawn;
layout(location = 0) in vec2 clip;
layout(location = 0) out vec4 shown;

void main() {
    const vec2 edge = 0.5 / vec2(textureSize(drawn, 0)); // what lies beyond is no part of the picture
    shown = textureLod(drawn, clamp(0.5 * clip + 0.5, edge, 1.0 - edge), 0.0);
}
