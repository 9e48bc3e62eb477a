// The blade of a step, where particles are for it and where they were, from bindings 0 to 2. Whoever includes this calls readBlade() first.
#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer pulledPlaces;
layout(binding = 1) uniform samplerBuffer before;
layout(binding = 2) uniform usamplerBuffer bladeHead; // BladeHead
#define PLACE(i) texelFetch(pulledPlaces, int(i)).xyz
#define BEFORE(i) texelFetch(before, int(i))
BladeHead blade;
void readBlade() {
    const uvec4 words = texelFetch(bladeHead, 4);
    blade = BladeHead(uintBitsToFloat(texelFetch(bladeHead, 0)), uintBitsToFloat(texelFetch(bladeHead, 1)), uintBitsToFloat(texelFetch(bladeHead, 2)),
                      uintBitsToFloat(texelFetch(bladeHead, 3)), words.x, words.y, 0u, 0u);
}
#else
layout(std430, binding = 0) readonly buffer PulledPlaces { vec4 pulledPlaces[]; };
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) readonly buffer Blade { BladeHead blade; };
#define PLACE(i) pulledPlaces[i].xyz
void readBlade() {}
#endif
