// Normals of split skins after a cut. mesh::addMesh splits the triangles of a skin so that it can be cut: the
// parts of a whole triangle have vertices on its edges and inside of it. These normals light the parts as the
// whole triangle was lit before the cut, so that a cut changes no color away from it.
//
// In a step with a cut: find_cut_triangles (which whole triangles are beside the cut), mark_cut_corners
// (their corners). When somebody draws: skin_normals (corners of whole triangles away from cuts, from
// those triangles), then interpolate_part_normals (vertices that only parts have, by interpolation between
// the corners).
#pragma once

#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::surface {

/// Makes the buffers, if any skin in `bodies` says of which whole triangles its triangles are parts
/// (Skin::wholeOf). They belong to the topology of cuts.
void addSplitNormals(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies);

/// At the end of a step with a cut: finds the whole triangles beside the cut.
void addWholeMarks(ProgramBuilder& program, const CutSurface& surface);

/// When somebody draws, after the normals of all skins: a vertex around which all whole triangles are away
/// from cuts gets the normal that it has while nothing is cut.
void addWholeNormals(ProgramBuilder& program, const CutSurface& surface);

/// After the normals of the corners: normals of the vertices that only parts have.
void addPartNormals(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
