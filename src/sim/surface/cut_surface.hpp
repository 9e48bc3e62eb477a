// The surface of cuts: what a blade lays open inside of a body on a grid, and what is left of its skin beside
// it. Built on the device in a step that cut something, by one rule per tetrahedron (cutting design, 5):
// marching tetrahedra on dead links, closed and two-sided. For bodies whose skin is the outer faces of their
// cells (lattice_faces).
//
// In a step with a cut, near the blade alone: part_tetrahedra (which corners of each tetrahedron hang
// together), mark_points (which points on edges, faces and in middles hold both sides), count_surface
// (triangles of every cell). Of all that was ever cut: sum, scan and start (where each cell's part begins, by
// counts in the order of slots; what is drawn), write_points (rest places, what they hang on), write_inside
// (indices, normals at rest), write_outside (pieces of outer faces, with vertices of their own), hide_faces
// (skin triangles that pieces stand for).
//
// When somebody draws: find_gradients (how the material around particles near a cut has turned and strained),
// skin_cut (vertices and normals).
//
// Nothing is appended by a counter: the same cut makes the same bits in any order.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <memory>

namespace sinew::sim::surface {

/// What cutting keeps that a surface is made from.
struct CutSource {
    std::vector<layout::CutPush> runs;
    BufferId cells;     ///< by slot: fill of the cells around
    BufferId particles; ///< by slot: NO_PARTICLE where there is none
    BufferId groups;    ///< of runs
    BufferId arguments; ///< by run from `first` on: all slots where something was cut, else none
    std::uint32_t firstArgument = 0;
};

struct CutSurface {
    CutSource source;
    layout::SurfacePush push{};
    std::uint32_t faces = 0, slots = 0;
    BufferId partitions, near, owned, counts, starts, sums, listed, arguments, rest, skinFaces, allIndices,
        gradients;
};

/// Whether any skin is clipped.
bool hasCutSurface(const Scene& scene, const Settings& settings);

/// Buffers, and the skin's indices, which cuts change. After those of StepProgram::cutting, to whose topology
/// they are added.
std::shared_ptr<CutSurface> addCutSurface(ProgramBuilder& program, const Scene& scene,
                                          const Settings& settings, const StateLayout& layout,
                                          const CutSource& source);

/// After the links of a step are settled.
void addCutSurfacePasses(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
