// The host side of skins: joined vertex and index buffers, and for every vertex the fan of triangles around
// it.
#include "sim/surface/skin.hpp"

#include "kernels.hpp"
#include "layout.h"

#include <algorithm>

namespace sinew::sim::surface {

namespace {

struct Fans {
    std::vector<layout::VertexTriangles> fans;
    std::vector<std::uint32_t> triangles;
};

// More triangles than this around one vertex change its normal no more; some devices end loops silently at
// 65,535.
constexpr std::uint32_t largestFan = 60'000;

Fans fansOf(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    Fans result{std::vector<layout::VertexTriangles>(vertices), std::vector<std::uint32_t>(indices.size())};
    for (const std::uint32_t vertex : indices) ++result.fans[vertex].count;
    std::uint32_t first = 0;
    for (layout::VertexTriangles& fan : result.fans) {
        fan.first = first;
        first += fan.count;
        fan.count = 0;
    }
    for (std::uint32_t i = 0; i < indices.size(); ++i) {
        layout::VertexTriangles& fan = result.fans[indices[i]];
        result.triangles[fan.first + fan.count++] = i / 3;
    }
    for (layout::VertexTriangles& fan : result.fans) fan.count = std::min(fan.count, largestFan);
    return result;
}

void addVertices(ProgramBuilder& program, const Skin& skin, BufferId positions, BufferId vertices,
                 std::uint32_t firstVertex) {
    const layout::SkinPush push{static_cast<std::uint32_t>(skin.vertexCount()), firstVertex};
    if (!skin.particles.empty()) {
        const BufferId particles = program.upload(skin.name + ".particles", skin.particles);
        program.dispatch(kernels::skinParticles, push.count, {positions, particles, vertices}, push);
        return;
    }
    std::vector<layout::CellVertex> items;
    for (const CellEmbedding& cell : skin.cells) {
        layout::CellVertex& item = items.emplace_back();
        item.weights = {cell.weights.x, cell.weights.y, cell.weights.z, 0};
        std::copy(cell.particles.begin(), cell.particles.end(), item.corners);
    }
    const BufferId cells = program.upload(skin.name + ".cells", items);
    program.dispatch(kernels::skinCells, push.count, {positions, cells, vertices}, push);
}

} // namespace

std::vector<std::uint32_t> joinIndices(const std::vector<Skin>& skins) {
    std::vector<std::uint32_t> indices;
    std::uint32_t firstVertex = 0;
    for (const Skin& skin : skins) {
        for (const auto& triangle : skin.triangles) {
            for (const std::uint32_t corner : triangle) indices.push_back(firstVertex + corner);
        }
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
    return indices;
}

void addSkins(ProgramBuilder& program, const std::vector<Skin>& skins) {
    StepProgram& built = program.program();
    std::uint32_t vertexCount = 0;
    for (const Skin& skin : skins) vertexCount += static_cast<std::uint32_t>(skin.vertexCount());
    const std::vector<std::uint32_t> indices = joinIndices(skins);
    if (vertexCount == 0 || indices.empty()) return;

    program.beginSkin();
    program.beginPhase("skin");
    built.skinVertices =
        program.scratch<layout::SkinVertex>("skin.vertices", vertexCount + built.pieceVertices);
    if (built.skinIndices == BufferId{}) built.skinIndices = program.upload("skin.indices", indices);
    std::uint32_t firstVertex = 0;
    for (const Skin& skin : skins) {
        if (skin.vertexCount() == 0) continue;
        addVertices(program, skin, built.positions, built.skinVertices, firstVertex);
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
    for (const auto& addMore : program.skinMiddles()) addMore();
    const Fans fans = fansOf(indices, vertexCount);
    const BufferId fanBuffer = program.upload("skin.fans", fans.fans);
    const BufferId triangles = program.upload("skin.triangles_of_vertex", fans.triangles);
    program.dispatch(kernels::skinNormals, vertexCount,
                     {built.skinVertices, built.skinIndices, fanBuffer, triangles},
                     layout::CountPush{vertexCount});
    for (const auto& addMore : program.skinEndings()) addMore();
}

} // namespace sinew::sim::surface
