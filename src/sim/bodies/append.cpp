// One function for each list that refers to others by index.
#include "sinew/append.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace sinew::sim {

namespace {

template <typename List> std::uint32_t lengthOf(const List& list) {
    return static_cast<std::uint32_t>(list.size());
}

template <typename List> void requireSpace(const List& list, const List& more) {
    if (list.size() + more.size() >= std::numeric_limits<std::uint32_t>::max())
        throw std::length_error("a scene has fewer than 2^32 - 1 elements of a kind");
}

void requireSpaces(const Scene& scene, const Scene& part) {
    requireSpace(scene.particles, part.particles);
    requireSpace(scene.distances, part.distances);
    requireSpace(scene.bends, part.bends);
    requireSpace(scene.attachments, part.attachments);
    requireSpace(scene.tethers, part.tethers);
    requireSpace(scene.fixed, part.fixed);
    requireSpace(scene.faces, part.faces);
    requireSpace(scene.skins, part.skins);
}

// Appends the elements of `more` after `shift` has changed them.
template <typename T, typename Shift>
void add(std::vector<T>& list, const std::vector<T>& more, const Shift& shift) {
    const std::size_t first = list.size();
    list.insert(list.end(), more.begin(), more.end());
    std::for_each(list.begin() + static_cast<std::ptrdiff_t>(first), list.end(), shift);
}

template <typename T> void add(std::vector<T>& list, const std::vector<T>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

void shiftAll(std::vector<std::uint32_t>& indices, std::uint32_t by) {
    for (std::uint32_t& index : indices) index += by;
}

bool isSame(const Surface& a, const Surface& b) {
    return a.friction == b.friction && a.restitution == b.restitution && a.staticFriction == b.staticFriction;
}

// By surface of the part, 0 included: Particle::surface in the scene.
std::vector<std::uint32_t> addSurfaces(std::vector<Surface>& surfaces, const std::vector<Surface>& more) {
    std::vector<std::uint32_t> numbers{0};
    for (const Surface& surface : more) {
        const auto found =
            std::ranges::find_if(surfaces, [&](const Surface& other) { return isSame(other, surface); });
        numbers.push_back(static_cast<std::uint32_t>(found - surfaces.begin()) + 1);
        if (found == surfaces.end()) surfaces.push_back(surface);
    }
    return numbers;
}

void addParticles(Scene& scene, const Scene& part) {
    const std::vector<std::uint32_t> surfaces = addSurfaces(scene.contacts.surfaces, part.contacts.surfaces);
    add(scene.particles, part.particles, [&](Particle& particle) {
        if (particle.surface < surfaces.size()) particle.surface = surfaces[particle.surface];
    });
}

void addConstraints(Scene& scene, const Scene& part, std::uint32_t first) {
    add(scene.distances, part.distances, [&](DistanceConstraint& d) {
        d.a += first;
        d.b += first;
    });
    add(scene.bends, part.bends, [&](BendConstraint& b) {
        b.a += first;
        b.b += first;
        b.c += first;
    });
    add(scene.attachments, part.attachments, [&](Attachment& a) { a.particle += first; });
    add(scene.tethers, part.tethers, [&](Tether& t) {
        t.particle += first;
        t.anchor += first;
    });
    add(scene.fixed, part.fixed, [&](FixedConstraint& f) { f.particle += first; });
}

void addSurroundings(Scene& scene, const Scene& part, std::uint32_t first) {
    add(scene.planes, part.planes);
    add(scene.colliders, part.colliders);
    add(scene.driven, part.driven, [&](DrivenBody& body) {
        body.firstParticle += first;
        shiftAll(body.particles, first);
    });
}

void addBodies(Scene& scene, const Scene& part, const SceneCounts& first) {
    add(scene.faces, part.faces, [&](Face& face) {
        for (std::uint32_t& corner : face.particles) corner += first.particles;
    });
    add(scene.bodies, part.bodies, [&](Body& body) { body.firstParticle += first.particles; });
    add(scene.grids, part.grids, [&](Grid& grid) {
        grid.firstParticle += first.particles;
        grid.firstDistance += first.distances;
    });
    add(scene.skins, part.skins, [&](Skin& skin) {
        shiftAll(skin.particles, first.particles);
        shiftAll(skin.anchors, first.particles);
        for (CellEmbedding& cell : skin.cells)
            for (std::uint32_t& corner : cell.particles) corner += first.particles;
    });
    add(scene.holds, part.holds, [&](NamedHold& hold) { shiftAll(hold.particles, first.particles); });
}

} // namespace

SceneCounts countsOf(const Scene& scene) {
    return {.particles = lengthOf(scene.particles),
            .distances = lengthOf(scene.distances),
            .bends = lengthOf(scene.bends),
            .attachments = lengthOf(scene.attachments),
            .tethers = lengthOf(scene.tethers),
            .fixed = lengthOf(scene.fixed),
            .planes = lengthOf(scene.planes),
            .colliders = lengthOf(scene.colliders),
            .driven = lengthOf(scene.driven),
            .faces = lengthOf(scene.faces),
            .bodies = lengthOf(scene.bodies),
            .grids = lengthOf(scene.grids),
            .skins = lengthOf(scene.skins),
            .holds = lengthOf(scene.holds)};
}

SceneCounts append(Scene& scene, const Scene& part) {
    if (&scene == &part) return append(scene, Scene(part));
    requireSpaces(scene, part);
    const SceneCounts first = countsOf(scene);
    addParticles(scene, part);
    addConstraints(scene, part, first.particles);
    addSurroundings(scene, part, first.particles);
    addBodies(scene, part, first);
    return first;
}

} // namespace sinew::sim
