// The buffers of the pieces of sheets, and the order of their passes.
#include "sim/surface/sheet_pieces.hpp"

#include "kernels.hpp"
#include "sim/lattice/placement.hpp"
#include "sim/surface/skin.hpp"
#include "sim/surface/texture_coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

using Nodes = std::array<std::array<std::uint32_t, 3>, 3>; // of the corners of a triangle

// The corners of a triangle in the order of the skin, relative to a node of the cell: bit 0 x, bit 1 z.
std::optional<std::array<std::uint32_t, 3>> cornersOf(const Nodes& nodes, std::uint32_t x, std::uint32_t z) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t n = 0; n < 3; ++n) {
        const std::uint32_t right = nodes[n][0] - x, down = nodes[n][2] - z;
        if (right > 1 || down > 1) return std::nullopt;
        corners[n] = right | down << 1;
    }
    return corners;
}

// The kind of a triangle with these corners.
std::optional<std::uint32_t> kindOf(std::array<std::uint32_t, 3> corners) {
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    constexpr std::array<std::array<std::uint32_t, 3>, 4> kinds{{{0, 2, 3}, {0, 3, 1}, {0, 3, 2}, {0, 1, 3}}};
    const auto found = std::ranges::find(kinds, corners);
    if (found == kinds.end()) return std::nullopt;
    return static_cast<std::uint32_t>(found - kinds.begin());
}

// Nodes of the corners of a triangle; none if one is not of this grid.
std::optional<Nodes> nodesOf(const Skin& skin, const Grid& grid,
                             const std::array<std::uint32_t, 3>& corners) {
    Nodes nodes;
    for (std::size_t n = 0; n < 3; ++n) {
        const std::uint32_t index = skin.particles[corners[n]] - grid.firstParticle;
        if (index >= grid.node.size()) return std::nullopt;
        nodes[n] = lattice::coordinates(grid, grid.node[index]);
    }
    return nodes;
}

std::uint32_t lowest(const Nodes& nodes, std::size_t axis) {
    return std::min({nodes[0][axis], nodes[1][axis], nodes[2][axis]});
}

// Texture coordinates of the halves of cells that a skin consists of.
std::vector<layout::TexturedHalf> texturedHalves(const Skin& skin, const Grid& grid,
                                                 const std::vector<layout::SheetTriangle>& triangles) {
    std::vector<layout::TexturedHalf> halves(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Nodes nodes = *nodesOf(skin, grid, skin.triangles[t]);
        const auto corners = *cornersOf(nodes, lowest(nodes, 0), lowest(nodes, 2));
        constexpr std::array<std::array<std::uint32_t, 3>, 2> orders{{{0, 2, 3}, {0, 3, 1}}};
        const auto& order = orders[triangles[t].kind & 1];
        for (std::size_t n = 0; n < 3; ++n) {
            const TexturePoint& at = skin.textureCoordinates[t][n];
            const auto place = static_cast<std::size_t>(std::ranges::find(order, corners[n]) - order.begin());
            halves[t].at[2 * place] = at.u;
            halves[t].at[2 * place + 1] = at.v;
        }
    }
    return halves;
}

// Triangles of a few dozen cuts from end to end, or `least`, but no more than with every triangle of the
// sheet shattered: capacity that another sheet needs is not wasted on this one.
std::uint32_t roomFor(std::size_t triangles, std::uint32_t least) {
    constexpr double ofTriangle = 6, few = 4096, ofRow = 200;
    const auto all = static_cast<double>(triangles);
    const double wanted = std::max(few + ofRow * std::sqrt(all), static_cast<double>(least));
    return static_cast<std::uint32_t>(std::min(ofTriangle * all, wanted));
}

// The vector between neighbouring nodes of a sheet along an axis, at initial positions.
layout::vec4 stepAlong(const Scene& scene, const Grid& grid, std::uint32_t axis) {
    for (std::uint32_t i = 0; i < grid.node.size(); ++i) {
        auto next = lattice::coordinates(grid, grid.node[i]);
        if (++next[axis] >= grid.nodes[axis]) continue;
        const auto at = std::ranges::lower_bound(grid.node, next[0] + grid.nodes[0] * next[2]);
        if (at == grid.node.end() || *at != next[0] + grid.nodes[0] * next[2]) continue;
        const Vec3 &from = scene.particles[grid.firstParticle + i].position,
                   &to =
                       scene.particles[grid.firstParticle + static_cast<std::size_t>(at - grid.node.begin())]
                           .position;
        return {to.x - from.x, to.y - from.y, to.z - from.z, 0};
    }
    return {axis == 0 ? grid.restLength[0] : 0, 0, axis == 0 ? 0 : grid.restLength[0], 0};
}

