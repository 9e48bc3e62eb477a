// Deliberately out of bounds: writes `past` elements behind the end.
#version 460
layout(local_size_x = 1) in;
layout(push_constant) uniform Push { uint past; } push;
layout(std430, binding = 0) writeonly buffer Values { uint values[]; };

void main() { values[values.length() - 1 + push.past] = 7; }
