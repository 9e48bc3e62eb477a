#version 460
// Enlarges a picture drawn smaller than it is shown; PANELS: an image of the panels, with premultiplied alpha. Does
// nothing but a filtered read, which software devices execute as a copy of the whole image.
#ifdef PANELS
#define BINDING 2
#else
#define BINDING 7
#endif
layout(set = 0, binding = BINDING) uniform sampler2D drawn;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 shown;

void main() {
    shown = texture(drawn, place);
}
