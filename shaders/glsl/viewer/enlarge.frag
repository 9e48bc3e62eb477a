#version 460
// A picture that was drawn smaller than it is shown. Nothing but a filtered read: software devices copy that as a whole.
layout(set = 0, binding = 7) uniform sampler2D drawn;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 shown;

void main() {
    shown = texture(drawn, place);
}
