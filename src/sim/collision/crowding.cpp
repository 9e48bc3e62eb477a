// Particles are counted in cells small enough that any two particles of one size in a cell touch. Sizes are
// powers of two.
#include "sim/collision/crowding.hpp"

#include "sim/model/components.hpp"
#include "sim/model/touching.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace sinew::sim::collision {

namespace {

struct Cell {
    int level = 0;             ///< radii in it are 2^level m to twice that
    std::uint32_t arrival = 0; ///< Body::arrival
    std::array<double, 3> place{};
    auto operator<=>(const Cell&) const = default;
};

Cell cellOf(const Particle& particle, std::uint32_t arrival) {
    const int level = std::ilogb(particle.radius);
    const double size = std::ldexp(2 / std::numbers::sqrt3, level); // its diagonal is the sum of two radii
    constexpr double shift = 0.377; // of the cells: round coordinates then lie on no border
    const auto along = [&](float x) { return std::floor(double{x} / size + shift) + 0.0; }; // no -0
    const Vec3& x = particle.position;
    return {level, arrival, {along(x.x), along(x.y), along(x.z)}};
}

std::uint64_t hashOf(const Cell& cell) {
    auto hash = static_cast<std::uint64_t>(cell.level) ^ std::uint64_t{cell.arrival} << 32;
    for (const double place : cell.place) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(place)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

using Crowd = std::vector<std::uint32_t>; // particles

// Cells share counters: no crowd is missed, and few other cells are examined.
std::map<Cell, Crowd> crowdedCells(const Scene& scene, const std::vector<float>& inverseMass) {
    std::vector<std::uint32_t> counts(std::bit_ceil(2 * scene.particles.size() + 1));
    const std::vector<std::uint32_t> arrivalOf = arrivals(scene);
    const auto cell = [&](std::size_t i) { return cellOf(scene.particles[i], arrivalOf[i]); };
    const auto countOf = [&](std::size_t i) -> std::uint32_t& {
        return counts[hashOf(cell(i)) & (counts.size() - 1)];
    };
    const auto counted = [&](std::size_t i) { return inverseMass[i] > 0 && scene.particles[i].radius > 0; };
    bool isAny = false;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        if (counted(i)) isAny = ++countOf(i) > ranges::mostInOneSpot || isAny;
    std::map<Cell, Crowd> cells;
    for (std::uint32_t i = 0; isAny && i < scene.particles.size(); ++i)
        if (counted(i) && countOf(i) > ranges::mostInOneSpot) cells[cell(i)].push_back(i);
    return cells;
}

// Particles in a crowd that are not of its largest linked body, whose particles may be as near as at rest.
std::size_t strangersIn(const Crowd& crowd, const std::vector<std::uint32_t>& components) {
    std::map<std::uint32_t, std::size_t> counts;
    std::size_t most = 0;
    for (const std::uint32_t particle : crowd) most = std::max(most, ++counts[components[particle]]);
    return crowd.size() - most;
}

std::vector<std::string> bodiesOf(const Scene& scene, const Crowd& crowd) {
    std::vector<std::string> names;
    for (const Body& body : scene.bodies) {
        const auto found = std::ranges::lower_bound(crowd, body.firstParticle);
        if (found != crowd.end() && *found - body.firstParticle < body.particleCount)
            names.push_back("\"" + body.name + "\"");
    }
    return names;
}

std::string sentence(const Scene& scene, const Crowd& crowd, std::size_t strangers) {
    const Vec3& x = scene.particles[crowd.front()].position;
    const std::vector<std::string> names = bodiesOf(scene, crowd);
    std::string bodies;
    if (names.size() == 1) bodies = "body " + names[0] + " has";
    if (names.size() > 1) bodies = "bodies " + names[0] + " and " + names[1];
    if (names.size() > 2) bodies += " and " + number(names.size() - 2) + " more";
    if (names.size() > 1) bodies += " overlap: they have";
    if (names.empty()) bodies = "there are";
    return bodies + " " + number(crowd.size()) + " particles that touch each other at (" + number(x.x) +
           ", " + number(x.y) + ", " + number(x.z) + ") m, where a particle may touch at most " +
           number(ranges::mostInOneSpot) + " of others and would touch " + number(strangers) +
           ": move them apart, by their centers or the pitch of copies, or take fewer";
}

} // namespace

void checkCrowding(const Scene& scene, Complaints& complaints) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    const std::map<Cell, Crowd> cells = crowdedCells(scene, inverseMass);
    if (cells.empty()) return;
    const std::vector<std::uint32_t> components = linkedComponents(scene, inverseMass);
    const Crowd* worst = nullptr;
    std::size_t most = ranges::mostInOneSpot;
    for (const auto& [cell, crowd] : cells) {
        const std::size_t strangers = strangersIn(crowd, components);
        if (strangers <= most) continue;
        most = strangers;
        worst = &crowd;
    }
    if (worst != nullptr) complaints.add("contacts", sentence(scene, *worst, most));
}

} // namespace sinew::sim::collision
