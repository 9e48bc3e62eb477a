// Part of the kernels that need the skin in the state before a step with a blade: positions of its particles in that
// state and at rest, from bindings 4 and 5.
#include "lattice/saved_links.glsl"
#include "common/fetched.glsl"
FETCHED_VEC4(4, Places, placeThen)
FETCHED_VEC4(5, Rest, restPlace)
#define AT(i) placeThen(i).xyz
#define REST(i) restPlace(i).xyz
#define ALIVE(i) SAVED(i)
#define TURN(i) gradientAt(i)
#include "surface/gradient.glsl"
#include "surface/skin_place.glsl"
