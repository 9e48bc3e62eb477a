// Bindings and specialisation constants with one meaning in all kernels; for GLSL and C++.
#ifndef SINEW_BINDINGS_H
#define SINEW_BINDINGS_H

// Bindings that need not follow the one before them. RECEIVED_BINDING: impulses of a substep (received.glsl).
// FORCES_BINDING: impulses of a step, then buffers that their kernels need beside them (forces.glsl). LAST_BINDING: the
// work groups or slots that a kernel runs over (kernel.glsl).
#define RECEIVED_BINDING 26
#define FORCES_BINDING 27
#define LAST_BINDING 31

// Binding n + TEXEL_TWINS reads the buffer of binding n as texels (fetched.glsl).
#define TEXEL_TWINS 32

// Specialisation constants that a program sets in every kernel that has them.
#define RUNS_LISTED_ID 30 // bool runsListed in kernel.glsl
#define USES_TEXELS_ID 31 // bool usesTexels in fetched.glsl

#endif
