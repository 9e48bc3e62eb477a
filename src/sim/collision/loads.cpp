// One walk over pairs of discs for masses, one for contacts.
#include "sim/collision/loads.hpp"

#include "sim/collision/footprints.hpp"

#include <limits>

namespace sinew::sim::collision::loads {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// A share of the best overlap with particles below, or above: halfway between four particles of a grid, or
// three of a face, they still bear the whole load.
constexpr double leastOverlap = 0.25;

struct Masses {
    std::vector<double> borne; // by each particle: itself and all that stands on it [kg]
    std::vector<double> onto;  // the part from other bodies [kg]
    // The best overlap with a particle of another body.
    std::vector<double> below, above;
};

// By component, whether it has a touching face that is not solid: it folds, and does not bear its own weight.
std::vector<bool> sheetsOf(const Scene& scene, std::span<const std::uint32_t> bodies) {
    std::vector<bool> isSheet(scene.particles.size());
    for (const Face& face : scene.faces)
        if (!face.isSolid) isSheet[bodies[face.particles[0]]] = true;
    return isSheet;
}

bool areOfSeveral(const std::vector<Disc>& discs, std::span<const std::uint32_t> bodies) {
    return std::ranges::any_of(
        discs, [&](const Disc& disc) { return bodies[disc.particle] != bodies[discs[0].particle]; });
}

Masses massesOf(const Scene& scene, std::span<const float> inverseMass, std::span<const std::uint32_t> bodies,
                Footprints& footprints) {
    const std::vector<double> nothing(scene.particles.size(), 0);
    Masses masses{nothing, nothing, nothing, nothing};
    const std::vector<bool> isSheet = sheetsOf(scene, bodies);
    for (const Disc& disc : footprints.discs()) {
        const std::uint32_t lower = disc.particle;
        if (!disc.isStill) masses.borne[lower] = 1 / double{inverseMass[lower]};
        footprints.forEachAbove(disc, [&](const Disc& above, double overlap, double share) {
            const std::uint32_t upper = above.particle;
            const bool isOther = bodies[upper] != bodies[lower];
            if (!isOther && isSheet[bodies[lower]]) return;
            const double mass = share / double{inverseMass[upper]};
            masses.borne[lower] += mass;
            if (!isOther) return;
            masses.onto[lower] += mass;
            masses.above[lower] = std::max(masses.above[lower], overlap);
            masses.below[upper] = std::max(masses.below[upper], overlap);
        });
    }
    return masses;
}

} // namespace

std::vector<double> massesOnto(const Scene& scene, std::span<const float> inverseMass,
                               std::span<const std::uint32_t> bodies) {
    const Pull pull = pullOf(scene);
    if (pull.gravity == 0) return std::vector<double>(scene.particles.size(), 0);
    Footprints footprints(scene, inverseMass, pull.down);
    if (!areOfSeveral(footprints.discs(), bodies)) return std::vector<double>(scene.particles.size(), 0);
    return massesOf(scene, inverseMass, bodies, footprints).onto;
}

double longestSubstep(const Scene& scene, std::span<const float> inverseMass,
                      std::span<const std::uint32_t> bodies) {
    const Pull pull = pullOf(scene);
    if (pull.gravity == 0) return infinite;
    Footprints footprints(scene, inverseMass, pull.down);
    if (!areOfSeveral(footprints.discs(), bodies)) return infinite;
    const Masses masses = massesOf(scene, inverseMass, bodies, footprints);
    double longest = infinite;
    for (const Disc& disc : footprints.discs()) {
        const std::uint32_t lower = disc.particle;
        if (masses.above[lower] == 0) continue;
        footprints.forEachAbove(disc, [&](const Disc& above, double overlap, double) {
            const std::uint32_t upper = above.particle;
            if (bodies[upper] == bodies[lower]) return;
            const auto termOf = [&](std::uint32_t i, double mass, double best) {
                return mass * double{inverseMass[i]} * overlap / std::max(best, leastOverlap);
            };
            const double split = 2 * (termOf(upper, masses.borne[upper], masses.below[upper]) +
                                      termOf(lower, masses.onto[lower], masses.above[lower]));
            const double radius = (above.radius + disc.radius) / 2;
            longest = std::min(longest, std::sqrt(give * radius / (pull.gravity * split)));
        });
    }
    return longest;
}

} // namespace sinew::sim::collision::loads
