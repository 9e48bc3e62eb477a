// Motion of a point that the host sets in each step, for attachments and grabs.
#pragma once

#include "common/layout.h"
#include "sinew/scene.hpp"

#include <cmath>

namespace sinew::sim::constraints {

/// The point moved from `from` towards `target`, by at most `reach` [m]. In double: differences of float32
/// may overflow.
inline layout::vec4 movedTowards(const layout::vec4& from, const Vec3& target, double reach) noexcept {
    const double x = double{target.x} - double{from.x}, y = double{target.y} - double{from.y},
                 z = double{target.z} - double{from.z};
    const double way = std::hypot(x, y, z);
    if (way <= reach) return {target.x, target.y, target.z, 0};
    const double part = reach / way;
    return {static_cast<float>(double{from.x} + part * x), static_cast<float>(double{from.y} + part * y),
            static_cast<float>(double{from.z} + part * z), 0};
}

} // namespace sinew::sim::constraints
