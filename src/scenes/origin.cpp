// Differences in double, before anything becomes float32.
#include "scenes/origin.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::scenes {

namespace {

constexpr double farthest = 16; // [m]: steps of float32 are at most 1e-6 m up to there

struct PlaceKey {
    const char *list, *key;
};
constexpr PlaceKey placeKeys[] = {
    {"cloth", "origin"}, {"box", "center"}, {"box", "origin"}, {"mesh", "center"}, {"particles", "center"}};

} // namespace

std::array<double, 3> originOf(const Section& top) {
    for (const PlaceKey& place : placeKeys) {
        for (const Section& body : top.list(place.list)) {
            if (!body.has(place.key)) continue;
            std::array<double, 3> origin = body.point(place.key);
            const bool isNear = std::ranges::all_of(origin, [](double x) { return std::abs(x) <= farthest; });
            for (double& x : origin) x = isNear ? 0 : std::round(x);
            return origin;
        }
    }
    return {};
}

sim::Vec3 localPoint(const Section& section, std::string_view name, const std::array<double, 3>& origin) {
    const std::array<double, 3> world = section.point(name);
    const auto along = [&](std::size_t axis) { return static_cast<float>(world[axis] - origin[axis]); };
    return {along(0), along(1), along(2)};
}

float localOffset(const Section& plane, const std::array<double, 3>& origin) {
    const std::array<double, 3> normal = plane.point("normal");
    const double shift = normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2];
    return static_cast<float>(plane.value("offset") - shift);
}

} // namespace sinew::scenes
