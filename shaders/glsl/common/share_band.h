// Shared by C++ and GLSL. Width of the band beyond the reach of a pair of particles, relative to the reach. Within it a
// pair does not touch, but counts in the shares of its particles with a weight that falls from 1 to 0. If shares jumped
// when a contact opens, high heaps would tremble for ever (docs/accuracy.md, "A soak of the same heap").
#ifndef SHARE_BAND
#define SHARE_BAND 0.004f
#endif
