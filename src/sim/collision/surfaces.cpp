// The surfaces that a scene uses, and the contact properties of each pair of them.
#include "sim/collision/surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::surfaces {

namespace {

Surface surfaceAt(const ContactSettings& contacts, std::uint32_t index) {
    if (index == 0) return {contacts.friction, contacts.restitution, contacts.staticFriction};
    return contacts.surfaces[index - 1];
}

float holding(const Surface& surface) {
    return std::max(surface.friction, surface.staticFriction);
}

// Equal values are returned unchanged, to the bit.
float meanOf(float a, float b) {
    return a == b ? a : std::sqrt(a * b);
}

layout::SurfacePair pairOf(const Surface& a, const Surface& b) {
    return {meanOf(a.friction, b.friction), std::max(a.restitution, b.restitution),
            meanOf(holding(a), holding(b))};
}

bool hasSeveral(const Scene& scene) {
    const Particle* first = nullptr;
    for (const Particle& particle : scene.particles) {
        if (particle.radius <= 0) continue;
        if (first && first->surface != particle.surface) return true;
        first = &particle;
    }
    return false;
}

} // namespace

Surfaces add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout) {
    const ContactSettings& contacts = scene.contacts;
    Surfaces surfaces;
    if (!hasSeveral(scene)) {
        const auto wide =
            std::ranges::find_if(scene.particles, [](const Particle& p) { return p.radius > 0; });
        const Surface only = surfaceAt(contacts, wide == scene.particles.end() ? 0 : wide->surface);
        surfaces.friction = only.friction;
        surfaces.staticFriction = holding(only);
        surfaces.restitution = only.restitution;
        surfaces.hasFriction = surfaces.staticFriction > 0;
        surfaces.hasRestitution = only.restitution > 0;
        return surfaces;
    }
    return addTable(program, scene, layout, "contacts.surface");
}

Surfaces addTable(ProgramBuilder& program, const Scene& scene, const StateLayout& layout, const char* name) {
    const ContactSettings& contacts = scene.contacts;
    Surfaces surfaces{.count = static_cast<std::uint32_t>(contacts.surfaces.size() + 1)};
    std::vector<layout::SurfacePair> pairs;
    for (std::uint32_t a = 0; a < surfaces.count; ++a)
        for (std::uint32_t b = 0; b < surfaces.count; ++b)
            pairs.push_back(pairOf(surfaceAt(contacts, a), surfaceAt(contacts, b)));
    std::vector<std::uint32_t> ofParticles(layout.count, 0);
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        ofParticles[layout.slot[i]] = scene.particles[i].surface;
    surfaces.hasFriction =
        std::ranges::any_of(pairs, [](const auto& pair) { return pair.staticFriction > 0; });
    surfaces.hasRestitution =
        std::ranges::any_of(pairs, [](const auto& pair) { return pair.restitution > 0; });
    surfaces.ofParticles = program.upload(std::string(name) + "s", ofParticles);
    surfaces.pairs = program.upload(std::string(name) + "_pairs", pairs);
    return surfaces;
}

} // namespace sinew::sim::collision::surfaces
