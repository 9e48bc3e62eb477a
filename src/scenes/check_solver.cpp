// Only `split` has a form for contacts, paths and sleep.
#include "scenes/check_solver.hpp"

#include "scenes/section.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/touching.hpp"
#include "sinew/validate.hpp"

#include <algorithm>

namespace sinew::scenes {

namespace {

/// `body "ball"`, the first of which a particle is so.
template <typename IsSo> std::string bodyWhere(const sim::Scene& scene, const IsSo& isSo) {
    for (const sim::Body& body : scene.bodies)
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
            if (isSo(i)) return "body \"" + body.name + "\"";
    return "this scene";
}

std::vector<bool> cornersOf(const sim::Scene& scene) {
    std::vector<bool> isCorner(scene.particles.size());
    for (const sim::Face& face : scene.faces)
        for (const std::uint32_t corner : face.particles)
            if (corner < isCorner.size()) isCorner[corner] = true;
    return isCorner;
}

std::string drivenThing(const LoadedScene& loaded) {
    const sim::DrivenBody& driven = loaded.scene.driven.front();
    if (driven.particles.empty())
        return bodyWhere(loaded.scene, [&](std::uint32_t i) { return i == driven.firstParticle; });
    const sim::NamedHold* hold = sim::holdOf(loaded.holds, driven.particles.front());
    return hold == nullptr ? "this scene" : "hold \"" + hold->name + "\"";
}

/// validate() names lists of the API: settings are those of [solver] and [report], a grid is a body.
std::string inWordsOfFiles(std::string sentence) {
    const std::string settings = "settings", forces = "settings.keepsForces", grid = "grid[";
    if (sentence.starts_with(forces)) return "report.forces" + sentence.substr(forces.size());
    if (sentence.starts_with(settings)) return "solver" + sentence.substr(settings.size());
    const std::size_t name = sentence.find("] \"");
    if (sentence.starts_with(grid) && name != std::string::npos) return "body " + sentence.substr(name + 2);
    return sentence;
}

} // namespace

void requireForms(const LoadedScene& loaded, const std::string& file) {
    const sim::Scene& scene = loaded.scene;
    if (loaded.settings.solver == sim::Solver::split) return;
    const std::string none =
        std::string("solver ") + sim::solverName(loaded.settings.solver) + " does not support ";
    const std::vector<bool> isCorner = cornersOf(scene); // sheets with a thickness touch by their faces
    if (sim::particlesTouch(scene))
        fail(file,
             none + "particles that touch each other, as those of " +
                 bodyWhere(scene,
                           [&](std::uint32_t i) { return scene.particles[i].radius > 0 && !isCorner[i]; }) +
                 " do",
             "use split, or leave out collides and [[particles]]");
    if (sim::facesTouch(scene))
        fail(file,
             none + "particles that touch surfaces, as that of " +
                 bodyWhere(scene, [&](std::uint32_t i) { return isCorner[i]; }),
             "use split, or leave out thickness, faces and [[mesh_collider]]");
    if (!scene.driven.empty())
        fail(file, none + "keyframes of holds and mesh colliders, as those of " + drivenThing(loaded),
             "use split, or leave them out");
    if (loaded.settings.sleeps)
        fail(file, none + "bodies that sleep, as solver.sleep asks", "use split, or leave it out");
}

void requireValid(const LoadedScene& loaded, const std::string& file) {
    const std::vector<std::string> complaints = sim::validate(loaded.scene, loaded.settings);
    if (complaints.empty()) return;
    const std::string more =
        complaints.size() == 1 ? "" : " and " + std::to_string(complaints.size() - 1) + " more";
    fail(file, inWordsOfFiles(complaints.front()), "correct this" + more);
}

} // namespace sinew::scenes
