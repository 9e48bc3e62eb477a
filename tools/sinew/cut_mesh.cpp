// Points are named as layout::CutVertex does.
#include "sinew/cut_mesh.hpp"

#include <unordered_map>

namespace sinew::tools {

namespace {

class Joined {
public:
    explicit Joined(std::string name) { mesh_.name = std::move(name); }

    std::uint32_t vertex(std::uint32_t point, const sim::layout::vec4& position) {
        const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto [entry, isNew] = vertices_.try_emplace(point, next);
        if (isNew) mesh_.positions.push_back({position.x, position.y, position.z});
        return entry->second;
    }
    void triangle(const std::array<std::uint32_t, 3>& corners) { mesh_.triangles.push_back(corners); }
    mesh::TriangleMesh finish() { return std::move(mesh_); }

private:
    mesh::TriangleMesh mesh_;
    std::unordered_map<std::uint32_t, std::uint32_t> vertices_; // by point
};

void addSkin(const sim::Scene& scene, std::size_t index, const CutDownload& download, Joined& joined) {
    const sim::Skin& skin = scene.skins[index];
    std::uint32_t firstVertex = 0;
    std::size_t first = 0; // index
    for (std::size_t s = 0; s < index; ++s) {
        firstVertex += static_cast<std::uint32_t>(scene.skins[s].vertexCount());
        first += 3 * scene.skins[s].triangles.size();
    }
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
        const std::uint32_t* corners = &download.skinIndices[first + 3 * t];
        if (corners[0] == corners[1]) continue; // drawn in pieces
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t n = 0; n < 3; ++n)
            triangle[n] = joined.vertex(skin.particles.empty()
                                            ? SURFACE_SKIN | corners[n]
                                            : SURFACE_PARTICLE | skin.particles[corners[n] - firstVertex],
                                        download.skinVertices[corners[n]].position);
        joined.triangle(triangle);
    }
}

} // namespace

std::optional<mesh::TriangleMesh> cutSheet(const sim::Scene& scene, std::size_t index,
                                           const CutDownload& download) {
    if (download.pieceDraws.empty() || download.pieceDraws[index].indexCount == 0) return std::nullopt;
    Joined joined(scene.skins[index].name);
    const auto add = [&](std::size_t first, std::size_t triangles) {
        for (std::size_t t = 0; t < triangles; ++t) {
            const std::uint32_t* corners = &download.skinIndices[first + 3 * t];
            if (corners[0] == corners[1]) continue; // drawn in pieces
            std::array<std::uint32_t, 3> triangle{};
            for (std::size_t n = 0; n < 3; ++n)
                triangle[n] = joined.vertex(corners[n], download.skinVertices[corners[n]].position);
            joined.triangle(triangle);
        }
    };
    std::size_t first = 0;
    for (std::size_t s = 0; s < index; ++s) first += 3 * scene.skins[s].triangles.size();
    add(first, scene.skins[index].triangles.size());
    add(download.pieceDraws[index].firstIndex, download.pieceDraws[index].indexCount / 3);
    return joined.finish();
}

std::optional<mesh::TriangleMesh> cutMesh(const sim::Scene& scene, std::size_t index,
                                          const CutDownload& download) {
    const auto mine = static_cast<float>(index);
    Joined joined(scene.skins[index].name);
    bool isCut = false;
    for (const sim::layout::DrawArguments& draw : download.draws)
        for (std::uint32_t t = 0; t < draw.indexCount / 3; ++t) {
            const std::uint32_t* corners = &download.indices[draw.firstIndex + 3 * std::size_t{t}];
            if (download.rest[corners[0]].rest.w != mine) continue;
            isCut = true;
            std::array<std::uint32_t, 3> triangle{};
            for (std::size_t n = 0; n < 3; ++n)
                triangle[n] =
                    joined.vertex(download.rest[corners[n]].point, download.vertices[corners[n]].position);
            joined.triangle(triangle);
        }
    if (!isCut) return std::nullopt;
    addSkin(scene, index, download, joined);
    return joined.finish();
}

} // namespace sinew::tools
