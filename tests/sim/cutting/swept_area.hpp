// How much of a blade's way in one step lies inside of a body, where that is drawn: what the new inside of a
// cut is to be compared with.
#pragma once

#include "sim/surface/closed_surface.hpp"

namespace sinew::test {

/// What one stroke has cut, measured where the blade saw the body.
struct CutArea {
    double swept = 0;  ///< both sides of the blade's way inside of it [m^2]
    double inside = 0; ///< of the cut surface that came with it [m^2]
    double front = 0;  ///< length of the outline of the way that ends inside [m]; 0 = it went through
};

/// Of a blade that moved along a straight line in the newest step: between each two of its points a
/// parallelogram, measured along 200 lines. `before` is the topology before that.
CutArea cutArea(CutBody& body, const vk::Buffer& before, const sim::Blade& blade);

} // namespace sinew::test
