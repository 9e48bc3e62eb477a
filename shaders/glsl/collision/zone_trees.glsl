// Zones as trees of slots: which slots are in one tree depends on no order. Requires the buffer words.
#define PARENT(i) words[ZONE_WORDS + (i)]               // parent + 1, 0 = in no zone
#define MEMBER(m) words[ZONE_WORDS + push.count + (m)]   // slots in a zone
#define SOLVED(i) words[ZONE_WORDS + 2u * push.count + (i)] // root + 1 of the zone that was solved last, 0 = in none
#define LOOSE(i) words[ZONE_WORDS + 3u * push.count + (i)]  // bits of Request::loose (impact_zones.hpp)

uint rootOf(uint i) {
    uint parent = PARENT(i) - 1u;
    while (parent != i) {
        i = parent;
        parent = PARENT(i) - 1u;
    }
    return i;
}
