// Loose particles: spheres in rows, with an optional random displacement, or at random positions, placed one
// after another where there is no overlap (random sequential addition, which jams at 38 % of the volume).
#include "sinew/bodies.hpp"

#include "sim/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace sinew::sim {
namespace {

constexpr std::uint32_t mostTries = 1000; // for one position

float spacingOf(const LooseParticles& p) {
    return p.spacing > 0 ? p.spacing : 2 * (p.radius + p.jitter);
}

void check(const LooseParticles& p) {
    const std::string head = "particles \"" + p.name + "\": ";
    if (!(p.radius > 0) || !(p.mass > 0))
        throw std::invalid_argument(head + "radius and mass must be positive");
    if (!(p.spacing >= 0) || !(p.jitter >= 0))
        throw std::invalid_argument(head + "spacing and jitter must not be negative");
    const double count = p.random > 0 ? double(p.random) : double(p.count[0]) * p.count[1] * p.count[2];
    if (!(count >= 1)) throw std::invalid_argument(head + "there is none");
    if (count > std::numeric_limits<std::int32_t>::max()) throw std::length_error(head + "are too many");
    // a relative 1e-6: 2 x 0.05 + 0 as written in a file may exceed 0.1 in float32
    if (p.random == 0 && double{spacingOf(p)} < 2 * (double{p.radius} + double{p.jitter}) * (1 - 1e-6))
        throw std::invalid_argument(head +
                                    "neighbours could overlap: spacing must be at least 2 (radius + jitter)");
}

void add(Scene& scene, const LooseParticles& p, const std::array<double, 3>& x) {
    scene.particles.push_back(
        {.position = {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])},
         .velocity = p.velocity,
         .inverseMass = 1 / p.mass,
         .contactOffset = p.radius,
         .radius = p.radius});
}

void addRows(Scene& scene, const LooseParticles& p) {
    Random random(p.seed);
    const double spacing = double{spacingOf(p)};
    const auto at = [&](float center, std::uint32_t index, std::uint32_t count) {
        const double off = p.jitter > 0 ? random.symmetric() * double{p.jitter} : 0;
        return double{center} + (index - 0.5 * (count - 1.0)) * spacing + off;
    };
    for (std::uint32_t y = 0; y < p.count[1]; ++y) // bottom to top: neighbours in a layer are near in memory
        for (std::uint32_t z = 0; z < p.count[2]; ++z)
            for (std::uint32_t x = 0; x < p.count[0]; ++x) {
                const double first = at(p.center.x, x, p.count[0]), second = at(p.center.y, y, p.count[1]);
                add(scene, p, {first, second, at(p.center.z, z, p.count[2])});
            }
}

// The occupied positions, hashed in cells of a sphere's diameter.
class Places {
public:
    explicit Places(double diameter) : diameter_(diameter) {}

    bool isFree(const std::array<double, 3>& x) const {
        for (int n = 0; n < 27; ++n) {
            const auto found = cells_.find(keyOf(x, {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1}));
            if (found != cells_.end() && std::ranges::any_of(found->second, [&](const auto& other) {
                    return std::hypot(x[0] - other[0], x[1] - other[1], x[2] - other[2]) < diameter_;
                }))
                return false;
        }
        return true;
    }
    void take(const std::array<double, 3>& x) { cells_[keyOf(x, {0, 0, 0})].push_back(x); }

private:
    // Two cells with equal keys only cost more comparisons.
    std::uint64_t keyOf(const std::array<double, 3>& x, const std::array<int, 3>& offset) const {
        std::uint64_t key = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            key = key * 2'097'169 +
                  static_cast<std::uint64_t>(std::llround(std::floor(x[axis] / diameter_)) + offset[axis]);
        return key;
    }
    double diameter_;
    std::unordered_map<std::uint64_t, std::vector<std::array<double, 3>>> cells_;
};

void addScattered(Scene& scene, const LooseParticles& p) {
    Random random(p.seed);
    Places places(2 * double{p.radius});
    const auto within = [&](float center, float size) {
        return double{center} + random.symmetric() * std::max(0.0, double{size} / 2 - double{p.radius});
    };
    for (std::uint32_t i = 0; i < p.random; ++i) {
        std::uint32_t tries = 0;
        std::array<double, 3> x{};
        do {
            if (++tries > mostTries)
                throw std::domain_error("particles \"" + p.name + "\": no place is free for number " +
                                        std::to_string(i + 1) + " of " + std::to_string(p.random));
            x[0] = within(p.center.x, p.size.x);
            x[1] = within(p.center.y, p.size.y);
            x[2] = within(p.center.z, p.size.z);
        } while (!places.isFree(x));
        places.take(x);
        add(scene, p, x);
    }
}

} // namespace

std::uint32_t addParticles(Scene& scene, const LooseParticles& particles) {
    check(particles);
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    if (particles.random > 0)
        addScattered(scene, particles);
    else
        addRows(scene, particles);
    scene.bodies.push_back({.name = particles.name,
                            .firstParticle = first,
                            .particleCount = static_cast<std::uint32_t>(scene.particles.size()) - first,
                            .color = particles.color});
    return first;
}

} // namespace sinew::sim
