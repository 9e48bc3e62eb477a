// Passes over the rows of a pool that are in use (bounds.entries), with one invocation a row, or some where there are more rows than
// invocations (ROWS_MOST_GROUPS).
#define FOR_EACH_ROW(row) for (uint row = gl_GlobalInvocationID.x; row < bounds.entries; row += gl_NumWorkGroups.x * GROUP_SIZE)

uint elementOf(uint row) { return isReversed ? bounds.entries - 1u - row : row; }
