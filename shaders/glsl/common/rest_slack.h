// Shared by C++ and GLSL. Relative distance by which pairs that keep their rest distance may stray from it to either
// side without touching. Bodies at rest tremble by rounding, and contacts only push, so pairs that touched all the
// time would drift apart.
#ifndef REST_SLACK
#define REST_SLACK 1e-4f

// Largest speed at which pairs separate whose contact a cut has made possible [m/s].
#define CUT_RECOVERY_SPEED 0.1f
#endif
