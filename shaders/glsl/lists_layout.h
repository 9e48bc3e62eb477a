// Constants of contacts: bits of StepParams::lists, which say when a step makes lists. Part of layout.h.

// The host repeats a step that is undone because it lacked lists.
#define LISTS_REPEATS 1u
// The step was recorded without the passes that make lists in substeps after the first: it is calm.
#define LISTS_CALM 2u
// The step goes on from the state that there is, whether or not one before it lacked lists: it repeats that one, or follows none.
#define LISTS_RESUMES 4u

// The part of the slack of a particle at which lists are made anew in the first substep, if the host repeats steps. A particle that has
// strayed less then seldom uses up the rest in the same step.
#define LISTS_EARLY 0.7

// Work groups of a pass over the entries of a pool: as many as every device can dispatch.
#define ROWS_MOST_GROUPS 65535
