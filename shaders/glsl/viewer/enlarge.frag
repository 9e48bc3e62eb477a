#version 460
// A picture that was drawn smaller than it is shown, or PANELS that were drawn into an image of their own, their colors times their
// alpha. Nothing but a filtered read: software devices copy that as a whole.
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
