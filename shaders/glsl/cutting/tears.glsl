// Order of tearing of two cells: cells reached by a cut first, or new tears would begin beside the ends of earlier
// ones, in the same layer of cells, and grow along the grid. Between equal stretches a hash decides that does not
// depend on the grid's directions.
#include "cutting/mixed.glsl"

bool isBefore(uint one, uint other) {
    if (strains[one].isReached != strains[other].isReached) return strains[one].isReached != 0u;
    const float a = strains[one].strain, b = strains[other].strain;
    return a != b ? a > b : mixed(one) > mixed(other);
}
