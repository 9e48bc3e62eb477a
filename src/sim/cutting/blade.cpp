// Bounding boxes of the blade and ray, and the points of a strip in the order of its quads.
#include "sim/cutting/blade.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::cutting {

namespace {

constexpr float farAway = 1e18f; // its square is finite

bool isNear(const Vec3& v) {
    return std::abs(v.x) < farAway && std::abs(v.y) < farAway && std::abs(v.z) < farAway; // false for NaN
}

layout::vec4 at(const Vec3& v, float w = 0) {
    return {v.x, v.y, v.z, w};
}

void grow(layout::BladeHead& head, const Vec3& v, float radius) {
    head.low = {std::min(head.low.x, v.x - radius), std::min(head.low.y, v.y - radius),
                std::min(head.low.z, v.z - radius), 0};
    head.high = {std::max(head.high.x, v.x + radius), std::max(head.high.y, v.y + radius),
                 std::max(head.high.z, v.z + radius), 0};
}

} // namespace

bool BladeWords::readBlade(const Blade& blade) noexcept {
    const std::size_t count = blade.from.size();
    if (count < 2 || count > ranges::mostBladePoints || blade.to.size() != count) return false;
    if (!std::ranges::all_of(blade.from, isNear) || !std::ranges::all_of(blade.to, isNear)) return false;
    for (std::size_t p = 0; p < count; ++p) {
        points_[2 * p] = at(blade.from[p]);
        points_[2 * p + 1] = at(blade.to[p]);
        grow(head_, blade.from[p], 0);
        grow(head_, blade.to[p], 0);
    }
    head_.quads = static_cast<std::uint32_t>(count - 1);
    head_.isCarried = blade.isCarried ? 1 : 0;
    return true;
}

bool BladeWords::readRay(const RayCut& ray) noexcept {
    if (!(ray.radius > 0) || !(ray.radius < farAway) || !isNear(ray.from) || !isNear(ray.to)) return false;
    head_.rayFrom = at(ray.from, ray.radius);
    head_.rayTo = at(ray.to);
    grow(head_, ray.from, ray.radius);
    grow(head_, ray.to, ray.radius);
    return true;
}

bool BladeWords::read(const Step& step, float dt) noexcept {
    constexpr float nothing = 3e38f;
    head_ = {.low = {nothing, nothing, nothing, 0}, .high = {-nothing, -nothing, -nothing, 0}, .dt = dt};
    const bool hasBlade = readBlade(step.blade);
    const bool hasRay = readRay(step.ray);
    return hasBlade || hasRay;
}

} // namespace sinew::sim::cutting
