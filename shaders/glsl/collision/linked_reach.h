// Shared by C++ and GLSL. Part of the ordinary contact distance that applies to a point and a face of a voxel body
// that may be cut, while only diagonal links join them.
#ifndef LINKED_REACH
#define LINKED_REACH 0.8f
#endif
