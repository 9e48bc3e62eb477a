// Values that replace the particle that a piece is named after. For C++ and GLSL.
#ifndef SINEW_PIECES_H
#define SINEW_PIECES_H

#define NO_PARTICLE 0xffffffffu   // the slot belongs to no body that may be cut
#define REMOVED_PIECE 0xfffffffeu // a removed fragment: Scene::debris

#endif
