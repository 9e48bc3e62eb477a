// The surface of cuts: what a blade lays open inside of a body on a grid, and what is left of its skin beside
// it. Built on the device in a step that cut something, by one rule per tetrahedron:
// marching tetrahedra on dead links, closed and two-sided. For bodies whose skin is the outer faces of their
// cells (lattice_faces) or a mesh that hangs on them (skin_complex); what is different for the latter stands
// in hung_surface.
//
// In a step with a cut, near the blade alone: part_tetrahedra (which corners of each tetrahedron hang
// together), mark_points (which points on edges, faces and in middles hold both sides), count_surface
// (triangles of every cell). Of all that was ever cut: sum, scan and start (where each cell's part begins, by
// counts in the order of slots; what is drawn), write_points (rest places, what they hang on), write_inside
// (indices, normals at rest), write_outside (pieces of outer faces, with vertices of their own), hide_faces
// (skin triangles that pieces stand for).
//
// Items of the surface are slots, and prisms behind them. When somebody draws: find_gradients (how the
// material around particles near a cut has turned and strained), normals of skins that hang and of mixed ones
// (hung_surface, mixed_skin), skin_cut (points and their normals), skin_pieces (corners of pieces, at the
// points).
//
// Nothing is appended by a counter: the same cut makes the same bits in any order.
#pragma once

#include "layout.h"
#include "sim/surface/cut_bodies.hpp"
#include "sim/surface/skin.hpp"

#include <memory>

namespace sinew::sim::surface {

/// What cutting keeps that a surface is made from.
struct CutSource {
    std::vector<layout::CutPush> runs;
    BufferId particles; ///< by slot: NO_PARTICLE where there is none
    BufferId groups;    ///< of runs
    BufferId arguments; ///< by run from `first` on: the slots near what was cut, if anything was
    std::uint32_t firstArgument = 0;
};

/// Of skins of meshes; no prisms where none is clipped.
struct HungSurface {
    std::vector<HungRange> ranges;
    std::uint32_t prismCount = 0, vertexCount = 0;
    BufferId prisms, vertices;
    BufferId planes;                    ///< by vertex: the normal of the triangles around it
    BufferId hits;                      ///< by prism: where its edges were cut
    BufferId rims;                      ///< by vertex: whether a triangle around is drawn in pieces
    BufferId moved;                     ///< by vertex: where it has moved to beside a cut [m]
    BufferId nears, parted, listed;     ///< lists of prisms and of vertices (SKIN_LISTS)
    BufferId slots, hanging, slotFlags; ///< SkinSlot; what hangs there; by slot: SLOT_MET ...
    BufferId placed;                    ///< by vertex: PlacedVertex
    BufferId counts, arguments;         ///< SKIN_LISTS of each range
    BufferId grids;                     ///< by skin: SkinGrid
    BufferId pulls;                     ///< by slot: from a particle to its pulled place [m]
    BufferId pulledPlaces; ///< by slot, where particles are for a blade [m]; invalid = at their places
};

struct CutSurface {
    CutSource source;
    layout::SurfacePush push{};
    bool usesTexels = true; ///< Forms::usesTexels
    std::uint32_t faces = 0, slots = 0, items = 0;
    BufferId complex, partitions, near, owned, counts, starts, sums, listed, arguments, rest, skinFaces,
        allIndices, gradients;
    BufferId turns;     ///< by point: the cofactor of the motion there, in columns
    BufferId bladeRest; ///< where a blade has particles at rest: `rest`, or below the skin
    HungSurface hung;
    std::uint32_t wholeCount = 0;     ///< triangles of mixed skins; 0 = there are none
    BufferId wholes, wholeStates;     ///< these; WHOLE_ALONE ...
    std::uint32_t partCount = 0;      ///< vertices that only their parts have
    BufferId partVertices;            ///< these
    BufferId wholeMarks;              ///< by vertex that hangs: 1 = a corner of one that its parts stand for
    BufferId shownAtFirst;            ///< StepProgram::shownVertices while nothing is cut
    BufferId wholeIndices;            ///< what their normals come from,
    VertexFans wholeFans;             ///< with these
    std::uint32_t wholeVertices = 0;  ///< of all skins, that have such a normal
    BufferId mixedWords;              ///< by skin: layout::MixedWords
    BufferId drawnWords, drawnStarts; ///< by word: which of its triangles are drawn; where those go
    std::uint32_t words = 0, skinCount = 0; ///< 0 = none is drawn mixed
    std::vector<std::uint32_t> skins;       ///< that are clipped
};

/// Buffers, and the skin's indices, which cuts change. After those of StepProgram::cutting, to whose topology
/// they are added.
std::shared_ptr<CutSurface> addCutSurface(ProgramBuilder& program, const Scene& scene, CutBodies bodies,
                                          const CutSource& source, bool usesTexels);

/// In the phase "cut", after places were put down: those that a blade meets. Returns them.
BufferId addPulling(ProgramBuilder& program, const CutSurface& surface, BufferId placesBefore, BufferId work,
                    BufferId blade);

/// In the phase "cut", after the links of a step are settled.
void addSkinHits(ProgramBuilder& program, const CutSurface& surface, BufferId bladePlaces,
                 BufferId placesBefore, BufferId blade, BufferId points);

/// When a step came to its end.
void addCutSurfacePasses(ProgramBuilder& program, const CutSurface& surface, BufferId blade);

} // namespace sinew::sim::surface
