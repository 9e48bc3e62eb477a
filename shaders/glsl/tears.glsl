// Part of the kernels that tear sheets: which of two cells is to tear first. Where they are stretched alike a number decides that no
// direction of the grid has a part in.
#include "mixed.glsl"

bool isBefore(uint one, uint other) {
    const float a = strains[one].strain, b = strains[other].strain;
    return a != b ? a > b : mixed(one) > mixed(other);
}
