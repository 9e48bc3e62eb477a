// Part of the kernels that ask where a skin is in the state that a step with a blade begins with. Whoever includes this has
//
//   places[], savedLinks[]   of the body then
//   rest[]                   where its particles were at rest
#define ALIVE(i) savedLinks[i]
#define AT(i) places[i].xyz
#define REST(i) rest[i].xyz
#define TURN(i) gradientAt(i)
#include "gradient.glsl"
#include "skin_place.glsl"
