// Planes and colliders stop every particle that moves, a mesh stops particles with a radius and other faces.
#include "scenes/untouched.hpp"

#include "sim/compile/compile.hpp"
#include "sim/core/counted.hpp"

#include <algorithm>

namespace sinew::scenes {

namespace {

/// "2 planes, 1 collider and 3 mesh colliders", without those that there are none of.
std::string obstaclesText(const Section& top) {
    std::vector<std::string> kinds;
    for (const auto& [list, one] :
         {std::pair{"plane", "plane"}, {"collider", "collider"}, {"mesh_collider", "mesh collider"}})
        if (const std::size_t count = top.list(list).size(); count > 0)
            kinds.push_back(sim::counted(count, one));
    std::string text;
    for (std::size_t k = 0; k < kinds.size(); ++k)
        text += (k == 0 ? "" : k + 1 == kinds.size() ? " and " : ", ") + kinds[k];
    return text;
}

} // namespace

void warnOfUntouched(LoadedScene& loaded, const Section& top) {
    const std::string obstacles = obstaclesText(top);
    if (obstacles.empty()) return;
    const sim::Scene& scene = loaded.scene;
    const std::vector<float> inverseMass = sim::inverseMasses(scene);
    if (std::ranges::none_of(inverseMass, [](float w) { return w > 0; })) {
        loaded.warnings.push_back("nothing can touch the " + obstacles +
                                  " of this scene: all its particles are held");
        return;
    }
    const std::size_t meshes = top.list("mesh_collider").size();
    const auto moves = [&](std::uint32_t particle) { return inverseMass[particle] > 0; };
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i)
        if (scene.particles[i].radius > 0 && moves(i)) return;
    if (std::ranges::any_of(
            scene.faces, [&](const sim::Face& face) { return std::ranges::any_of(face.particles, moves); }))
        return;
    const std::span<const sim::Body> all = scene.bodies; // mesh colliders are the last of them
    for (const sim::Body& body : all.last(meshes))
        loaded.warnings.push_back("nothing can touch mesh collider \"" + body.name +
                                  "\": give a box or mesh collides = true, a cloth collides = true or a "
                                  "thickness, or take a collider");
}

} // namespace sinew::scenes
