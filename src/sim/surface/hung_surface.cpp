// The passes over prisms and over attached vertices.
#include "sim/surface/hung_surface.hpp"

#include "kernels.hpp"

#include <algorithm>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

layout::PrismPush pushOf(const CutSurface& surface, std::uint32_t count) {
    return {.first = surface.slots, .count = count, .prisms = 0, .run = 0};
}

IndirectItems listOf(const HungSurface& hung, const layout::CutPush& range, std::uint32_t list) {
    return {hung.arguments, SKIN_LISTS * range.run + list, range.count};
}

void addPlan(ProgramBuilder& program, const HungSurface& hung) {
    const layout::CountPush lists{static_cast<std::uint32_t>(SKIN_LISTS * hung.ranges.size())};
    program.dispatch(k::planListed, lists.count, {hung.counts, hung.arguments}, lists);
}

// Lists elements that the blade may meet, and those with dead links: later passes run only for these.
void addLists(ProgramBuilder& program, const CutSurface& surface, BufferId bladePlaces, BufferId placesBefore,
              BufferId blade, BufferId points) {
    const CuttingBuffers& cutting = program.program().cutting;
    const BufferId status = program.program().status;
    const HungSurface& hung = surface.hung;
    program.fill(hung.counts, 0);
    for (const HungRange& range : hung.ranges)
        program.dispatch(k::listPrisms, range.slots.count,
                         {bladePlaces, placesBefore, blade, hung.slots, hung.hanging, hung.prisms, status,
                          cutting.dirty, hung.counts, hung.nears, hung.parted, hung.slotFlags, points},
                         range.slots);
    for (const HungRange& range : hung.ranges)
        program.dispatch(k::listVertices, range.slots.count,
                         {bladePlaces, placesBefore, blade, hung.slots, hung.hanging, status, hung.slotFlags,
                          hung.counts, hung.listed, hung.placed, points, cutting.savedLinks, cutting.links},
                         range.slots);
    addPlan(program, hung);
}

// Strides and spacing of the grid of each skin.
std::vector<layout::SkinGrid> gridsOf(const CutBodies& bodies) {
    std::vector<layout::SkinGrid> grids(1 + std::size_t{std::ranges::max(bodies.skins)});
    for (const HungRange& range : bodies.ranges) {
        const layout::HungVertex& first = bodies.vertices[range.vertices.first];
        grids[static_cast<std::size_t>(first.rest.w)] = {range.vertices.rowStride, range.vertices.sliceStride,
                                                         first.normal.w, 0};
    }
    return grids;
}

} // namespace

void addListedPrisms(ProgramBuilder& program, const CutSurface& surface, const vk::ShaderCode& code,
                     std::initializer_list<BufferId> buffers) {
    program.dispatchIndirect(code, {surface.arguments, surface.push.runs + SURFACE_LISTED, surface.items},
                             buffers, pushOf(surface, surface.hung.prismCount));
}

