#version 460
// One light from above, and a weaker one from the side.
layout(push_constant) uniform Push { mat4 clipFromWorld; vec4 color; } push;
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 shown;

void main() {
    const vec3 n = normalize(normal);
    const float light = 0.25 + 0.6 * max(n.y, 0.0) + 0.25 * max(dot(n, normalize(vec3(-1.0, 0.3, 1.0))), 0.0);
    shown = vec4(push.color.rgb * light, 1.0);
}