// Slots of a sheet's nodes.
struct Place {
    std::uint32_t origin = 0, sliceStride = 0;
};

Place placeOf(const Grid& grid, const CutRun& run, const StateLayout& layout) {
    const auto first = lattice::coordinates(grid, grid.node[0]);
    return {layout.slot[grid.firstParticle] - first[0] - run.sliceStride * first[2], run.sliceStride};
}

// The run that a cuttable sheet belongs to.
const CutRun* runOf(const StepProgram& program, const Grid& grid, const StateLayout& layout) {
    if (!grid.isCuttable || !lattice::isSheet(grid)) return nullptr;
    const std::uint32_t slot = layout.slot[grid.firstParticle];
    for (const CutRun& run : program.cutting.runs)
        if (slot >= run.first && slot - run.first < run.count) return &run;
    return nullptr;
}

// First free element after all skins and the pieces of previous ones.
struct Room {
    std::uint32_t index = 0, vertex = 0;
};

void addSkin(ProgramBuilder& program, SheetPieces& pieces, const Skin& skin, SheetSkin sheet,
             const std::vector<layout::SheetTriangle>& triangles, Room& room) {
    sheet.push.triangles = static_cast<std::uint32_t>(triangles.size());
    sheet.push.firstPiece = room.index;
    sheet.push.room = roomFor(triangles.size(), pieces.leastRoom);
    sheet.push.firstVertex = room.vertex;
    sheet.push.vertexRoom =
        (7 * sheet.push.room + 2) / 3; // a triangle in three pieces has 7, the most for one
    sheet.skinPush.firstVertex = sheet.push.firstVertex;
    sheet.skinPush.vertexRoom = sheet.push.vertexRoom;
    sheet.skinPush.sliceStride = sheet.push.sliceStride;
    sheet.triangles = program.upload(skin.name + ".halves", triangles);
    sheet.counts = program.scratch<layout::SheetCounts>(skin.name + ".pieces.starts", triangles.size());
    sheet.state = program.scratch<layout::SheetState>(skin.name + ".pieces.state", 1);
    sheet.vertices =
        program.scratch<layout::SheetVertex>(skin.name + ".pieces.vertices", sheet.push.vertexRoom);
    room.index += 3 * sheet.push.room;
    room.vertex += sheet.push.vertexRoom;
    program.program().pieceSkins.push_back({sheet.vertices, sheet.skinPush.firstVertex});
    pieces.skins.push_back(sheet);
}

void findSkins(ProgramBuilder& program, const Scene& scene, const StateLayout& layout, SheetPieces& pieces,
               Room& room) {
    std::uint32_t firstIndex = 0;
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s) {
        const Skin& skin = scene.skins[s];
        for (const Grid& grid : scene.grids) {
            const CutRun* run = runOf(program.program(), grid, layout);
            if (run == nullptr) continue;
            const Place place = placeOf(grid, *run, layout);
            const auto triangles = sheetTriangles(skin, grid, place.origin, place.sliceStride);
            if (!triangles) continue;
            SheetSkin sheet;
            if (!skin.textureCoordinates.empty())
                sheet.textured =
                    program.upload(skin.name + ".textured", texturedHalves(skin, grid, *triangles));
            sheet.push.firstIndex = firstIndex;
            sheet.push.firstSlot = place.origin;
            sheet.push.sliceStride = place.sliceStride;
            sheet.push.skin = s;
            sheet.skinPush.right = stepAlong(scene, grid, 0);
            sheet.skinPush.down = stepAlong(scene, grid, 2);
            addSkin(program, pieces, skin, sheet, *triangles, room);
            break;
        }
        firstIndex += static_cast<std::uint32_t>(3 * skin.triangles.size());
    }
}

} // namespace

