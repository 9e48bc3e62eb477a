// Loop over the used rows of a pool (bounds.entries): one row an invocation, or several if there are more rows than
// invocations (ROWS_MOST_GROUPS).
#define FOR_EACH_ROW(row) for (uint row = gl_GlobalInvocationID.x; row < bounds.entries; row += gl_NumWorkGroups.x * GROUP_SIZE)

uint elementOf(uint row) { return isReversed ? bounds.entries - 1u - row : row; }
