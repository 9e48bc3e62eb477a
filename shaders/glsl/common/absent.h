// The place of all particles of an absent body (Body::isAbsent), on all three axes [m]: the only mark that it is absent.
// For C++ and GLSL.
#ifndef SINEW_ABSENT_H
#define SINEW_ABSENT_H

#define ABSENT_PLACE 1e6f

#endif
