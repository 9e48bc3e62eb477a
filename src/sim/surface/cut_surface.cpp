// The buffers and the order of the passes of the surface of cuts.
#include "sim/surface/cut_surface.hpp"

#include "kernels.hpp"
#include "sim/lattice/batches.hpp"
#include "sim/surface/lattice_faces.hpp"
#include "sim/surface/skin.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

// What is known of the bodies before anything is built.
struct Bodies {
    std::vector<layout::SkinFace> faces;
    std::vector<layout::vec4> rest; // by slot; w = index of the skin
    double cells = 0;
};

void addBody(Bodies& bodies, const Scene& scene, const Grid& grid, const StateLayout& layout,
             std::size_t skin) {
    for (std::uint32_t i = grid.firstParticle; i < grid.firstParticle + grid.node.size(); ++i) {
        const Vec3& x = scene.particles[i].position;
        bodies.rest[layout.slot[i]] = {x.x, x.y, x.z, static_cast<float>(skin)};
    }
    bodies.cells +=
        static_cast<double>(std::ranges::count_if(grid.fill, [](std::uint8_t fill) { return fill > 0; }));
}

Bodies readBodies(const Scene& scene, const Settings& settings, const StateLayout& layout) {
    Bodies bodies{.faces = {}, .rest = std::vector<layout::vec4>(layout.count)};
    const std::vector<std::uint32_t> grids = lattice::computedGrids(scene, settings);
    const std::vector<lattice::Box> boxes = lattice::boxesOf(scene, grids);
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        if (!grid.isCuttable) continue;
        std::uint32_t first = 0;
        for (std::size_t s = 0; s < scene.skins.size(); ++s) {
            const auto faces = latticeFaces(scene.skins[s], grid, boxes[g], first);
            first += static_cast<std::uint32_t>(scene.skins[s].triangles.size());
            if (!faces) continue;
            bodies.faces.insert(bodies.faces.end(), faces->begin(), faces->end());
            addBody(bodies, scene, grid, layout, s);
        }
    }
    return bodies;
}

// Triangles: all that some cuts through the whole body make, or every cell shattered, if that is less.
std::uint32_t roomFor(double cells) {
    constexpr double ofCell = 200, ofLayer = 240, few = 65536;
    return static_cast<std::uint32_t>(std::min(ofCell * cells, few + ofLayer * std::pow(cells, 2.0 / 3.0)));
}

void addSlots(ProgramBuilder& program, CutSurface& surface, const Bodies& bodies) {
    const std::size_t slots = bodies.rest.size();
    surface.partitions = program.scratch<std::uint32_t>("surface.partitions", slots);
    surface.near = program.scratch<std::uint32_t>("surface.near", slots);
    surface.owned = program.scratch<std::array<std::uint32_t, 4>>("surface.owned", slots);
    surface.counts = program.scratch<layout::SurfaceCounts>("surface.counts", slots);
    surface.slots = static_cast<std::uint32_t>(slots);
    surface.listed = program.scratch<std::uint32_t>("surface.listed", slots + 1);
    surface.starts = program.scratch<std::array<std::uint32_t, 2>>("surface.starts", slots);
    surface.sums = program.scratch<std::array<std::uint32_t, 4>>("surface.sums", surface.push.chunks);
    surface.rest = program.upload("surface.rest", bodies.rest);
    surface.gradients = program.scratch<layout::Gradient>("surface.gradients", slots);
}

// Dispatches over the slots of every run that have some of the surface.
void addListed(ProgramBuilder& program, const CutSurface& surface, const vk::ShaderCode& code,
               std::initializer_list<BufferId> buffers) {
    for (const layout::CutPush& run : surface.source.runs)
        program.dispatchIndirect(code, {surface.arguments, surface.push.runs + 1, surface.slots}, buffers,
                                 run);
}

// Dispatches over the slots of every run, where something was cut.
void addRuns(ProgramBuilder& program, const CutSurface& surface, const vk::ShaderCode& code,
             std::initializer_list<BufferId> buffers) {
    const CutSource& source = surface.source;
    for (std::uint32_t r = 0; r < source.runs.size(); ++r)
        program.dispatchIndirect(code, {source.arguments, source.firstArgument + r, source.runs[r].count},
                                 buffers, source.runs[r]);
}

void addDrawing(ProgramBuilder& program, const CutSurface& surface) {
    const CutSource& source = surface.source;
    const StepProgram& built = program.program();
    const CutSurfaceBuffers drawn = built.cutSurface;
    for (std::uint32_t r = 0; r < source.runs.size(); ++r)
        program.dispatchIndirect(k::findGradients, {surface.arguments, r, source.runs[r].count},
                                 {surface.near, built.cutting.links, surface.rest, source.particles,
                                  built.positions, surface.gradients},
                                 source.runs[r]);
    program.dispatchIndirect(k::skinCut, {surface.arguments, surface.push.runs, surface.push.room},
                             {drawn.state, drawn.rest, surface.rest, source.particles, built.positions,
                              surface.gradients, drawn.vertices},
                             layout::CountPush{surface.push.room});
}

} // namespace

