// Impulses of contacts on each particle in a substep, for recoils (sim/collision/recoils.hpp): bits of floats. The buffer begins
// with the DispatchArguments of find_recoils, with groups if a particle is fast after its contacts. Sections of one uvec4 a
// slot follow:
//
//   0, 1   the tensor sum of j j^T / |j| of impulses j [N s]: xx, yy, zz; xy, xz, yz; w of 0: 1 until gather_contacts has
//          taken what faces gave (receive_rows)
//   2      sum of the impulses of planes, rigid colliders, static and driven faces, which never give way [N s]; w: sum of j . u, where u is the
//          velocity of their surface [m/s]
//   3      where forces are kept: arm of the last of those [m]; w: its element of the forces (forces.glsl), with isOfFace
#include "forces/received_sections.glsl"
layout(std430, binding = RECEIVED_BINDING) buffer ReceivedImpulses { uvec4 received[]; };

void clearReceivedGroups() {
    if (keepsReceived && gl_LocalInvocationID.x == 0u) received[0] = uvec4(0u);
}
