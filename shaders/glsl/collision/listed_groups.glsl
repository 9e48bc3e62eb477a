// Lists what has contacts: owners of lists (LISTS_OWNERS), and the work groups of particles (LISTS_PARTICLES). Requires
// the names bounds and GROUPS_BINDING of a kernel.
layout(std430, binding = GROUPS_BINDING) buffer Arguments { DispatchArguments arguments[]; };
#ifdef LISTS_OWNERS
layout(std430, binding = GROUPS_BINDING + 1) writeonly buffer Owners { uint owners[]; };

void listOwner(uint i) {
    const uint place = atomicAdd(bounds.listed, 1u);
    owners[place] = i;
    atomicMax(arguments[0].groupsX, place / GROUP_ITEMS + 1u);
}
#define PARTICLES_BINDING (GROUPS_BINDING + 2)
#else
#define PARTICLES_BINDING (GROUPS_BINDING + 1)
#endif
#ifdef LISTS_PARTICLES
layout(std430, binding = PARTICLES_BINDING) buffer ParticleMarks { uint particleMarks[]; }; // one per group: the newest build that listed it
layout(std430, binding = PARTICLES_BINDING + 1) writeonly buffer Particles { uint particles[]; };

void listParticle(uint i) {
    const uint group = i / GROUP_ITEMS;
    if (atomicMax(particleMarks[group], bounds.builds) >= bounds.builds) return;
    const uint place = atomicAdd(bounds.listedParticles, 1u);
    particles[place] = group;
    atomicMax(arguments[1].groupsX, place + 1u);
}
#endif
