// Bindings and specialisation constants with one meaning in all kernels; for GLSL and C++.
#ifndef SINEW_BINDINGS_H
#define SINEW_BINDINGS_H

// Bindings that need not follow the one before them. RECEIVED_BINDING: impulses of a substep (received.glsl).
// FORCES_BINDING: impulses of a step, then buffers that their kernels need beside them (forces.glsl). LAST_BINDING: the
// list that a kernel runs over (kernel.glsl).
#define RECEIVED_BINDING 26
#define FORCES_BINDING 27
#define LAST_BINDING 31

// Binding n + TEXEL_TWINS reads the buffer of binding n as texels (fetched.glsl).
#define TEXEL_TWINS 32

// Specialisation constants that a program sets in every kernel that has them.
#define RUNS_OVER_ID 30   // uint runsOver in kernel.glsl: RUNS_OVER_...
#define USES_TEXELS_ID 31 // bool usesTexels in fetched.glsl

// Items of a kernel that may run over a list.
#define RUNS_OVER_ALL 0
#define RUNS_OVER_GROUPS 1 // listed work groups
#define RUNS_OVER_ITEMS 2  // listed items, one an invocation; whole work groups
#define RUNS_OVER_COUNTED 3 // listed items of which the device knows the number (isPadding)

#endif
