// Shares of constraints among their particles, and loads of particles.
#include "sim/stiffness/terms.hpp"

#include "sim/stiffness/tensions.hpp"
#include "sinew/inverse_masses.hpp"

#include <numeric>

namespace sinew::sim::stiffness {

std::vector<std::uint32_t> componentsOf(const Scene& scene) {
    std::vector<std::uint32_t> parent(scene.particles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const DistanceConstraint& c : scene.distances) parent[root(c.a)] = root(c.b);
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

double clampOfLink(const Shares& shares, const Scene& scene, std::size_t link) {
    const DistanceConstraint& c = scene.distances[link];
    return double{shares.ofLinks[link]} * double{std::min(shares.times[c.a], shares.times[c.b])};
}

double splitOfBend(const Load& load, const BendConstraint& c) {
    const auto end = [&](std::uint32_t i) { return load.bends[i] * double{load.inverseMass[i]}; };
    return end(c.a) + 4 * end(c.b) + end(c.c);
}

double shareOfSweep(const Settings& settings, std::uint32_t mostConstraints) {
    const double weight = settings.weight > 0 ? double{settings.weight} : 1.0 / std::max(1u, mostConstraints);
    return std::min(1.0, double{settings.overRelaxation} * weight);
}

Load loadOf(const Scene& scene, double tolerance) {
    Load load{.inverseMass = inverseMasses(scene), .links = {}, .bends = {}, .tensions = {}};
    load.links.assign(scene.particles.size(), 0);
    load.bends.assign(scene.particles.size(), 0);
    bool hasRigid = false;
    for (const DistanceConstraint& c : scene.distances) {
        if (canMove(load, {c.a, c.b})) ++load.links[c.a], ++load.links[c.b];
        hasRigid = hasRigid || c.compliance == 0;
    }
    for (const BendConstraint& c : scene.bends)
        if (canMove(load, {c.a, c.b, c.c})) ++load.bends[c.a], ++load.bends[c.b], ++load.bends[c.c];
    load.tensions = hasRigid && tolerance > 0
                        ? tensionsOf(scene, load.inverseMass, componentsOf(scene), tolerance)
                        : std::vector<double>(scene.distances.size(), 0.0);
    return load;
}

Shares sharesFor(const Scene& scene, const Settings& settings, const Load& load) {
    if (settings.solver != Solver::split) return {};
    return sharesOf(scene, settings, load.inverseMass);
}

} // namespace sinew::sim::stiffness
