// Motion of the material around a slot, for kernels of skins beside cuts: defines the macros of nearby.glsl and
// skin_place.glsl, from bindings 1 to 6.
#ifdef TEXELS
layout(binding = 1) uniform usamplerBuffer links;
layout(binding = 2) uniform samplerBuffer rest;
layout(binding = 3) uniform usamplerBuffer particles; // one per slot
layout(binding = 4) uniform samplerBuffer positions;  // one per particle
layout(binding = 5) uniform samplerBuffer gradients;  // Gradient
layout(binding = 6) uniform usamplerBuffer near;
#define LINKS(i) texelFetch(links, int(i)).x
#define HOME(i) texelFetch(rest, int(i)).xyz
#define PARTICLE(i) texelFetch(particles, int(i)).x
#define POSITION(p) texelFetch(positions, int(p))
#define NEAR(i) texelFetch(near, int(i)).x
mat3 turnOf(uint i) {
    const int g = int(3u * i);
    return mat3(texelFetch(gradients, g).xyz, texelFetch(gradients, g + 1).xyz, texelFetch(gradients, g + 2).xyz);
}
#else
layout(std430, binding = 1) readonly buffer Links { uint links[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // one per particle
layout(std430, binding = 5) readonly buffer Gradients { Gradient gradients[]; };
layout(std430, binding = 6) readonly buffer Near { uint near[]; };
#define LINKS(i) links[i]
#define HOME(i) rest[i].xyz
#define PARTICLE(i) particles[i]
#define POSITION(p) positions[p]
#define NEAR(i) near[i]
mat3 turnOf(uint i) { return mat3(gradients[i].x.xyz, gradients[i].y.xyz, gradients[i].z.xyz); }
#endif
#define TURN(i) turnOf(i)
#define AT(i) POSITION(PARTICLE(i)).xyz
