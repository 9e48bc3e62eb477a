// Columns of cells across gravity, each summed from its top.
#include "sim/collision/loads.hpp"

#include "sim/collision/vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace sinew::sim::collision::loads {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Stacked {
    std::array<std::int64_t, 2> column;
    double depth; // along gravity [m]
    std::uint32_t particle;
    bool operator<(const Stacked& other) const {
        return column != other.column ? column < other.column : depth < other.depth;
    }
};

double medianRadius(const Scene& scene) {
    std::vector<float> radii;
    for (const Particle& particle : scene.particles)
        if (particle.radius > 0) radii.push_back(particle.radius);
    if (radii.empty()) return 0;
    std::ranges::nth_element(radii, radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2));
    return double{radii[radii.size() / 2]};
}

// Particles that touch, column by column, each from its top.
std::vector<Stacked> columnsOf(const Scene& scene, const std::array<Vector, 3>& axes, double width) {
    std::vector<Stacked> stacked;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        const Particle& particle = scene.particles[i];
        if (particle.radius <= 0) continue;
        const auto column = [&](std::size_t axis) {
            const double cell = std::floor(dot(toVector(particle.position), axes[axis]) / width);
            return static_cast<std::int64_t>(std::clamp(cell, -9e18, 9e18));
        };
        stacked.push_back({{column(1), column(2)}, dot(toVector(particle.position), axes[0]), i});
    }
    std::sort(stacked.begin(), stacked.end());
    return stacked;
}

} // namespace

double longestSubstep(const Scene& scene, std::span<const float> inverseMass,
                      std::span<const std::uint32_t> bodies) {
    const auto [g, down] = pullOf(scene);
    const double median = medianRadius(scene);
    if (g == 0 || median == 0) return infinite;
    const std::vector<Stacked> stacked = columnsOf(scene, frameOf(down), 2 * median);
    double longest = infinite, above = 0;
    for (std::size_t s = 0; s < stacked.size(); ++s) {
        const std::uint32_t lower = stacked[s].particle;
        const bool isTop = s == 0 || stacked[s - 1].column != stacked[s].column;
        if (isTop) above = 0;
        if (above > 0 && bodies[stacked[s - 1].particle] != bodies[lower]) {
            const std::uint32_t upper = stacked[s - 1].particle;
            const double radius =
                double{std::min(scene.particles[upper].radius, scene.particles[lower].radius)};
            const double split = 2 * (double{inverseMass[upper]} + double{inverseMass[lower]});
            longest = std::min(longest, std::sqrt(give * radius / (above * g * split)));
        }
        above = inverseMass[lower] > 0 ? above + 1 / double{inverseMass[lower]} : 0;
    }
    return longest;
}

} // namespace sinew::sim::collision::loads