void addHungBuffers(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies) {
    if (bodies.prisms.empty()) return;
    HungSurface& hung = surface.hung;
    hung.ranges = bodies.ranges;
    hung.prismCount = static_cast<std::uint32_t>(bodies.prisms.size());
    hung.vertexCount = static_cast<std::uint32_t>(bodies.vertices.size());
    hung.prisms = program.upload("surface.prisms", bodies.prisms);
    hung.vertices = program.upload("surface.hung_vertices", bodies.vertices);
    hung.planes = program.upload("surface.planes", bodies.planes);
    hung.hits = program.scratch<std::uint32_t>("surface.skin_hits", hung.prismCount);
    hung.rims = program.scratch<std::uint32_t>("surface.rims", hung.vertexCount);
    hung.moved = program.scratch<layout::vec4>("surface.moved", hung.vertexCount);
    hung.nears = program.scratch<std::uint32_t>("surface.near_prisms", hung.prismCount);
    hung.parted = program.scratch<std::uint32_t>("surface.parted_prisms", hung.prismCount);
    hung.listed = program.scratch<std::uint32_t>("surface.near_vertices", hung.vertexCount);
    hung.slots = program.upload("surface.skin_slots", bodies.slots);
    hung.hanging = program.upload("surface.hanging", bodies.hanging);
    hung.slotFlags = program.scratch<std::uint32_t>("surface.slot_flags", surface.slots);
    hung.placed = program.scratch<layout::PlacedVertex>("surface.placed", hung.vertexCount);
    const std::size_t lists = SKIN_LISTS * hung.ranges.size();
    hung.counts = program.scratch<std::uint32_t>("surface.skin_counts", lists);
    hung.arguments = program.scratch<layout::DispatchArguments>("surface.skin_arguments", lists);
    hung.grids = program.upload("surface.grids", gridsOf(bodies));
    for (const HungRange& range : bodies.ranges)
        program.program().skinSpans.push_back(
            {static_cast<std::uint32_t>(bodies.vertices[range.vertices.first].rest.w), range.prisms.first,
             range.prisms.count, range.vertices.first, range.vertices.count});
    program.program().cutSurface.hung = hung.vertices;
    program.program().cutSurface.moved = hung.moved;
    if (!bodies.pulled.empty()) {
        surface.bladeRest = program.upload("surface.pulled_rest", bodies.pulled);
        hung.pulledPlaces = program.scratch<layout::vec4>("surface.pulled_places", surface.slots);
        hung.pulls = program.scratch<layout::vec4>("surface.pulls", surface.slots);
        program.program().cutting.topology.push_back(hung.pulls);
        program.addToState(hung.pulls, hung.pulls, {.of = Elements::slots});
    }
    const auto add = [&](BufferId buffer, Elements elements) {
        program.program().cutting.topology.push_back(buffer);
        program.addToState(buffer, buffer, {.of = elements});
    };
    add(hung.hits, Elements::prisms);
    for (const BufferId buffer : {hung.rims, hung.moved, hung.placed}) add(buffer, Elements::skinVertices);
    add(hung.slotFlags, Elements::slots);
}

BufferId addPulling(ProgramBuilder& program, const CutSurface& surface, BufferId placesBefore, BufferId work,
                    BufferId blade) {
    const CuttingBuffers& cutting = program.program().cutting;
    if (surface.hung.pulledPlaces == BufferId{}) return cutting.places;
    for (const layout::CutPush& run : surface.source.runs)
        program.dispatch(k::movePlacesBelowSkin, run.count,
                         {cutting.links, surface.rest, surface.bladeRest, cutting.places,
                          surface.hung.pulledPlaces, placesBefore, work, blade, surface.hung.pulls},
                         run);
    return surface.hung.pulledPlaces;
}

void addSkinHits(ProgramBuilder& program, const CutSurface& surface, BufferId bladePlaces,
                 BufferId placesBefore, BufferId blade, BufferId points) {
    const CuttingBuffers& cutting = program.program().cutting;
    const HungSurface& hung = surface.hung;
    if (hung.prismCount == 0) return;
    addLists(program, surface, bladePlaces, placesBefore, blade, points);
    for (const HungRange& range : hung.ranges)
        program.dispatchIndirect(k::placeVertices, listOf(hung, range.vertices, SKIN_VERTICES),
                                 {bladePlaces, placesBefore, blade, cutting.savedLinks, cutting.places,
                                  surface.rest, hung.vertices, surface.partitions, hung.counts, hung.listed,
                                  hung.placed, hung.moved},
                                 range.vertices);
    for (const HungRange& range : hung.ranges)
        program.dispatchIndirect(k::intersectSkinEdges, listOf(hung, range.prisms, SKIN_NEAR),
                                 {bladePlaces, placesBefore, blade, cutting.savedLinks, points, hung.prisms,
                                  hung.placed, hung.hits, hung.counts, hung.nears, hung.moved},
                                 range.prisms);
    for (const HungRange& range : hung.ranges)
        program.dispatchIndirect(k::snapRimsToBlade, listOf(hung, range.vertices, SKIN_VERTICES),
                                 {bladePlaces, placesBefore, blade, cutting.savedLinks, cutting.places,
                                  surface.rest, hung.vertices, points, hung.slotFlags, hung.moved, hung.rims,
                                  program.program().status, hung.counts, hung.listed, hung.placed,
                                  hung.planes},
                                 range.vertices);
}

