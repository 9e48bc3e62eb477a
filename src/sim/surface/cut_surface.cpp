// The buffers of the surface of cuts, and the order of its passes.
#include "sim/surface/cut_surface.hpp"

#include "kernels.hpp"
#include "sim/surface/hung_surface.hpp"
#include "sim/surface/skin.hpp"
#include "sim/surface/split_normals.hpp"
#include "sim/surface/texture_coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

// Triangles of several cuts through the whole body, or of every cell shattered, if that is less. A triangle
// of a mesh's skin beside a cut has up to nine vertices; one in twenty is assumed to be beside a cut.
std::uint32_t roomFor(const CutBodies& bodies) {
    constexpr double ofCell = 200, ofLayer = 240, few = 65536, ofPrism = 0.5;
    const double inside = std::min(ofCell * bodies.cells, few + ofLayer * std::pow(bodies.cells, 2.0 / 3.0));
    const double some = inside + ofPrism * static_cast<double>(bodies.prisms.size());
    return std::max(static_cast<std::uint32_t>(some), bodies.room);
}

std::uint32_t chunksFor(std::size_t items) {
    return static_cast<std::uint32_t>((items + SURFACE_CHUNK - 1) / SURFACE_CHUNK);
}

void addItems(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies) {
    const std::size_t slots = bodies.rest.size(), items = std::size_t{SURFACE_CHUNK} * surface.push.chunks;
    surface.partitions = program.scratch<std::uint32_t>("surface.partitions", slots);
    surface.near = program.scratch<std::uint32_t>("surface.near", slots);
    surface.owned = program.scratch<std::array<std::uint32_t, 4>>("surface.owned", items);
    surface.counts = program.scratch<layout::SurfaceCounts>("surface.counts", items);
    surface.slots = static_cast<std::uint32_t>(slots);
    surface.items = static_cast<std::uint32_t>(items);
    surface.listed = program.scratch<std::uint32_t>("surface.listed", items + 1);
    surface.starts = program.scratch<std::array<std::uint32_t, 2>>("surface.starts", items);
    surface.sums = program.scratch<std::array<std::uint32_t, 4>>("surface.sums", surface.push.chunks);
    surface.complex = program.upload("surface.complex", bodies.complex);
    surface.rest = surface.bladeRest = program.upload("surface.rest", bodies.rest);
    surface.gradients = program.scratch<layout::Gradient>("surface.gradients", slots);
}

// Appends a dispatch over the slots of every run that have a part of the surface.
void addListed(ProgramBuilder& program, const CutSurface& surface, const vk::ShaderCode& code,
               std::initializer_list<BufferId> buffers) {
    for (const layout::CutPush& run : surface.source.runs)
        program.dispatchIndirect(code, {surface.arguments, surface.push.runs + SURFACE_LISTED, surface.items},
                                 buffers, run);
}

// Appends a dispatch over the slots of every run near a cut.
void addRuns(ProgramBuilder& program, const CutSurface& surface, const vk::ShaderCode& code,
             std::initializer_list<BufferId> buffers) {
    const CutSource& source = surface.source;
    for (std::uint32_t r = 0; r < source.runs.size(); ++r)
        program.dispatchIndirect(code, {source.arguments, source.firstArgument + r, source.runs[r].count},
                                 buffers, source.runs[r]);
}

void addGradients(ProgramBuilder& program, const CutSurface& surface) {
    const CutSource& source = surface.source;
    const StepProgram& built = program.program();
    for (std::uint32_t r = 0; r < source.runs.size(); ++r)
        program.dispatchIndirect(k::findGradients, {surface.arguments, r, source.runs[r].count},
                                 {surface.near, built.cutting.links, surface.rest, source.particles,
                                  built.positions, surface.gradients},
                                 source.runs[r]);
}

// Appends the passes that rewrite the whole surface from the state of cells.
void addRewriting(ProgramBuilder& program, const CutSurface& surface, BufferId blade) {
    const CuttingBuffers& cutting = program.program().cutting;
    const CutSurfaceBuffers& drawn = program.program().cutSurface;
    const BufferId complex = surface.complex, partitions = surface.partitions, owned = surface.owned;
    const layout::CountPush chunks{surface.push.chunks};
    program.dispatch(k::sumSurface, chunks.count, {surface.counts, surface.sums}, chunks);
    program.dispatch(k::scanSurface, GROUP_ITEMS,
                     {surface.sums, surface.arguments, drawn.draws, drawn.state, surface.source.groups,
                      cutting.counts, surface.listed, blade},
                     surface.push);
    program.dispatch(k::startSurface, chunks.count,
                     {surface.counts, surface.sums, owned, surface.starts, surface.listed}, chunks);
    const BufferId listed = surface.listed;
    addListed(program, surface, k::writePoints,
              {listed, owned, partitions, cutting.hits, surface.bladeRest, drawn.rest});
    addRimPoints(program, surface);
    addListed(program, surface, k::writeInside,
              {complex, partitions, owned, listed, surface.starts, drawn.rest, drawn.indices, cutting.links});
    addListed(program, surface, k::writeOutside,
              {complex, partitions, owned, listed, surface.starts, drawn.state, surface.rest, drawn.rest,
               drawn.indices, surface.source.particles});
    addPrismTriangles(program, surface);
    addTexturePasses(program, surface);
    addWholeMarks(program, surface);
    const layout::CountPush faces{surface.faces};
    program.dispatch(
        k::hideFaces, faces.count,
        {surface.counts, drawn.state, surface.skinFaces, surface.allIndices, program.program().skinIndices},
        faces);
}

} // namespace

