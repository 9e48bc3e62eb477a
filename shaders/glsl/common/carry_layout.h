// The part of layout.h for states that a scene with other bodies takes over (sim/simulation/carrying.hpp); only
// layout.h includes it.

#define NO_ELEMENT 0xffffffffu // an element that the other scene does not have

struct CarryPush {
    uint count;  // words of all entries
    uint words;  // of an entry
    uint values; // elements that the words are indices of; 0 = they are no indices
};

struct CarryContactsPush {
    uint count;    // owners
    uint partners; // possible partners before
    uint words;    // of an entry
    uint first;    // place of the first entry carried
    uint room;     // entries of the pool
};

struct ArrivalPush {
    vec4 halfKick; // velocity from gravity in half a substep [m/s]
    uint count;    // slots
    float thetaH;  // position stored = x + thetaH v [s]
};
