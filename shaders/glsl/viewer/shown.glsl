// The output of a fragment shader of bodies: a color, or, as SURFACE, what surfaces.frag shades later.
#ifdef SURFACE
layout(location = 0) out vec4 seen;     // normal; w: distance along the camera's axis [m]
layout(location = 1) out vec4 material; // albedo; w: moist, less than -1 for insides

void show(vec3 worldPosition, vec3 worldNormal, Surface surface) {
    seen = vec4(seenNormal(worldPosition, worldNormal), 1.0 / gl_FragCoord.w);
    material = vec4(surface.albedo, surface.rim < skinRim ? -1.0 - surface.moist : surface.moist);
}
#else
layout(location = 0) out vec4 shown;

void show(vec3 worldPosition, vec3 worldNormal, Surface surface) {
    shown = shade(worldPosition, worldNormal, surface);
#ifdef GLASS
    shown.a = glassAlpha(worldPosition, worldNormal);
#endif
}
#endif
