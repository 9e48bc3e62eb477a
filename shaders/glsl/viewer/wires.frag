#version 460
// Edges of triangles, over their surface.
layout(location = 0) out vec4 shown;

void main() {
    shown = vec4(0.02, 0.025, 0.03, 0.4);
}
