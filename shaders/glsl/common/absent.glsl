// Whether a particle is in an absent body.
#include "common/absent.h"

bool isAbsent(vec3 x) { return x == vec3(ABSENT_PLACE); }
