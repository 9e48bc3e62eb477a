#version 460
// Panels as they were drawn into an image as large as the picture, their colors times their alpha.
layout(set = 0, binding = 2) uniform sampler2D kept;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 shown;

void main() { shown = texture(kept, place); }