void addPrismParting(ProgramBuilder& program, const CutSurface& surface) {
    const HungSurface& hung = surface.hung;
    for (const HungRange& range : hung.ranges) {
        layout::PrismPush push = pushOf(surface, hung.prismCount);
        push.prisms = range.prisms.first;
        push.run = range.prisms.run;
        program.dispatchIndirect(k::partitionPrisms, listOf(hung, range.prisms, SKIN_PARTED),
                                 {program.program().cutting.links, hung.counts, hung.prisms, surface.near,
                                  surface.owned, surface.counts, hung.rims, hung.parted},
                                 push);
    }
}

void addRimPoints(ProgramBuilder& program, const CutSurface& surface) {
    const HungSurface& hung = surface.hung;
    if (hung.prismCount == 0) return;
    addListedPrisms(program, surface, k::writeRims,
                    {surface.listed, surface.owned, program.program().cutting.links, hung.prisms,
                     hung.vertices, hung.hits, program.program().cutSurface.rest, hung.moved});
}

void addPrismTriangles(ProgramBuilder& program, const CutSurface& surface) {
    const CutSurfaceBuffers& drawn = program.program().cutSurface;
    const BufferId links = program.program().cutting.links;
    const HungSurface& hung = surface.hung;
    if (hung.prismCount == 0) return;
    addListedPrisms(program, surface, k::writePrisms,
                    {surface.listed, surface.owned, links, hung.prisms, hung.vertices, surface.starts,
                     drawn.rest, drawn.indices});
    addListedPrisms(program, surface, k::writePieces,
                    {surface.listed, surface.owned, links, hung.prisms, hung.vertices, surface.starts,
                     drawn.state, drawn.rest, drawn.indices, hung.moved});
}

void addSplitVertices(ProgramBuilder& program, const CutSurface& surface) {
    const StepProgram& built = program.program();
    const HungSurface& hung = surface.hung;
    if (hung.prismCount == 0) return;
    program.fill(hung.counts, 0);
    for (const HungRange& range : hung.ranges)
        program.dispatchIndirect(
            k::listSplitVertices, {surface.arguments, surface.push.runs + SURFACE_HUNG, hung.vertexCount},
            {hung.vertices, surface.partitions, hung.moved, hung.counts, hung.listed}, range.vertices);
    addPlan(program, hung);
    for (const HungRange& range : hung.ranges)
        program.dispatchIndirect(k::placeSplitVertices, listOf(hung, range.vertices, SKIN_SPLIT),
                                 {hung.vertices, built.cutting.links, surface.rest, surface.source.particles,
                                  built.positions, surface.gradients, surface.near, hung.moved, hung.counts,
                                  hung.listed, built.skinVertices},
                                 range.vertices);
}

void addRimNormals(ProgramBuilder& program, const CutSurface& surface) {
    const HungSurface& hung = surface.hung;
    if (hung.prismCount == 0) return;
    const StepProgram& built = program.program();
    std::vector<BufferId> buffers{
        hung.rims,       built.cutting.links, surface.rest, surface.source.particles,
        built.positions, surface.gradients,   surface.near, hung.vertices,
        hung.grids,      built.skinVertices};
    const bool isSplit = surface.wholeCount > 0;
    buffers.push_back(boundIf(isSplit, surface.wholeMarks));
    constexpr std::uint32_t isSplitId = 1; // constant_id in rotate_rim_normals.comp
    program.dispatchIndirect(k::rotateRimNormals,
                             {surface.arguments, surface.push.runs + SURFACE_HUNG, hung.vertexCount}, buffers,
                             pushOf(surface, hung.vertexCount), {{isSplitId, isSplit}});
}

} // namespace sinew::sim::surface
