// Shared by C++ and GLSL. In a voxel body that may be cut, the part of the ordinary distance at which a point touches a face to which
// only diagonal links join it.
#ifndef LINKED_REACH
#define LINKED_REACH 0.8f
#endif
