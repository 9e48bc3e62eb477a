#version 460
// Panels: opaque areas.
layout(location = 0) in vec2 texel; // unused, but panel.vert writes it
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 shown;

void main() { shown = vec4(color.rgb, 1.0); }