std::optional<std::vector<layout::SheetTriangle>>
sheetTriangles(const Skin& skin, const Grid& grid, std::uint32_t slot, std::uint32_t sliceStride) {
    if (skin.particles.empty() || skin.triangles.empty()) return std::nullopt;
    std::vector<layout::SheetTriangle> triangles;
    for (const auto& corners : skin.triangles) {
        const auto nodes = nodesOf(skin, grid, corners);
        if (!nodes) return std::nullopt;
        const std::uint32_t x = lowest(*nodes, 0), z = lowest(*nodes, 2);
        const auto places = cornersOf(*nodes, x, z);
        const auto kind = places ? kindOf(*places) : std::nullopt;
        if (!kind) return std::nullopt;
        triangles.push_back({slot + x + sliceStride * z, *kind});
    }
    return triangles;
}

std::shared_ptr<SheetPieces> addSheetPieces(ProgramBuilder& program, const Scene& scene,
                                            const StateLayout& layout, BufferId particles,
                                            std::uint32_t leastRoom) {
    auto pieces = std::make_shared<SheetPieces>();
    pieces->leastRoom = leastRoom;
    std::vector<std::uint32_t> indices = joinIndices(scene.skins);
    std::uint32_t vertices = 0;
    for (const Skin& skin : scene.skins) vertices += static_cast<std::uint32_t>(skin.vertexCount());
    Room room{static_cast<std::uint32_t>(indices.size()), vertices};
    findSkins(program, scene, layout, *pieces, room);
    if (pieces->skins.empty()) return nullptr;
    StepProgram& built = program.program();
    pieces->particles = particles;
    pieces->allIndices = program.upload("skin.all_indices", indices);
    indices.resize(room.index, 0);
    built.skinIndices = program.upload("skin.indices", indices);
    addTextureCoordinates(program, scene.skins, Coordinates::changing, room.index);
    built.pieceVertices = room.vertex - vertices;
    built.pieceDraws = program.scratch<layout::DrawArguments>("skin.piece_draws", scene.skins.size());
    pieces->arguments =
        program.scratch<layout::DispatchArguments>("skin.piece_arguments", 2 * scene.skins.size());
    std::vector<BufferId> topology{built.skinIndices, built.pieceDraws, pieces->arguments};
    for (const SheetSkin& skin : pieces->skins) {
        topology.insert(topology.end(), {skin.state, skin.vertices});
        built.sheetStates.push_back(skin.state);
    }
    for (const BufferId buffer : topology) {
        built.cutting.topology.push_back(buffer);
        program.addToState(buffer, buffer);
    }
    return pieces;
}

void addSheetDrawing(ProgramBuilder& program, const SheetPieces& pieces) {
    const StepProgram& built = program.program();
    for (const SheetSkin& skin : pieces.skins)
        program.dispatchIndirect(k::placeSheetPieces,
                                 {pieces.arguments, 2 * skin.push.skin + 1, skin.push.vertexRoom},
                                 {skin.state, skin.vertices, built.cutting.links, pieces.particles,
                                  built.positions, built.skinVertices},
                                 skin.skinPush);
}

void addSheetPasses(ProgramBuilder& program, const SheetPieces& pieces, bool isFirst) {
    const StepProgram& built = program.program();
    for (const SheetSkin& skin : pieces.skins) {
        layout::SheetPush push = skin.push;
        push.isFirst = isFirst ? 1 : 0;
        isFirst = false;
        program.dispatch(k::countSheet, push.triangles, {built.cutting.links, skin.triangles, skin.counts},
                         push);
        program.dispatch(k::scanSheet, GROUP_ITEMS,
                         {skin.counts, skin.state, built.pieceDraws, pieces.arguments, built.cutting.counts},
                         push);
        program.dispatchIndirect(k::writeSheet, {pieces.arguments, 2 * push.skin, push.triangles},
                                 {built.cutting.links, built.cutting.hits, skin.triangles, skin.counts,
                                  skin.state, pieces.allIndices, built.skinIndices, skin.vertices},
                                 push);
        if (skin.textured != BufferId{})
            program.dispatchIndirect(k::writeSheetTextures, {pieces.arguments, 2 * push.skin, push.triangles},
                                     {built.cutting.links, built.cutting.hits, skin.triangles, skin.counts,
                                      skin.state, skin.textured, built.textureCoordinates},
                                     push);
    }
}

} // namespace sinew::sim::surface
