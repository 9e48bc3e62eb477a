// Whole triangles of all skins stand behind one another, in the order of the bodies.
#include "sim/surface/split_normals.hpp"

#include "kernels.hpp"
#include "sim/surface/skin.hpp"

#include <algorithm>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

void uploadWholes(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies) {
    std::vector<std::uint32_t> indices;
    for (const layout::WholeTriangle& whole : bodies.wholes)
        for (const std::uint32_t corner : whole.vertices) indices.push_back(bodies.vertices[corner].vertex);
    surface.wholeVertices = std::ranges::max(indices) + 1;
    surface.wholeIndices = program.upload("surface.whole_indices", indices);
    surface.wholeFans = uploadFans(program, indices, surface.wholeVertices, "surface.whole");
}

} // namespace

void addSplitNormals(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies) {
    if (bodies.wholes.empty()) return;
    surface.wholeCount = static_cast<std::uint32_t>(bodies.wholes.size());
    surface.wholes = program.upload("surface.wholes", bodies.wholes);
    surface.wholeStates = program.scratch<std::uint32_t>("surface.whole_states", surface.wholeCount);
    surface.wholeMarks = program.scratch<std::uint32_t>("surface.whole_marks", bodies.vertices.size());
    for (const BufferId buffer : {surface.wholeStates, surface.wholeMarks}) {
        program.program().cutting.topology.push_back(buffer);
        program.addToState(buffer, buffer);
    }
    uploadWholes(program, surface, bodies);
    surface.partCount = static_cast<std::uint32_t>(bodies.parts.size());
    if (surface.partCount > 0) surface.partVertices = program.upload("surface.part_vertices", bodies.parts);
}

void addWholeMarks(ProgramBuilder& program, const CutSurface& surface) {
    if (surface.wholeCount == 0) return;
    program.fill(surface.wholeStates, 0);
    program.fill(surface.wholeMarks, 0);
    program.dispatch(k::findCutTriangles, surface.faces,
                     {surface.counts, program.program().cutSurface.state, surface.skinFaces,
                      surface.hung.prisms, surface.hung.vertices, surface.hung.moved, surface.partitions,
                      surface.wholeStates},
                     layout::PrismPush{.first = surface.slots, .count = surface.faces});
    const layout::CountPush wholes{surface.wholeCount};
    program.dispatch(k::markCutCorners, wholes.count,
                     {surface.wholes, surface.wholeStates, surface.wholeMarks}, wholes);
}

void addWholeNormals(ProgramBuilder& program, const CutSurface& surface) {
    if (surface.wholeCount == 0) return;
    const std::uint32_t hung = surface.hung.vertexCount;
    addNormals(program, surface.wholeIndices, surface.wholeFans,
               {.count = hung, .vertices = surface.wholeVertices},
               {surface.hung.vertices, surface.wholeMarks});
}

void addPartNormals(ProgramBuilder& program, const CutSurface& surface) {
    if (surface.partCount == 0) return;
    const StepProgram& built = program.program();
    program.dispatch(k::interpolatePartNormals, surface.partCount,
                     {surface.partVertices, built.cutting.links, surface.rest, surface.source.particles,
                      built.positions, surface.gradients, surface.near, surface.hung.vertices,
                      surface.hung.grids, built.skinVertices, surface.wholes, surface.wholeStates,
                      surface.hung.rims},
                     layout::CountPush{surface.partCount});
}

} // namespace sinew::sim::surface
