// One loop over the faces for thickness and middle of each sheet, one for its extent and its fall.
#include "sim/stiffness/folds.hpp"

#include "sim/stiffness/carried.hpp"

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

constexpr double infinite = std::numeric_limits<double>::infinity();

// Largest fall in a substep as a share of a sheet's thickness. A sheet folding over a capsule intersects
// itself at none of the shares up to 1.3 that were tried, a crumpling one from about 0.25 on
// (docs/accuracy.md).
constexpr double mostOfFold = 0.6, mostOfCrumple = 0.18;

struct Sheet {
    std::vector<std::uint32_t> corners; // each as often as faces contain it
    Vector sum{};
    double halfThickness = infinite;
    bool isHeld = false;

    // Extent of the sheet [m].
    struct Extent {
        double reach = 0;       // from its middle
        double uprightness = 0; // its height over its longest extent
    };

    Extent extent(const Scene& scene, const Vector& down) const {
        const double count = static_cast<double>(corners.size());
        const Vector middle{sum[0] / count, sum[1] / count, sum[2] / count};
        double most = 0, highest = -infinite, lowest = infinite;
        for (const std::uint32_t i : corners) {
            const Vector away = minus(toVector(scene.particles[i].position), middle);
            most = std::max(most, std::sqrt(dot(away, away)));
            highest = std::max(highest, -dot(away, down));
            lowest = std::min(lowest, -dot(away, down));
        }
        return {most, most > 0 ? (highest - lowest) / (2 * most) : 0};
    }
};

std::unordered_map<std::uint32_t, Sheet> sheetsOf(const Scene& scene, std::span<const float> inverseMass,
                                                  std::span<const std::uint32_t> components) {
    std::unordered_map<std::uint32_t, Sheet> sheets;
    for (const Face& face : scene.faces)
        for (const std::uint32_t corner : face.particles) {
            if (face.isSolid) continue;
            Sheet& sheet = sheets[components[corner]];
            sheet.corners.push_back(corner);
            const Vector place = toVector(scene.particles[corner].position);
            for (std::size_t k = 0; k < 3; ++k) sheet.sum[k] += place[k];
            sheet.halfThickness = std::min(sheet.halfThickness, double{face.thickness});
        }
    const auto hold = [&](std::uint32_t i) {
        if (const auto found = sheets.find(components[i]); found != sheets.end()) found->second.isHeld = true;
    };
    for (std::uint32_t i = 0; i < inverseMass.size(); ++i)
        if (inverseMass[i] == 0) hold(i);
    for (const Attachment& attachment : scene.attachments) hold(attachment.particle);
    return sheets;
}

// A plane with a smaller vertical component of its normal is a wall, on which nothing comes to rest.
constexpr double steepest = 0.1;

// Distance along gravity from a position to the nearest plane below.
double wayToPlanes(const Scene& scene, const Vector& place, const Vector& down) {
    double way = infinite;
    for (const Plane& plane : scene.planes) {
        const Vector normal = toVector(plane.normal);
        const double toward = -dot(normal, down), gap = dot(normal, place) - double{plane.offset};
        if (toward > steepest) way = std::min(way, std::max(0.0, gap) / toward);
    }
    return way;
}

} // namespace

double longestSubstepOfFolds(const Scene& scene, std::span<const float> inverseMass,
                             std::span<const std::uint32_t> components) {
    const auto [g, down] = collision::pullOf(scene);
    std::unordered_map<std::uint32_t, Sheet> sheets = sheetsOf(scene, inverseMass, components);
    std::erase_if(sheets, [](const auto& one) { return one.second.isHeld; });
    if (g == 0 || sheets.empty()) return infinite;
    std::vector<std::uint32_t> asked;
    for (const auto& [component, sheet] : sheets)
        asked.insert(asked.end(), sheet.corners.begin(), sheet.corners.end());
    std::ranges::sort(asked);
    asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
    const Support support = Supports(scene, components, down, asked).at(0);
    double longest = infinite;
    for (const auto& [component, sheet] : sheets) {
        const auto [reach, uprightness] = sheet.extent(scene, down);
        double fold = 0, crumple = 0;
        for (const std::uint32_t i : sheet.corners) {
            const Vector place = toVector(scene.particles[i].position);
            const double fall = std::min(support.ways[i], wayToPlanes(scene, place, down));
            fold = std::max(fold, std::min(reach, fall));
            if (fall < infinite) crumple = std::max(crumple, uprightness * fall);
        }
        const auto limit = [&](double fall, double mostOfThickness) {
            double speed = std::sqrt(2 * g * fall);
            if (scene.damping > 0) speed = std::min(speed, g / double{scene.damping});
            if (speed > 0) longest = std::min(longest, mostOfThickness * 2 * sheet.halfThickness / speed);
        };
        limit(fold, mostOfFold);
        limit(crumple, mostOfCrumple);
    }
    return longest;
}

} // namespace sinew::sim::stiffness
