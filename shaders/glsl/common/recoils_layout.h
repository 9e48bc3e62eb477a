// The part of layout.h for recoils (sim/collision/recoils.hpp); only layout.h includes it.

// A contact of a particle that may take a recoil back: its impulses are `most` times a factor from -1 to 0.
struct Recoil {
    float nX, nY, nZ; // unit, from the other
    float most;       // largest impulse that may be taken back [N s]
    uint other;       // slot of the other particle, with RECOIL_STILL if it does not give way; RECOIL_FIXED
    uint taken;       // factors of this iteration, the second extrapolated: two whole numbers of RECOIL_UNIT
    float drift;      // speed of what does not give way, along n [m/s]
    uint unused0;
};
#define RECOIL_PAIRS 3.0f  // counted as in shares, of a particle; one that has more takes no part
#define RECOIL_CONTACTS 4u // of a particle in all
#define RECOIL_STILL 0x80000000u // a particle that is fixed, driven or asleep
#define RECOIL_FIXED 0xffffffffu // planes, rigid colliders, static and driven faces together
#define RECOIL_LISTED 0x80000000u // beside a number of contacts
#define RECOIL_ROUNDS 32u        // iterations
#define RECOIL_UNIT (1.0f / 1024.0f)
// A recoil that would lift a particle by less than this part of the reach is left.
#define RECOIL_LIFT 0.01f

struct RecoilPush {
    uint count;   // number of particles; whole work groups
    uint substep; // from 0
};
