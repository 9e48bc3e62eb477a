// Shared by C++ and GLSL. By which part of their reach two that keep their rest distance may stray from it to either side and touch nothing.
// Bodies at rest tremble by rounding. Contacts only push, so what touched all the time would drift apart.
#ifndef REST_SLACK
#define REST_SLACK 1e-4f

// Speed at which pairs part, at most, that a cut has let touch [m/s].
#define CUT_RECOVERY_SPEED 0.1f
#endif
