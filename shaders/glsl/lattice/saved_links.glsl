// The links of a body that may be cut at the start of a step, from binding 3.
#include "common/fetched.glsl"
FETCHED_UINT(3, SavedLinks, savedLinks)
#define SAVED(i) savedLinks(i)
