#version 460
// Draws the stored backdrop of an earlier picture where there is no body.
layout(set = 0, binding = 6) uniform sampler2D kept;
layout(location = 0) in vec2 clip;
layout(location = 0) out vec4 shown;

void main() {
    shown = texelFetch(kept, ivec2(gl_FragCoord.xy), 0);
}
