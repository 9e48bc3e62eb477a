// A triangle mesh as faces between particles that are static or follow a path.
#include "sinew/bodies.hpp"

#include "sinew/colliders.hpp"

#include <stdexcept>

namespace sinew::sim {

std::uint32_t addMeshCollider(Scene& scene, const MeshCollider& mesh) {
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= count) throw std::invalid_argument("a triangle names a vertex that does not exist");
    Skin skin{.name = mesh.name, .triangles = mesh.triangles, .color = mesh.color};
    const DrivenBody driven{
        .firstParticle = first, .particleCount = count, .path = mesh.path, .pathEnd = mesh.pathEnd};
    const Pose start = poseAt(driven, 0);
    for (const Vec3& vertex : mesh.vertices) {
        skin.particles.push_back(static_cast<std::uint32_t>(scene.particles.size()));
        const Vec3 position = mesh.path.empty() ? vertex : toWorld(start, toLocal(mesh.pose, vertex));
        scene.particles.push_back({.position = position, .inverseMass = 0, .radius = mesh.thickness});
    }
    if (!mesh.path.empty()) scene.driven.push_back(driven);
    for (const auto& [a, b, c] : mesh.triangles)
        if (a != b && b != c && c != a)
            scene.faces.push_back({{first + a, first + b, first + c}, mesh.thickness});
    scene.bodies.push_back({.name = mesh.name, .firstParticle = first, .particleCount = count});
    scene.skins.push_back(std::move(skin));
    return first;
}

} // namespace sinew::sim
