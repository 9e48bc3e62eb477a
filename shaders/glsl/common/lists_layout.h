// Bits of StepParams. Part of layout.h.

// StepParams::wakes: all sleeping particles wake; none does, but the groups that run are listed anew.
#define WAKES_ALL 1u
#define WAKES_LISTS 2u

// StepParams::lists, which controls when a step makes contact lists.

// The host repeats a step that was undone because it lacked lists.
#define LISTS_REPEATS 1u
// The step was recorded without the passes that make lists in substeps after the first: it is calm.
#define LISTS_CALM 2u
// The step ignores a lack of lists in the step before: it repeats that step, or follows none.
#define LISTS_RESUMES 4u

// Part of a particle's slack at which lists are rebuilt in the first substep, if the host repeats steps. A particle
// that has strayed less then seldom uses up the rest in the same step.
#define LISTS_EARLY 0.7

// Work groups of a pass over the entries of a pool: as many as every device can dispatch.
#define ROWS_MOST_GROUPS 65535

struct ComputeEdgeBoundsPush {
    uint items, edges, members; // the larger number, in whole work groups; edges; watched ends
    float ahead, pace, unit;    // see GridPush; see motion_classes.glsl [m]
};
