// Whether a mesh body can have what it did not ask for.
#include "scenes/recovery.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/ranges.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace sinew::scenes {

namespace {

std::string sentence(const std::string& name, const std::string& why) {
    return "mesh " + name + ": no recovery, cells that fold may stay so: " + why;
}

void note(LoadedScene& loaded, const std::string& name, const std::string& why) {
    loaded.notes.push_back(sentence(name, why));
}

// The first of the things that sim::canRecover() asks for and does not find.
std::string whyNot(const sim::Scene& scene, const sim::Settings& settings) {
    if (settings.solver != sim::Solver::split)
        return std::string("it needs solver split, the scene is solved by ") +
               sim::solverName(settings.solver);
    if (!settings.forms.usesGrids) return "it needs settings.forms.usesGrids";
    if (!scene.bends.empty()) return "it needs a scene without bends";
    if (scene.dampingTime != 0) return "it needs a scene without damping_time";
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "it needs solver.omega below %.3g, which is %g",
                  0.9 * sim::ranges::omegaBound(double{settings.theta}), double{settings.omega});
    return text.data();
}

void untouch(sim::Scene& scene, const sim::Body& body) {
    for (std::uint32_t i = 0; i < body.particleCount; ++i) {
        scene.particles[body.firstParticle + i].radius = 0;
        scene.particles[body.firstParticle + i].keepsRest = false;
    }
}

} // namespace

float recoveryOf(LoadedScene& loaded, const Section& section, const std::string& name) {
    if (section.has("recovery") || sim::canRecover(loaded.scene, loaded.settings))
        return section.number("recovery");
    note(loaded, name, whyNot(loaded.scene, loaded.settings));
    return 0;
}

sim::Scene withoutDefaults(sim::Scene scene, const Defaults& defaults, const sim::Settings& settings) {
    if (!defaults.recovery.empty() && !sim::canRecover(scene, settings))
        for (const std::uint32_t grid : defaults.recovery) scene.grids[grid].recoveryPressure = 0;
    if (settings.solver != sim::Solver::split)
        for (const std::uint32_t body : defaults.contacts) untouch(scene, scene.bodies[body]);
    return scene;
}

bool leaveWhole(sim::Scene& scene, const sim::Settings& settings) {
    const auto tears = [](const sim::Grid& grid) { return grid.tearStrain > 0; };
    const bool isRefused = settings.solver == sim::Solver::split || std::ranges::any_of(scene.grids, tears);
    if (isRefused || std::ranges::none_of(scene.grids, &sim::Grid::isCuttable)) return false;
    for (sim::Grid& grid : scene.grids) {
        grid.isCuttable = false;
        grid.toughness = 0;
    }
    return true;
}

std::vector<std::string> recoveryLeftOut(const LoadedScene& loaded, const sim::Settings& settings) {
    std::vector<std::string> notes;
    if (loaded.defaults.recovery.empty() || sim::canRecover(loaded.scene, settings)) return notes;
    for (const std::uint32_t grid : loaded.defaults.recovery)
        notes.push_back(sentence(loaded.scene.grids[grid].name, whyNot(loaded.scene, settings)));
    return notes;
}

mesh::AddedMesh addWithRecovery(LoadedScene& loaded, const Section& section, const mesh::TriangleMesh& mesh,
                                mesh::MeshBody body) {
    sim::Scene& scene = loaded.scene;
    const std::size_t particles = scene.particles.size(), links = scene.distances.size();
    try {
        mesh::AddedMesh added = mesh::addMesh(scene, mesh, body);
        if (!section.has("recovery") && body.recovery > 0)
            loaded.defaults.recovery.push_back(static_cast<std::uint32_t>(scene.grids.size() - 1));
        return added;
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
