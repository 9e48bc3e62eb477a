// Level of detail of skins once something is cut. A skin that was split for cutting has several times as many
// triangles, and needs them only beside cuts. A mixed skin consists of its whole triangles away from cuts and
// of their parts beside cuts. Both are drawn where they meet, since a part has vertices on edges where a
// whole triangle has none, which would open a gap between them.
//
// Parts replace a whole triangle if a blade removed some of them, or moved their particles. A step with a cut
// runs: open_wholes (finds these triangles), mark_wholes (their corners), draw_wholes (these, and those
// around them), hide_faces (parts); then, for the packed list of drawn triangles: mark_drawn, scan_drawn,
// pack_drawn. The list of skins computes neither positions nor normals of vertices without a drawn triangle
// (StepProgram::shownVertices). It then runs skin_normals_whole (corners of whole triangles alone) and
// light_parts (vertices that only parts have).
#pragma once

#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::surface {

/// Adds the buffers if any skin in `bodies` has whole triangles; gives faces and whole triangles their
/// indices in StepProgram::mixedTriangles, the list of all skins. The buffers belong to the topology of cuts.
/// In a scene with cuttable sheets all triangles are drawn as parts, and these buffers only serve their
/// normals.
void addMixedSkins(ProgramBuilder& program, CutSurface& surface, const Scene& scene, CutBodies& bodies);

/// Appends, after normals: a vertex with only whole triangles around it gets the normal that it has while
/// nothing is cut.
void addWholeNormals(ProgramBuilder& program, const CutSurface& surface);

/// Appends the normals of vertices that only parts have, interpolated from those of the corners.
void addPartNormals(ProgramBuilder& program, const CutSurface& surface);

/// Appends, at the end of a step with a cut and in place of hide_faces alone, the triangles that pieces do
/// not replace.
void addFacePasses(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
