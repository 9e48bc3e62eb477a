// Layout of the lists of a kind of contacts that a substep makes of what touches, in words (touched.glsl): the length of
// each list, the number of the substep, a mark for each slot of the state, and the lists.
#ifndef TOUCHED_H
#define TOUCHED_H

// The lists.
#define TOUCHED_PARTICLES 0 // in a row that touches
#define TOUCHED_ROWS 1      // that touch, or that remember something
#define TOUCHED_POINTS 2    // with a pair that may touch
#define TOUCHED_LISTS 3

#define TOUCHED_SUBSTEP TOUCHED_LISTS // a mark of this substep is this number
#define TOUCHED_MARKS (TOUCHED_LISTS + 1)

#endif
