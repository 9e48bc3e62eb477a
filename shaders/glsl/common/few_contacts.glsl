// The places of up to three candidates in the list of a particle, and how many it has of that kind. They do not depend on
// the candidates between them: with another margin, lists are longer or shorter.

uint countOf(uvec2 few) { return few.y >> 16; }

// Whether all of them are held.
bool areFew(uvec2 few) { return countOf(few) < RECOIL_CONTACTS; }

uint placeOf(uvec2 few, uint index) {
    return index == 0u ? few.x & 0xffffu : index == 1u ? few.x >> 16 : few.y & 0xffffu;
}

// Adds those of a word of 32 places, a bit each, which begins at place `first`. Stops behind one too many.
void addPlaces(inout uvec2 few, uint bits, uint first) {
    for (; bits != 0u && areFew(few); bits &= bits - 1u) {
        const uint count = countOf(few), place = first + findLSB(bits);
        few += uvec2(count == 0u ? place : count == 1u ? place << 16 : 0u, (count == 2u ? place : 0u) + (1u << 16));
    }
}