std::shared_ptr<CutSurface> addCutSurface(ProgramBuilder& program, const Scene& scene, CutBodies bodies,
                                          const CutSource& source) {
    auto surface = std::make_shared<CutSurface>();
    surface->source = source;
    surface->skins = bodies.skins;
    surface->push = {.chunks = chunksFor(bodies.rest.size() + bodies.prisms.size()),
                     .room = roomFor(bodies),
                     .runs = static_cast<std::uint32_t>(source.runs.size()),
                     .hung = static_cast<std::uint32_t>(bodies.vertices.size())};
    surface->faces = static_cast<std::uint32_t>(bodies.faces.size());
    addItems(program, *surface, bodies);
    const std::uint32_t room = surface->push.room;
    StepProgram& built = program.program();
    CutSurfaceBuffers& drawn = built.cutSurface;
    drawn.state = program.scratch<layout::SurfaceState>("surface.state", 1);
    drawn.rest = program.scratch<layout::CutVertex>("surface.rest_vertices", room);
    drawn.vertices = program.scratch<layout::SkinVertex>("surface.vertices", room);
    surface->turns = program.scratch<layout::Gradient>("surface.turns", room);
    drawn.indices = program.scratch<std::uint32_t>("surface.indices", 3 * std::uint64_t{room});
    drawn.draws = program.scratch<layout::DrawArguments>("surface.draws", 2);
    drawn.particles = surface->source.particles;
    surface->arguments = program.scratch<layout::DispatchArguments>("surface.arguments",
                                                                    surface->push.runs + SURFACE_ARGUMENTS);
    addSplitNormals(program, *surface, bodies);
    surface->skinFaces = program.upload("surface.skin_faces", bodies.faces);
    surface->allIndices = program.upload("surface.all_indices", joinIndices(scene.skins));
    const bool hasPieces = built.skinIndices != BufferId{}; // of sheets: then they are in the topology
    if (!hasPieces) built.skinIndices = program.upload("skin.indices", joinIndices(scene.skins));
    for (const BufferId buffer :
         {surface->partitions, surface->near, surface->owned, surface->counts, surface->starts, drawn.state,
          drawn.rest, drawn.indices, drawn.draws, surface->arguments, built.skinIndices}) {
        if (hasPieces && buffer == built.skinIndices) continue;
        built.cutting.topology.push_back(buffer);
        program.addToState(buffer, buffer);
    }
    addHungBuffers(program, *surface, bodies);
    addTextureBuffers(program, scene.skins, *surface, bodies);
    return surface;
}

void addNormalsOfCuts(ProgramBuilder& program, const CutSurface& surface) {
    if (surface.hung.prismCount == 0) return;
    addGradients(program, surface);
    addSplitVertices(program, surface);
}

void addCutDrawing(ProgramBuilder& program, const CutSurface& surface) {
    const StepProgram& built = program.program();
    const CutSurfaceBuffers drawn = built.cutSurface;
    if (surface.hung.prismCount == 0) addGradients(program, surface);
    addWholeNormals(program, surface);
    addRimNormals(program, surface);
    addPartNormals(program, surface);
    const IndirectItems points{surface.arguments, surface.push.runs + SURFACE_POINTS, surface.push.room};
    const IndirectItems outside{surface.arguments, surface.push.runs + SURFACE_OUTSIDE, surface.push.room};
    const layout::CountPush room{surface.push.room};
    std::vector<BufferId> buffers{
        drawn.state,       built.cutting.links, surface.rest, surface.source.particles, built.positions,
        surface.gradients, surface.near,        drawn.rest,   drawn.vertices,           surface.turns};
    const bool hasHung = surface.hung.prismCount > 0;
    for (const BufferId buffer :
         {built.skinVertices, surface.hung.vertices, surface.hung.moved, surface.hung.grids})
        buffers.push_back(boundIf(hasHung, buffer));
    constexpr std::uint32_t hasHungId = 1; // constant_id in place_cut_points.comp
    program.dispatchIndirect(k::placeCutPoints, points, buffers, room, {{hasHungId, hasHung}});
    program.dispatchIndirect(k::placePieceCorners, outside,
                             {drawn.state, drawn.rest, built.positions, surface.gradients, drawn.vertices,
                              built.skinVertices, surface.turns},
                             room);
}

void addCutSurfacePasses(ProgramBuilder& program, const CutSurface& surface, BufferId blade) {
    const CuttingBuffers& cutting = program.program().cutting;
    const BufferId complex = surface.complex, partitions = surface.partitions, owned = surface.owned;
    addRuns(program, surface, k::partitionTetrahedra,
            {cutting.links, complex, cutting.listedCounts, partitions, surface.near, cutting.listed});
    addRuns(program, surface, k::markPoints,
            {cutting.links, complex, cutting.listedCounts, partitions, owned, cutting.listed});
    addRuns(
        program, surface, k::countSurface,
        {complex, cutting.listedCounts, partitions, owned, surface.counts, cutting.links, cutting.listed});
    addPrismParting(program, surface);
    program.only(When::surface, [&] { addRewriting(program, surface, blade); });
}

} // namespace sinew::sim::surface
