// Part of the kernels that tear: which of two cells is to tear first. One that a cut has reached, or tears would begin anew beside
// their own ends, in the layer of cells that they lie in, and grow along the grid. Where they are stretched alike a number decides that no
// direction of the grid has a part in.
#include "mixed.glsl"

bool isBefore(uint one, uint other) {
    if (strains[one].isReached != strains[other].isReached) return strains[one].isReached != 0u;
    const float a = strains[one].strain, b = strains[other].strain;
    return a != b ? a > b : mixed(one) > mixed(other);
}
