// The part of a blade's swept area in one step that lies inside of the drawn body: the expected area of the
// new cut surface.
#pragma once

#include "sim/surface/closed_surface.hpp"

namespace sinew::test {

/// Areas of one stroke at the positions that the blade saw.
struct CutArea {
    double swept = 0;  ///< both sides of the swept area inside the body [m^2]
    double inside = 0; ///< new cut surface [m^2]
    double front = 0;  ///< length of the swept outline inside the body [m]; 0 = cut through
};

/// Areas of a blade that moved along a straight line in the newest step. The parallelogram between each two
/// of its points is measured along 200 lines. `before` is the topology before the stroke.
CutArea cutArea(CutBody& body, const vk::Buffer& before, const sim::Blade& blade);

} // namespace sinew::test
