// The part of layout.h for coarse levels (sim/levels/levels.hpp); only layout.h includes it.

#define LEVEL_CHILDREN 8 // most children of a block: slots in level 1, blocks of the level below in others
#define LEVEL_GROUP 128  // invocations of the work group that solves all levels of a body above the first
#define NO_BLOCK 0xffffffffu
#define BROKEN_BLOCK 0x80000000u // bit beside those of a block's links

struct LevelBlock {
    float inverseMass; // [1/kg]; 0 = contains a particle that never moves
    uint parent;       // block of the next level, or NO_BLOCK
    uint firstLink, links;
};

// A child and its weight in the block's position, 0 in entries that a block does not need; or, by slot, the block of a
// particle and the particle's share of its kick.
struct LevelChild {
    uint index;
    float weight;
};

// A link between two blocks of a level, seen from one of them.
struct LevelLink {
    uint other;       // the other block
    float restLength; // [m]
    float stiffness;  // [N/m]
    float most;       // limit of stiffness h^2 [kg]
};

// The blocks of a level of one body.
struct LevelRange {
    uint first, count;
};

struct LevelPush {
    uint count;   // kick_blocks: blocks of level 1; solve_levels: levels
    uint isFirst; // 1 in the first substep of a step
};

struct LevelCutPush {
    uint levels;
};
