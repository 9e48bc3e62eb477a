// Masks of the candidates that a particle touches: a bit a candidate, 32 candidates a word, in the order of its list. count_contacts
// determines once a substep which candidates touch; later passes visit marked candidates alone. In a substep with fast particles a mark
// means that the two may touch: the first impact of both decides. The including kernel defines HITS_BINDING, the binding of the masks.
//   x: touches in this substep.   y: touched in the last one, and does so no more.
// The first word of a list stands at its owner. Word w > 0 of a list that begins at element e stands behind those of all owners, at
// e / 32 + w: element 32 (e / 32 + w) of the pool is of that list, so no other list has that word.
#ifndef HITS_ACCESS
#define HITS_ACCESS readonly
#endif
layout(std430, binding = HITS_BINDING) HITS_ACCESS buffer Hits { uvec2 hits[]; };

uint wordsOf(uvec2 list) { return (list.y + 31u) / 32u; }

uint hitWord(uint owners, uint i, uvec2 list, uint word) { return word == 0u ? i : owners + list.x / 32u + word; }
