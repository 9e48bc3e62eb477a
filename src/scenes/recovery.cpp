// Whether a mesh body can have what it did not ask for.
#include "scenes/recovery.hpp"

#include "sim/ranges.hpp"
#include "sim/validate.hpp"

#include <stdexcept>

namespace sinew::scenes {

namespace {

void note(LoadedScene& loaded, const std::string& name, const std::string& why) {
    loaded.notes.push_back("mesh " + name + ": no recovery, cells that fold may stay so: " + why);
}

} // namespace

float recoveryOf(LoadedScene& loaded, const Section& section, const std::string& name) {
    if (section.has("recovery") || sim::canRecover(loaded.scene, loaded.settings))
        return section.number("recovery");
    note(loaded, name, "it needs solver split, and a scene without bends and damping_time");
    return 0;
}

mesh::AddedMesh addWithRecovery(LoadedScene& loaded, const Section& section, const mesh::TriangleMesh& mesh,
                                mesh::MeshBody body) {
    sim::Scene& scene = loaded.scene;
    const std::size_t particles = scene.particles.size(), links = scene.distances.size();
    try {
        return mesh::addMesh(scene, mesh, body);
    } catch (const std::domain_error&) {
        const bool isAsked = section.has("recovery") || body.isCuttable;
        if (isAsked || body.poissonRatio > sim::ranges::poissonRatio.low) throw;
    }
    scene.particles.resize(particles);
    scene.distances.resize(links);
    body.recovery = 0;
    note(loaded, body.name, "it is so far from the origin that rounding distorts its cells");
    return mesh::addMesh(scene, mesh, body);
}

} // namespace sinew::scenes
