// Shading of surfaces: wrapped diffuse light that reddens at the terminator, two highlights, a rim of sky light.
#include "viewer/light.glsl"

const float reflectance = 0.042; // at normal incidence: moist tissue
const uint floorTaps = 6u + shadowTaps / 4u;
const vec2 floorAround = vec2(0.12, 0.30); // least share of the key light and of the sky in the light from below

// GGX distribution with the visibility term of [Karis 2014].
float highlight(float roughness, float nl, float nv, float nh) {
    const float a2 = pow(roughness, 4.0);
    const float d = nh * nh * (a2 - 1.0) + 1.0;
    const float k = 0.5 * roughness * roughness;
    return a2 / (pi * d * d) / (4.0 * (nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
}

// Light of the floor below a surface: the higher the surface, the larger the part of the floor that lights it. The taps
// are the same at each pixel: the map is soft, and noise would show as hatching where nothing else lights a body.
vec2 floorBelow(vec3 position, vec3 n) {
    const float height = max(position.y - frame.ground.x, 0.0);
    const vec3 center = position + vec3(n.x, 0.0, n.z) * (height + 0.03 * frame.stage.w);
    const float spread = 1.2 * height + 0.02 * frame.stage.w;
    vec2 sum = vec2(0.0);
    vec2 turn = vec2(1.0, 0.0);
    for (uint i = 0u; i < floorTaps; ++i, turn = nextTurn(turn)) {
        const vec2 offset = spread * discRadius(i, floorTaps) * turn;
        sum += floorLight(center + vec3(offset.x, 0.0, offset.y));
    }
    return mix(sum / float(floorTaps), vec2(1.0), smoothstep(0.2, 1.5, height / frame.stage.w));
}

struct Surface {
    vec3 albedo;
    float moist;   // 1 = wet tissue
    float wrapped; // share of the light that wraps around the terminator
    float rim;     // share of the sky that is mirrored at grazing angles
};

const float skinRim = 0.34, insideRim = 0.10; // walls of a cut see each other more than the sky

Surface tissue(vec3 albedo, float moist) {
    return Surface(albedo, moist, 0.6, skinRim);
}

// The unit normal on the side of a triangle that is seen. An inverted triangle in a smooth surface, such as a sliver
// beside a cut, is lit like its surroundings.
vec3 seenNormal(vec3 worldPosition, vec3 worldNormal) {
    const vec3 v = normalize(frame.eye.xyz - worldPosition);
    return normalize(worldNormal) * (gl_FrontFacing || dot(worldNormal, v) > 0.0 ? 1.0 : -1.0);
}

// The color of a pixel that shows a surface point; `n`: see seenNormal().
vec4 shadeSeen(vec3 worldPosition, vec3 n, Surface surface) {
    const vec3 albedo = surface.albedo;
    const float moist = surface.moist;
    const vec3 v = normalize(frame.eye.xyz - worldPosition);
    const vec3 l = frame.toLight.xyz;
    const vec3 halfway = normalize(l + v);
    const float nv = max(dot(n, v), 0.02), facing = dot(n, l), nl = max(facing, 0.0);
    const float phase = 2.0 * pi * pixelNoise(gl_FragCoord.xy);
    const float lit = nl > 0.0 ? keyShadow(worldPosition, n, shadowTaps, phase) : 0.0;

    // Light that enters beside the point and leaves here wraps around the terminator, further where the material is
    // brighter. The shadow map is of no use there, because the surface shadows itself.
    const vec3 wrap = 0.10 + 0.30 * albedo;
    const vec3 wrapped = max((facing + wrap) / (1.0 + wrap), 0.0) / (1.0 + wrap);
    const float litAround = mix(0.45, lit, smoothstep(0.0, 0.4, facing));
    const vec3 direct = keyLight * mix(vec3(nl * lit), wrapped * litAround, surface.wrapped);

    const float upward = 0.5 + 0.5 * n.y;
    const vec2 below = floorBelow(worldPosition, n);
    // The lit floor around a shadow reaches below a body that touches the floor.
    const vec2 lightBelow = mix(floorAround, vec2(1.0), below);
    const vec3 bounce = floorAlbedo * (skyLight * lightBelow.y + keyLight * frame.toLight.y * lightBelow.x);
    const vec3 ambient = mix(0.7 * bounce, skyLight, upward) * mix(0.5 + 0.5 * below.y, 1.0, upward);

    const float nh = max(dot(n, halfway), 0.0);
    const float fresnel = reflectance + (1.0 - reflectance) * pow(1.0 - max(dot(v, halfway), 0.0), 5.0);
    const float roughness = mix(0.30, 0.18, clamp(2.0 * (moist - 1.0), 0.0, 1.0)); // a film of liquid is smooth
    const float gloss = 0.55 * highlight(roughness, nl, nv, nh) + 0.45 * highlight(0.55, nl, nv, nh);
    const vec3 r = reflect(-v, n);
    const vec3 above = skyColor(vec3(r.x, max(r.y, 0.0), r.z));
    const vec3 mirrored = mix(bounce / pi, above, smoothstep(-0.3, 0.5, r.y)) * mix(0.3, 1.0, below.y);
    const vec3 rim = mirrored * (moist * reflectance + surface.rim * pow(1.0 - nv, 4.0));

    const vec3 diffuse = albedo * (direct + ambient) / pi;
    return finish(diffuse + moist * keyLight * nl * lit * fresnel * gloss + rim, gl_FragCoord.xy);
}

vec4 shade(vec3 worldPosition, vec3 worldNormal, Surface surface) {
    return shadeSeen(worldPosition, seenNormal(worldPosition, worldNormal), surface);
}

// Opacity of a translucent skin: larger at grazing angles.
float glassAlpha(vec3 worldPosition, vec3 worldNormal) {
    const float facing = abs(dot(normalize(frame.eye.xyz - worldPosition), normalize(worldNormal)));
    return 0.14 + 0.5 * pow(1.0 - facing, 3.0);
}

// A matt surface in exactly this color under full light, so that the color can be compared with a legend.
vec4 matt(vec3 worldPosition, vec3 worldNormal, vec3 color) {
    const vec3 n = normalize(worldNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    const float facing = dot(n, frame.toLight.xyz);
    const float lit = facing > 0.0 ? keyShadow(worldPosition, n, shadowTaps, 2.0 * pi * pixelNoise(gl_FragCoord.xy)) : 0.0;
    const float light = 0.62 + 0.10 * n.y + 0.38 * sqrt(max(facing, 0.0)) * lit;
    return encoded(min(light, 1.0) * color, gl_FragCoord.xy);
}
