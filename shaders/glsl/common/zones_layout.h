// The part of layout.h for impact zones (sim/collision/impact_zones.hpp); only layout.h includes it.

#define ZONE_ROUNDS 6    // searches of a substep, each with a solution
#define ZONE_PAIRS 16384 // pairs with a time of their own in a search

// Dispatches of the searches: ZONE_ROUNDS among points, as many among edges; then the work groups that a search among
// points and one among edges would have now, if their lists are not empty.
#define ZONE_OF_EDGES ZONE_ROUNDS
#define ZONE_GROUPS (2 * ZONE_ROUNDS)
#define ZONE_SEARCHES (2 * ZONE_ROUNDS + 2)

// Words of the buffer of zones: counts, and then four words by slot.
#define ZONE_PAIR_COUNT 0
#define ZONE_MEMBER_COUNT 1
#define ZONE_WORDS 2
#define ZONE_OF_SLOT 4

// A point that passes a face, or two edges that pass each other.
struct ZonePair {
    uint point; // or an end of one of the edges
    float time; // when the two are as near as they may come, as a part of the substep
};

// Sums over the members of a zone, in integers of a common unit: each value as two of them, a coarse and a fine one.
#define ZONE_MASS 0  // mass
#define ZONE_WAY 1   // mass x displacement, three values
#define ZONE_SPEED 4 // mass x velocity, three values
#define ZONE_SUMS 7
struct Zone {
    uint most[3]; // bits of the largest mass, mass x displacement, mass x velocity of a member
    uint early;   // ~bits of the earliest time of its new pairs; 0 = it has none
    uint driven;  // ~slot of the lowest member that never gives way; 0 = it has none
    int coarse[ZONE_SUMS], fine[ZONE_SUMS];
};

struct ZonePush {
    uint count;  // number of particles; whole work groups
    uint moving, sheets; // as in FacePush
    uint large;          // wide faces, as in FaceFindPush
    uint round;
};