bool hasCutSurface(const Scene& scene, const Settings& settings) {
    const std::vector<std::uint32_t> grids = lattice::computedGrids(scene, settings);
    const std::vector<lattice::Box> boxes = lattice::boxesOf(scene, grids);
    bool hasSome = false;
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        if (!grid.isCuttable || grid.nodes[1] == 1) continue; // sheets have no inside
        const auto isItsSkin = [&](const Skin& skin) {
            return latticeFaces(skin, grid, boxes[g], 0).has_value();
        };
        if (std::ranges::none_of(scene.skins, isItsSkin)) return false; // passes would run over it, too
        hasSome = true;
    }
    return hasSome;
}

std::shared_ptr<CutSurface> addCutSurface(ProgramBuilder& program, const Scene& scene,
                                          const Settings& settings, const StateLayout& layout,
                                          const CutSource& source) {
    const Bodies bodies = readBodies(scene, settings, layout);
    auto surface = std::make_shared<CutSurface>();
    surface->source = source;
    surface->push = {.chunks = static_cast<std::uint32_t>(layout.count / SURFACE_CHUNK),
                     .room = roomFor(bodies.cells),
                     .runs = static_cast<std::uint32_t>(source.runs.size())};
    surface->faces = static_cast<std::uint32_t>(bodies.faces.size());
    addSlots(program, *surface, bodies);
    const std::uint32_t room = surface->push.room;
    StepProgram& built = program.program();
    CutSurfaceBuffers& drawn = built.cutSurface;
    drawn.state = program.scratch<layout::SurfaceState>("surface.state", 1);
    drawn.rest = program.scratch<layout::CutVertex>("surface.rest_vertices", room);
    drawn.vertices = program.scratch<layout::SkinVertex>("surface.vertices", room);
    drawn.indices = program.scratch<std::uint32_t>("surface.indices", 3 * std::uint64_t{room});
    drawn.draws = program.scratch<layout::DrawArguments>("surface.draws", 2);
    surface->arguments =
        program.scratch<layout::DispatchArguments>("surface.arguments", surface->push.runs + 2);
    surface->skinFaces = program.upload("surface.skin_faces", bodies.faces);
    surface->allIndices = program.upload("surface.all_indices", joinIndices(scene.skins));
    built.skinIndices = program.upload("skin.indices", joinIndices(scene.skins));
    for (const BufferId buffer :
         {surface->partitions, surface->near, surface->owned, surface->counts, surface->starts, drawn.state,
          drawn.rest, drawn.indices, drawn.draws, surface->arguments, built.skinIndices}) {
        built.cutting.topology.push_back(buffer);
        program.carry(buffer, buffer);
    }
    program.atSkin([&program, surface] { addDrawing(program, *surface); });
    return surface;
}

void addCutSurfacePasses(ProgramBuilder& program, const CutSurface& surface) {
    const CuttingBuffers& cutting = program.program().cutting;
    const CutSurfaceBuffers& drawn = program.program().cutSurface;
    const BufferId cells = surface.source.cells, partitions = surface.partitions, owned = surface.owned;
    addRuns(program, surface, k::partTetrahedra,
            {cutting.links, cells, cutting.dirty, partitions, surface.near});
    addRuns(program, surface, k::markPoints, {cutting.links, cells, cutting.dirty, partitions, owned});
    addRuns(program, surface, k::countSurface, {cells, cutting.dirty, partitions, owned, surface.counts});
    const layout::CountPush chunks{surface.push.chunks};
    program.dispatch(k::sumSurface, chunks.count, {surface.counts, surface.sums}, chunks);
    program.dispatch(k::scanSurface, GROUP_ITEMS,
                     {surface.sums, surface.arguments, drawn.draws, drawn.state, surface.source.groups,
                      cutting.counts, surface.listed},
                     surface.push);
    program.dispatch(k::startSurface, chunks.count,
                     {surface.counts, surface.sums, owned, surface.starts, surface.listed}, chunks);
    const BufferId listed = surface.listed;
    addListed(program, surface, k::writePoints,
              {listed, owned, partitions, cutting.hits, surface.rest, drawn.rest});
    addListed(program, surface, k::writeInside,
              {cells, partitions, owned, listed, surface.starts, drawn.rest, drawn.indices});
    addListed(program, surface, k::writeOutside,
              {cells, partitions, owned, listed, surface.starts, drawn.state, surface.rest, drawn.rest,
               drawn.indices, surface.source.particles});
    program.dispatch(
        k::hideFaces, surface.faces,
        {surface.counts, drawn.state, surface.skinFaces, surface.allIndices, program.program().skinIndices},
        layout::CountPush{surface.faces});
}

} // namespace sinew::sim::surface
