// One walk over the faces for thickness and middle of each sheet, one for its reach.
#include "sim/stiffness/folds.hpp"

#include "sim/collision/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace sinew::sim::stiffness {

namespace {

using collision::dot;
using collision::minus;
using collision::toVector;
using collision::Vector;

// Of its thickness, what a sheet may fall in a substep. Sheets that fold over capsules or crumple on a plane
// cross themselves from about 0.45 on (docs/accuracy.md).
constexpr double mostOfThickness = 0.35;

struct Sheet {
    Vector sum{};
    double corners = 0, halfThickness = std::numeric_limits<double>::infinity(), reach = 0;
    Vector middle() const { return {sum[0] / corners, sum[1] / corners, sum[2] / corners}; }
};

template <typename Visit>
void forEachCorner(const Scene& scene, std::span<const float> inverseMass, const Visit& visit) {
    for (const Face& face : scene.faces)
        for (const std::uint32_t corner : face.particles)
            if (!face.isSolid && inverseMass[corner] > 0)
                visit(face, corner, toVector(scene.particles[corner].position));
}

} // namespace

double longestFold(const Scene& scene, std::span<const float> inverseMass,
                   std::span<const std::uint32_t> components) {
    std::unordered_map<std::uint32_t, Sheet> sheets;
    forEachCorner(scene, inverseMass, [&](const Face& face, std::uint32_t corner, const Vector& place) {
        Sheet& sheet = sheets[components[corner]];
        for (std::size_t k = 0; k < 3; ++k) sheet.sum[k] += place[k];
        ++sheet.corners;
        sheet.halfThickness = std::min(sheet.halfThickness, double{face.thickness});
    });
    forEachCorner(scene, inverseMass, [&](const Face&, std::uint32_t corner, const Vector& place) {
        Sheet& sheet = sheets[components[corner]];
        const Vector away = minus(place, sheet.middle());
        sheet.reach = std::max(sheet.reach, std::sqrt(dot(away, away)));
    });
    const Vector gravity = toVector(scene.gravity);
    const double g = std::sqrt(dot(gravity, gravity));
    double longest = std::numeric_limits<double>::infinity();
    for (const auto& [component, sheet] : sheets) {
        double speed = std::sqrt(2 * g * sheet.reach);
        if (scene.damping > 0) speed = std::min(speed, g / double{scene.damping});
        if (speed > 0) longest = std::min(longest, mostOfThickness * 2 * sheet.halfThickness / speed);
    }
    return longest;
}

} // namespace sinew::sim::stiffness
