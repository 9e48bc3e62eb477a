// The host side of skins: joined vertex and index buffers, and for every vertex the fan of triangles around
// it.
#include "sim/surface/skin.hpp"

#include "common/layout.h"
#include "kernels.hpp"
#include "sim/surface/texture_coordinates.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

struct Skins {
    const std::vector<Skin>& all;
    std::vector<BufferId> holders; // the particles or cells of their vertices
};

struct Fans {
    std::vector<layout::VertexTriangles> fans;
    std::vector<std::uint32_t> triangles;
};

// Limit of triangles around one vertex: more do not change its normal, and some devices silently end loops at
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

// The buffer of particles or cells that the vertices depend on.
BufferId uploadHolders(ProgramBuilder& program, const Skin& skin) {
    if (!skin.particles.empty()) return program.upload(skin.name + ".particles", skin.particles);
    std::vector<layout::CellVertex> items;
    for (const CellEmbedding& cell : skin.cells) {
        layout::CellVertex& item = items.emplace_back();
        item.weights = {cell.weights.x, cell.weights.y, cell.weights.z, 0};
        std::copy(cell.particles.begin(), cell.particles.end(), item.corners);
    }
    return program.upload(skin.name + ".cells", items);
}

// The first `count` vertices of every skin.
template <typename Count> void addVertices(ProgramBuilder& program, const Skins& skins, const Count& count) {
    const StepProgram& built = program.program();
    std::uint32_t firstVertex = 0;
    for (std::size_t s = 0; s < skins.all.size(); ++s) {
        const Skin& skin = skins.all[s];
        if (skin.vertexCount() == 0) continue;
        const layout::SkinPush push{count(skin), firstVertex};
        const vk::ShaderCode& ofCells = k::skinCells;
        program.dispatch(skin.particles.empty() ? ofCells : k::skinParticles, push.count,
                         {built.positions, skins.holders[s], built.skinVertices}, push);
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
}

const std::vector<std::array<std::uint32_t, 3>>& wholeTriangles(const Skin& skin) {
    return skin.wholeTriangles.empty() ? skin.triangles : skin.wholeTriangles;
}

// Number of vertices up to the last one of its whole triangles.
std::uint32_t wholeVertices(const Skin& skin) {
    if (skin.wholeTriangles.empty()) return static_cast<std::uint32_t>(skin.vertexCount());
    std::uint32_t last = 0;
    for (const auto& triangle : skin.wholeTriangles) last = std::max(last, std::ranges::max(triangle));
    return last + 1;
}

template <typename Triangles>
std::vector<std::uint32_t> join(const std::vector<Skin>& skins, const Triangles& trianglesOf) {
    std::vector<std::uint32_t> indices;
    std::uint32_t firstVertex = 0;
    for (const Skin& skin : skins) {
        for (const auto& triangle : trianglesOf(skin))
            for (const std::uint32_t corner : triangle) indices.push_back(firstVertex + corner);
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
    return indices;
}

// Skins that are raised to the contact surface of their body, by vertex of all skins.
struct Raised {
    std::vector<layout::VertexTriangles> meeting; // entries of `copies`: vertices at the same particle
    std::vector<std::uint32_t> copies;
    std::vector<float> heights; // [m]; 0 = the vertex stays
};

// The distance from particles to the surface where a body of faces of cells touches others [m]. A body that
// may be cut is drawn through its particles, as the surface of its cuts is.
float raisedBy(const Scene& scene, const Skin& skin) {
    if (skin.particles.empty()) return 0;
    const std::uint32_t first = skin.particles.front();
    const auto holds = [&](const Body& body) { return first - body.firstParticle < body.particleCount; };
    const auto body = std::ranges::find_if(scene.bodies, holds);
    if (body == scene.bodies.end() || body->restVolume == 0) return 0;
    const auto isCut = [&](const Grid& grid) {
        return grid.isCuttable && first - grid.firstParticle < grid.node.size();
    };
    return std::ranges::any_of(scene.grids, isCut) ? 0 : scene.particles[first].radius;
}

void raise(Raised& raised, const Skin& skin, float height) {
    const auto firstVertex = static_cast<std::uint32_t>(raised.heights.size());
    raised.heights.resize(firstVertex + skin.vertexCount(), height);
    raised.meeting.resize(raised.heights.size());
    if (height == 0) return;
    std::map<std::uint32_t, std::vector<std::uint32_t>> at; // by particle
    for (std::uint32_t v = 0; v < skin.particles.size(); ++v)
        at[skin.particles[v]].push_back(firstVertex + v);
    for (const auto& [particle, vertices] : at) {
        const auto first = static_cast<std::uint32_t>(raised.copies.size());
        for (const std::uint32_t vertex : vertices)
            raised.meeting[vertex] = {first, static_cast<std::uint32_t>(vertices.size())};
        raised.copies.insert(raised.copies.end(), vertices.begin(), vertices.end());
    }
}

Raised readRaised(const Scene& scene) {
    Raised raised;
    for (const Skin& skin : scene.skins) raise(raised, skin, raisedBy(scene, skin));
    return raised;
}

// Appends the pass that raises vertices, to each list that computes them; none if no skin is raised.
void addRaised(ProgramBuilder& program, const Scene& scene) {
    const Raised raised = readRaised(scene);
    if (raised.copies.empty()) return;
    const std::vector<BufferId> buffers{
        program.program().skinVertices, program.upload("skin.meeting", raised.meeting),
        program.upload("skin.copies", raised.copies), program.upload("skin.heights", raised.heights)};
    const auto count = static_cast<std::uint32_t>(raised.heights.size());
    for (const List list : {List::skin, List::wholeSkin})
        if (!program.program()[list].empty())
            program.into(
                list, [&] { program.dispatch(k::raiseVertices, count, buffers, layout::CountPush{count}); });
}

// Keeps the vertices of the skins recorded before.
void addPrevious(ProgramBuilder& program) {
    const StepProgram& built = program.program();
    if (built.previousSkinVertices != BufferId{})
        program.copy(built.skinVertices, built.previousSkinVertices);
}

// Appends the skins as drawn while nothing is cut.
void addWholeSkins(ProgramBuilder& program, const Skins& skins) {
    const auto isSplit = [](const Skin& skin) { return !skin.wholeTriangles.empty(); };
    if (std::ranges::none_of(skins.all, isSplit)) return;
    program.beginPhase("whole skin");
    const std::vector<std::uint32_t> indices = join(skins.all, wholeTriangles);
    const std::uint32_t vertexCount = std::ranges::max(indices) + 1;
    program.program().wholeIndices = program.upload("skin.whole_indices", indices);
    addWholeTextureCoordinates(program, skins.all);
    program.into(List::wholeSkin, [&] {
        addPrevious(program);
        addVertices(program, skins, wholeVertices);
        addNormals(program, program.program().wholeIndices,
                   uploadFans(program, indices, vertexCount, "skin.whole"), {vertexCount, vertexCount});
    });
}

std::uint32_t allVertices(const Skin& skin) {
    return static_cast<std::uint32_t>(skin.vertexCount());
}

} // namespace

VertexFans uploadFans(ProgramBuilder& program, const std::vector<std::uint32_t>& indices,
                      std::uint32_t vertexCount, const std::string& name) {
    const Fans fans = fansOf(indices, vertexCount);
    return {program.upload(name + ".fans", fans.fans),
            program.upload(name + ".triangles_of_vertex", fans.triangles)};
}

std::vector<std::uint32_t> joinIndices(const std::vector<Skin>& skins) {
    return join(
        skins, [](const Skin& skin) -> const auto& { return skin.triangles; });
}

void addNormals(ProgramBuilder& program, BufferId indices, const VertexFans& fans,
                const layout::WholePush& push, const WholeVertices& wholes) {
    constexpr std::uint32_t isOfWholesId = 1; // constant_id in skin_normals.comp
    program.dispatch(
        k::skinNormals, push.count,
        {program.program().skinVertices, indices, fans.fans, fans.triangles, wholes.hung, wholes.marks}, push,
        {{isOfWholesId, wholes.hung != unbound}});
}

void addSkins(Build& build) {
    ProgramBuilder& program = build.program;
    const std::vector<Skin>& skins = build.model.scene.skins;
    StepProgram& built = program.program();
    std::uint32_t vertexCount = 0;
    for (const Skin& skin : skins) vertexCount += allVertices(skin);
    const std::vector<std::uint32_t> indices = joinIndices(skins);
    if (vertexCount == 0 || indices.empty()) return;

    program.beginPhase("skin");
    built.skinVertices =
        program.scratch<layout::SkinVertex>("skin.vertices", vertexCount + built.pieceVertices);
    if (built.skinIndices == BufferId{}) built.skinIndices = program.upload("skin.indices", indices);
    addTextureCoordinates(program, skins, Coordinates::fixed);
    Skins all{skins, {}};
    for (const Skin& skin : skins)
        all.holders.push_back(skin.vertexCount() > 0 ? uploadHolders(program, skin) : BufferId{});
    if (build.model.settings.keepsPrevious)
        built.previousSkinVertices = program.scratch<layout::SkinVertex>(
            "skin.previous_vertices", program.program().buffers[built.skinVertices.index].count);
    program.into(List::skin, [&] {
        addPrevious(program);
        addVertices(program, all, allVertices);
        build.add(&Feature::skinNormals);
        addNormals(program, built.skinIndices, uploadFans(program, indices, vertexCount, "skin"),
                   {vertexCount, vertexCount});
        build.add(&Feature::skinEnd);
    });
    addWholeSkins(program, all);
    addRaised(program, build.model.scene);
}

} // namespace sinew::sim::surface
