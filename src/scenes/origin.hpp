// Where a scene lies in the world. Simulation is in float32, which has steps of 0.06 m at 1e6 m: what a file
// places far away is simulated about an origin of its own, and everything comes out relative to it.
#pragma once

#include "scenes/section.hpp"

namespace sinew::scenes {

/// Of the first body of a file, in whole metres; 0 where that is within 16 m of the world's, or nobody says
/// where it is.
std::array<double, 3> originOf(const Section& top);

/// A point of the file relative to an origin [m]. The difference is taken in double.
sim::Vec3 localPoint(const Section& section, std::string_view name, const std::array<double, 3>& origin);

/// The offset of a plane of the file, likewise [m].
float localOffset(const Section& plane, const std::array<double, 3>& origin);

} // namespace sinew::scenes
