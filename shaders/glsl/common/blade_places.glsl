// The blade of a step, and positions of particles at the end and at the start of its motion, from bindings 0 to 2.
// Call readBlade() first.
#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer bladePlaces; // by slot
layout(binding = 1) uniform samplerBuffer before;
layout(binding = 2) uniform usamplerBuffer bladeHead; // BladeHead
#define PLACE(i) texelFetch(bladePlaces, int(i)).xyz
#define BEFORE(i) texelFetch(before, int(i))
BladeHead blade;
void readBlade() {
    const uvec4 words = texelFetch(bladeHead, 4);
    blade = BladeHead(uintBitsToFloat(texelFetch(bladeHead, 0)), uintBitsToFloat(texelFetch(bladeHead, 1)), uintBitsToFloat(texelFetch(bladeHead, 2)),
                      uintBitsToFloat(texelFetch(bladeHead, 3)), words.x, words.y, 0u, 0u);
}
#else
layout(std430, binding = 0) readonly buffer BladePlaces { vec4 bladePlaces[]; }; // by slot
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) readonly buffer Blade { BladeHead blade; };
#define PLACE(i) bladePlaces[i].xyz
#define BEFORE(i) before[i]
void readBlade() {}
#endif

// Position of a slot's particle at the start of the motion of the blade.
vec3 placeBefore(uint i) {
    if (blade.isCarried == 0u) return PLACE(i);
    const vec4 then = BEFORE(i);
    return then.w > 0.0 ? then.xyz : PLACE(i);
}
