// The surface of cuts: the inner surface that a blade exposes in a body on a grid, and the remaining parts of
// its skin beside it. The device builds it in a step that cut something, by one rule for each tetrahedron:
// marching tetrahedra on dead links, closed and two-sided. The skin of a body is the outer faces of its cells
// (lattice_faces) or a mesh attached to them (skin_complex); hung_surface contains what differs for meshes.
//
// A step with a cut runs, near the blade only: partition_tetrahedra (which corners of each tetrahedron are
// connected), mark_points (points on edges, on faces and in centres, one for each side or one for both),
// count_surface (triangles of every cell). It then runs for the whole surface: sum, scan and start (first
// element of each cell, from the counts in the order of slots; draw arguments), write_points (rest positions,
// the particles they depend on), write_inside (indices, normals at rest), write_outside (pieces of outer
// faces, with their own vertices), hide_faces (skin triangles that pieces replace).
//
// Items of the surface are slots, followed by prisms. The list of skins runs: find_gradients (rotation and
// strain of the material around particles near a cut), normals of attached skins and of split ones
// (hung_surface, split_normals), place_cut_points (points and their normals), place_piece_corners (corners of
// pieces, at the points).
//
// No element is appended by a counter: the same cut gives the same bits in any order of execution.
#pragma once

#include "common/layout.h"
#include "sim/surface/cut_bodies.hpp"
#include "sim/surface/skin.hpp"

#include <memory>

namespace sinew::sim::surface {

/// Buffers of cutting that the surface is made from.
struct CutSource {
    std::vector<layout::CutPush> runs;
    BufferId particles; ///< by slot; NO_PARTICLE in empty ones
    BufferId groups;    ///< of runs
    BufferId arguments; ///< by run from `first` on: slots near a cut, 0 without one
    std::uint32_t firstArgument = 0;
};

/// Buffers of skins of meshes; no prisms if none is clipped.
struct HungSurface {
    std::vector<HungRange> ranges;
    std::uint32_t prismCount = 0, vertexCount = 0;
    BufferId prisms, vertices;
    BufferId planes;                    ///< by vertex: normal of the triangles around it
    BufferId hits;                      ///< by prism: positions where its edges were cut
    BufferId rims;                      ///< by vertex: whether a triangle around it is drawn in pieces
    BufferId moved;                     ///< by vertex: its position after moving to a cut [m]
    BufferId nears, parted, listed;     ///< lists of prisms and of vertices (SKIN_LISTS)
    BufferId slots, hanging, slotFlags; ///< SkinSlot; elements of each slot; by slot: SLOT_MET ...
    BufferId placed;                    ///< by vertex: PlacedVertex
    BufferId counts, arguments;         ///< SKIN_LISTS of each range
    BufferId grids;                     ///< by skin: SkinGrid
    BufferId pulls;                     ///< by slot: from a particle to its pulled position [m]
    BufferId pulledPlaces; ///< by slot, positions of particles for a blade [m]; invalid = unchanged
};

/// Buffers of texture coordinates; invalid, or empty, where no clipped skin of the kind has them.
struct SurfaceTexture {
    BufferId prisms, wholes;                      ///< of bound skins
    BufferId faces;                               ///< of outer faces of cells
    std::vector<layout::TexturedFacePush> ranges; ///< of these, by body
};

struct CutSurface {
    CutSource source;
    layout::SurfacePush push{};
    std::uint32_t faces = 0, slots = 0, items = 0;
    BufferId complex, partitions, near, owned, counts, starts, sums, listed, arguments, rest, skinFaces,
        allIndices, gradients;
    BufferId turns;     ///< by point: the cofactor matrix of the deformation there, in columns
    BufferId bladeRest; ///< rest positions for a blade: `rest`, or below the skin
    HungSurface hung;
    std::uint32_t wholeCount = 0;     ///< whole triangles of split skins; 0 = there are none
    BufferId wholes;                  ///< these whole triangles
    BufferId wholeStates;             ///< by whole triangle: 1 = it is beside a cut
    BufferId wholeMarks;              ///< by attached vertex: 1 = a corner of a whole triangle beside a cut
    std::uint32_t partCount = 0;      ///< vertices that only parts of whole triangles have
    BufferId partVertices;            ///< these vertices
    BufferId wholeIndices;            ///< corners of whole triangles, as vertices of all skins
    VertexFans wholeFans;             ///< whole triangles around each of these vertices
    std::uint32_t wholeVertices = 0;  ///< vertices in wholeFans
    std::vector<std::uint32_t> skins; ///< clipped skins
    SurfaceTexture texture;
};

/// Adds the buffers, and the index buffer of skins, which cuts change. Call it after the buffers of
/// StepProgram::cutting were added, to whose topology these are added.
std::shared_ptr<CutSurface> addCutSurface(ProgramBuilder& program, const Scene& scene, CutBodies bodies,
                                          const CutSource& source);

/// Appends, in the phase "cut" after positions were saved, the positions that a blade uses. Returns their
/// buffer.
BufferId addPulling(ProgramBuilder& program, const CutSurface& surface, BufferId placesBefore, BufferId work,
                    BufferId blade);

/// Appends, in the phase "cut" after the links of a step are settled, where the blade met the skin.
void addSkinHits(ProgramBuilder& program, const CutSurface& surface, BufferId bladePlaces,
                 BufferId placesBefore, BufferId blade, BufferId points);

/// Appends, to the list of skins between positions and normals, what normals of clipped meshes depend on.
void addNormalsOfCuts(ProgramBuilder& program, const CutSurface& surface);

/// Appends the surface to the list of skins, after all normals.
void addCutDrawing(ProgramBuilder& program, const CutSurface& surface);

/// Appends the passes at the end of a step.
void addCutSurfacePasses(ProgramBuilder& program, const CutSurface& surface, BufferId blade);

} // namespace sinew::sim::surface
