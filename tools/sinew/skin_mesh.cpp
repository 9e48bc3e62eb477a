// Joins vertices that skins duplicate for their normals.
#include "sinew/skin_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

namespace sinew::tools {

namespace {

/// The first vertex on the same particle; for a vertex in a cell, itself.
std::vector<std::uint32_t> representatives(const sim::Skin& skin) {
    std::vector<std::uint32_t> first(skin.vertexCount());
    std::iota(first.begin(), first.end(), 0u);
    std::unordered_map<std::uint32_t, std::uint32_t> vertexOf;
    for (std::uint32_t v = 0; v < skin.particles.size(); ++v)
        first[v] = vertexOf.try_emplace(skin.particles[v], v).first->second;
    return first;
}

} // namespace

mesh::TriangleMesh skinMesh(const sim::Skin& skin, std::span<const sim::Vec3> vertices) {
    mesh::TriangleMesh mesh{.name = skin.name};
    if (skin.particles.empty()) {
        mesh.positions.assign(vertices.begin(), vertices.end());
        mesh.triangles = skin.triangles;
        return mesh;
    }
    const std::vector<std::uint32_t> first = representatives(skin);
    std::vector<std::uint32_t> index(first.size());
    for (std::uint32_t v = 0; v < first.size(); ++v) {
        if (first[v] == v) {
            index[v] = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(vertices[v]);
        } else {
            index[v] = index[first[v]];
        }
    }
    std::set<std::array<std::uint32_t, 3>> seen;
    for (const auto& triangle : skin.triangles) {
        const std::array<std::uint32_t, 3> corners{index[triangle[0]], index[triangle[1]],
                                                   index[triangle[2]]};
        std::array<std::uint32_t, 3> sorted = corners;
        std::ranges::sort(sorted);
        if (seen.insert(sorted).second) mesh.triangles.push_back(corners);
    }
    return mesh;
}

std::vector<sim::Vec3> skinVertices(const sim::Scene& scene, const sim::Skin& skin) {
    std::vector<sim::Vec3> vertices;
    for (const std::uint32_t particle : skin.particles)
        vertices.push_back(scene.particles[particle].position);
    for (const sim::CellEmbedding& cell : skin.cells) {
        sim::Vec3 sum;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const auto along = [](float weight, bool isHigh) { return isHigh ? weight : 1 - weight; };
            const float share = along(cell.weights.x, corner & 1) * along(cell.weights.y, corner >> 1 & 1) *
                                along(cell.weights.z, corner >> 2 & 1);
            const sim::Vec3& x = scene.particles[cell.particles[corner]].position;
            sum = {sum.x + share * x.x, sum.y + share * x.y, sum.z + share * x.z};
        }
        vertices.push_back(sum);
    }
    return vertices;
}

} // namespace sinew::tools
