// In place of the particle that a piece is named after. For C++ and GLSL.
#ifndef SINEW_PIECES_H
#define SINEW_PIECES_H

#define NO_PARTICLE 0xffffffffu   // nothing there can be cut
#define REMOVED_PIECE 0xfffffffeu // a crumb: Scene::crumbs

#endif
