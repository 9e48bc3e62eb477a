// Equal surfaces are one: a scene has a table of pairs only where bodies differ.
#include "scenes/surface.hpp"

#include "scenes/bodies.hpp"

#include <algorithm>

namespace sinew::scenes {

namespace {

bool isSame(const sim::Surface& a, const sim::Surface& b) {
    return a.friction == b.friction && a.restitution == b.restitution && a.staticFriction == b.staticFriction;
}

void requireContacts(const LoadedScene& loaded, const Section& body, const char* key, std::size_t first) {
    if (loaded.scene.particles[first].radius <= 0) refuseUntouching(loaded, body, key);
}

/// As Particle::surface has it.
std::uint32_t indexOf(sim::ContactSettings& contacts, const Section& body, const char* key,
                      const sim::Surface& wanted) {
    if (isSame(wanted, {contacts.friction, contacts.restitution, contacts.staticFriction})) return 0;
    std::vector<sim::Surface>& surfaces = contacts.surfaces;
    const auto known =
        std::ranges::find_if(surfaces, [&](const sim::Surface& surface) { return isSame(surface, wanted); });
    if (known != surfaces.end()) return static_cast<std::uint32_t>(known - surfaces.begin() + 1);
    if (surfaces.size() == sim::ranges::mostSurfaces)
        body.fail(key, "makes more than " + std::to_string(sim::ranges::mostSurfaces) + " different surfaces",
                  "let bodies have the same");
    surfaces.push_back(wanted);
    return static_cast<std::uint32_t>(surfaces.size());
}

} // namespace

float staticFrictionOf(const Section& section) {
    return section.has("static_friction") ? section.number("static_friction") : 0;
}

bool isRestKept(const Section& section) {
    const std::string how = section.text("rest_contact");
    if (how != "keep" && how != "part")
        section.fail("rest_contact", "is \"" + how.substr(0, 64) + "\"", "possible are keep, part");
    return how == "keep";
}

void addSurface(LoadedScene& loaded, const Section& body, std::size_t first) {
    if (body.has("rest_contact")) requireContacts(loaded, body, "rest_contact", first);
    const bool keepsRest = body.has("rest_contact") ? isRestKept(body) : loaded.keepsRest;
    for (std::size_t i = first; i < loaded.scene.particles.size(); ++i)
        loaded.scene.particles[i].keepsRest = keepsRest;
    const char* key = nullptr;
    for (const char* candidate : {"friction", "static_friction", "restitution"})
        if (!key && body.has(candidate)) key = candidate;
    if (!key) return;
    requireContacts(loaded, body, key, first);
    sim::Scene& scene = loaded.scene;
    sim::Surface wanted{scene.contacts.friction, scene.contacts.restitution, scene.contacts.staticFriction};
    if (body.has("friction")) wanted.friction = body.number("friction");
    // who slides in a way of his own is not held in that of others
    if (body.has("friction") || body.has("static_friction")) wanted.staticFriction = staticFrictionOf(body);
    if (body.has("restitution")) wanted.restitution = body.number("restitution");
    const std::uint32_t index = indexOf(scene.contacts, body, key, wanted);
    for (std::size_t i = first; i < scene.particles.size(); ++i) scene.particles[i].surface = index;
}

} // namespace sinew::scenes
