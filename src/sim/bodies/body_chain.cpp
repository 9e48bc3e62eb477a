// Chains: equal masses in a line, one link from each to the next, and a last mass of its own. The simplest
// body on which a solver can fail: stiff, long, and with any ratio of masses.
#include "sinew/bodies.hpp"

#include <cmath>
#include <stdexcept>

namespace sinew::sim {
namespace {

void check(const Chain& chain) {
    const std::string head = "chain \"" + chain.name + "\": ";
    if (chain.particles < 2) throw std::invalid_argument(head + "must have at least 2 particles");
    if (!(chain.length > 0) || !(chain.mass > 0))
        throw std::invalid_argument(head + "length and mass must be positive");
    if (!(chain.endMass >= 0) || !(chain.compliance >= 0))
        throw std::invalid_argument(head + "endMass and compliance must not be negative");
    for (const std::uint32_t pinned : chain.pinned)
        if (pinned >= chain.particles)
            throw std::invalid_argument(head + "pinned particle " + std::to_string(pinned) +
                                        " is beyond its end");
}

float along(const Chain& chain, std::uint32_t index, float Vec3::*axis) {
    const double share = double(index) / (chain.particles - 1);
    return static_cast<float>(double{chain.origin.*axis} +
                              share * double{chain.length} * double{chain.direction.*axis});
}

} // namespace

std::uint32_t addChain(Scene& scene, const Chain& chain) {
    check(chain);
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    const double mass = double{chain.mass} / chain.particles;
    const auto rest = static_cast<float>(double{chain.length} / (chain.particles - 1));
    for (std::uint32_t i = 0; i < chain.particles; ++i) {
        const bool isWeight = i + 1 == chain.particles && chain.endMass > 0;
        scene.particles.push_back(
            {.position = {along(chain, i, &Vec3::x), along(chain, i, &Vec3::y), along(chain, i, &Vec3::z)},
             .velocity = {},
             .inverseMass = static_cast<float>(1 / (isWeight ? double{chain.endMass} : mass)),
             .contactOffset = 0});
        if (i > 0) scene.distances.push_back({first + i - 1, first + i, rest, chain.compliance});
    }
    for (const std::uint32_t pinned : chain.pinned) scene.fixed.push_back({first + pinned});
    scene.bodies.push_back({chain.name, first, chain.particles, 0});
    return first;
}

} // namespace sinew::sim
