// Coarse levels of `split` (sim/levels/levels.hpp): the kick that the links of a block give it. A block's position is
// a weighted mean of its children's stored positions, so a force on it acts on each child by the child's weight. The
// kernel declares `step`, LINK(k) and BLOCK_POSITION(b).
#include "common/math.glsl"
#include "common/link_impulse.glsl"

// The kick of block b by the links of its own level [m/s].
vec3 kickOfLinks(LevelBlock block, vec3 x, Substep substep) {
    vec3 sum = vec3(0.0);
    for (uint k = block.firstLink; k < block.firstLink + block.links; ++k) {
        const uvec4 link = LINK(k);
        const float stiffness = min(uintBitsToFloat(link.z) * substep.hh, uintBitsToFloat(link.w));
        sum += linkImpulse(x, BLOCK_POSITION(link.x), uintBitsToFloat(link.y), stiffness);
    }
    return substep.impulse * block.inverseMass * sum;
}
