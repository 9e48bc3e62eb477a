// Columns of cells across gravity, each summed from its top.
#include "sim/collision/loads.hpp"

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

double dot(const Vec3& a, const std::array<double, 3>& b) {
    return double{a.x} * b[0] + double{a.y} * b[1] + double{a.z} * b[2];
}

// Unit vectors: along gravity, and two across.
std::array<std::array<double, 3>, 3> axesOf(const Vec3& gravity, double g) {
    const std::array<double, 3> down{double{gravity.x} / g, double{gravity.y} / g, double{gravity.z} / g};
    const std::size_t least = static_cast<std::size_t>(
        std::ranges::min_element(down, {}, [](double v) { return std::abs(v); }) - down.begin());
    std::array<double, 3> across{};
    across[least] = 1;
    for (std::size_t k = 0; k < 3; ++k) across[k] -= down[least] * down[k];
    const double length = std::hypot(across[0], across[1], across[2]);
    for (double& v : across) v /= length;
    const std::array<double, 3> third{down[1] * across[2] - down[2] * across[1],
                                      down[2] * across[0] - down[0] * across[2],
                                      down[0] * across[1] - down[1] * across[0]};
    return {down, across, third};
}

double medianRadius(const Scene& scene) {
    std::vector<float> radii;
    for (const Particle& particle : scene.particles)
        if (particle.radius > 0) radii.push_back(particle.radius);
    if (radii.empty()) return 0;
    std::ranges::nth_element(radii, radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2));
    return double{radii[radii.size() / 2]};
}

// Particles that touch, column by column, each from its top.
std::vector<Stacked> columnsOf(const Scene& scene, const std::array<std::array<double, 3>, 3>& axes,
                               double width) {
    std::vector<Stacked> stacked;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        const Particle& particle = scene.particles[i];
        if (particle.radius <= 0) continue;
        const auto column = [&](std::size_t axis) {
            const double cell = std::floor(dot(particle.position, axes[axis]) / width);
            return static_cast<std::int64_t>(std::clamp(cell, -9e18, 9e18));
        };
        stacked.push_back({{column(1), column(2)}, dot(particle.position, axes[0]), i});
    }
    std::sort(stacked.begin(), stacked.end());
    return stacked;
}

} // namespace

double longestSubstep(const Scene& scene, std::span<const float> inverseMass,
                      std::span<const std::uint32_t> bodies) {
    const Vec3& gravity = scene.gravity;
    const double g = std::hypot(double{gravity.x}, double{gravity.y}, double{gravity.z});
    const double median = medianRadius(scene);
    if (g == 0 || median == 0) return infinite;
    const std::vector<Stacked> stacked = columnsOf(scene, axesOf(gravity, g), 2 * median);
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
