// Points have the names of layout::CutVertex, so that the two sides of a cut differ.
#include "sinew/cut_mesh.hpp"

#include "mesh/split_edges.hpp"

#include <map>
#include <unordered_map>

namespace sinew::tools {

using app::Drawn;
using app::DrawnTriangle;

namespace {

using Part = DrawnTriangle::Part;

/// Numbers vertices in the order in which triangles name them.
class Numbers {
public:
    /// Returns the number of `key`; `isNew`: the key was not known.
    std::uint32_t of(std::uint32_t key, bool& isNew) {
        const auto [entry, isFirst] = numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size()));
        isNew = isFirst;
        return entry->second;
    }

private:
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

sim::Vec3 xyz(const sim::layout::vec4& v) {
    return {v.x, v.y, v.z};
}

const sim::layout::SkinVertex& vertexOf(const Drawn& drawn, const DrawnTriangle& triangle,
                                        std::size_t corner) {
    return (triangle.isOfSurface() ? drawn.vertices : drawn.skinVertices)[triangle.corners[corner]];
}

struct Piece {
    mesh::TriangleMesh mesh;
    Numbers numbers;

    void add(const Drawn& drawn, const DrawnTriangle& triangle, const std::array<std::uint32_t, 3>& points) {
        std::array<std::uint32_t, 3> own{};
        for (std::size_t n = 0; n < 3; ++n) {
            bool isNew = false;
            own[n] = numbers.of(points[n], isNew);
            if (isNew) mesh.positions.push_back(xyz(vertexOf(drawn, triangle, n).position));
        }
        mesh.triangles.push_back(own);
    }
};

/// Point names of a triangle's corners, for one skin. A sheet keeps vertex indices, since its sides are
/// apart.
std::array<std::uint32_t, 3> pointsOf(const sim::Skin& skin, std::uint32_t firstVertex, bool isSheet,
                                      const Drawn& drawn, const DrawnTriangle& triangle) {
    std::array<std::uint32_t, 3> points = triangle.corners;
    for (std::uint32_t& point : points) {
        if (triangle.isOfSurface())
            point = drawn.rest[point].point;
        else if (!isSheet)
            point = skin.particles.empty() ? SURFACE_SKIN | point
                                           : SURFACE_PARTICLE | skin.particles[point - firstVertex];
    }
    return points;
}

struct ShadedPiece {
    struct Shaded {
        mesh::ShadedPart part;
        Numbers numbers;
    };
    Shaded skin, beside, inside;

    void add(const Drawn& drawn, const DrawnTriangle& triangle) {
        Shaded& to = triangle.part == Part::inside ? inside : triangle.isOfSurface() ? beside : skin;
        std::array<std::uint32_t, 3> own{};
        for (std::size_t n = 0; n < 3; ++n) {
            bool isNew = false;
            own[n] = to.numbers.of(triangle.corners[n], isNew);
            if (!isNew) continue;
            const sim::layout::SkinVertex& vertex = vertexOf(drawn, triangle, n);
            to.part.positions.push_back(xyz(vertex.position));
            to.part.normals.push_back(xyz(vertex.normal));
        }
        to.part.triangles.push_back(own);
    }
};

std::string nameOf(const std::string& name, std::size_t piece, std::size_t pieces) {
    return pieces == 1 ? name : name + " " + std::to_string(piece + 1);
}

} // namespace

std::optional<std::vector<mesh::TriangleMesh>> cutMeshes(const sim::Scene& scene, std::size_t index,
                                                         const Drawn& drawn) {
    if (!isCut(index, drawn)) return std::nullopt;
    const sim::Skin& skin = scene.skins[index];
    const bool isSheet = index < drawn.pieceDraws.size() && drawn.pieceDraws[index].indexCount > 0;
    std::uint32_t firstVertex = 0;
    for (std::size_t s = 0; s < index; ++s)
        firstVertex += static_cast<std::uint32_t>(scene.skins[s].vertexCount());
    std::map<std::uint32_t, Piece> pieces;
    eachTriangle(scene, index, drawn, [&](const DrawnTriangle& triangle) {
        pieces[triangle.piece].add(drawn, triangle, pointsOf(skin, firstVertex, isSheet, drawn, triangle));
    });
    std::vector<mesh::TriangleMesh> meshes;
    for (auto& [name, piece] : pieces) {
        piece.mesh.name = nameOf(skin.name, meshes.size(), pieces.size());
        mesh::splitCrowdedEdges(piece.mesh);
        meshes.push_back(std::move(piece.mesh));
    }
    return meshes;
}

std::vector<mesh::ShadedMesh> shadedPieces(const sim::Scene& scene, std::size_t index, const Drawn& drawn) {
    const sim::Skin& skin = scene.skins[index];
    const bool isWhole = !isCut(index, drawn);
    std::map<std::uint32_t, ShadedPiece> pieces;
    eachTriangle(scene, index, drawn, [&](const DrawnTriangle& triangle) {
        pieces[isWhole ? 0 : triangle.piece].add(drawn, triangle);
    });
    std::vector<mesh::ShadedMesh> meshes;
    for (auto& [name, piece] : pieces) {
        piece.inside.part.isInside = true;
        meshes.push_back({.name = nameOf(skin.name, meshes.size(), pieces.size()),
                          .color = skin.color,
                          .parts = {std::move(piece.skin.part), std::move(piece.beside.part),
                                    std::move(piece.inside.part)}});
    }
    return meshes;
}

mesh::TriangleMesh joined(std::span<const mesh::TriangleMesh> pieces, const std::string& name) {
    mesh::TriangleMesh all{.name = name, .positions = {}, .triangles = {}};
    for (const mesh::TriangleMesh& piece : pieces) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), piece.positions.begin(), piece.positions.end());
        for (const auto& [a, b, c] : piece.triangles)
            all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
}

} // namespace sinew::tools
