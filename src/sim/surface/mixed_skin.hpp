// What is drawn of skins once something is cut: those that were split so that they may be cut have several
// times the triangles, and need them beside cuts alone. A mixed skin is its whole triangles away from cuts
// and parts of them beside; where the two meet, both are there, since a part has vertices on edges on which a
// whole triangle has none, and a gap would open between them.
//
// Parts stand for a whole triangle where a blade took some of them, or moved what they hang on. In a step
// with a cut: open_wholes (which these are), mark_wholes (their corners), draw_wholes (those, and those
// around them), hide_faces (parts); and of all that, one behind another, what is drawn: mark_drawn,
// scan_drawn, pack_drawn. Of vertices that are in no triangle that is drawn neither places nor normals are
// made when somebody draws (StepProgram::shownVertices). Then skin_normals_whole (of corners of whole
// triangles alone) and light_parts (of vertices that only parts have).
#pragma once

#include "sim/surface/cut_surface.hpp"

namespace sinew::sim::surface {

/// Buffers, if any skin in `bodies` says what its triangles are parts of; gives faces and whole triangles
/// their places in StepProgram::mixedTriangles, which are those of all skins. Part of the topology of cuts.
/// Where a scene has sheets that are cut all is drawn of parts, and what is here lights them.
void addMixedSkins(ProgramBuilder& program, CutSurface& surface, const Scene& scene, CutBodies& bodies);

/// When somebody draws, after normals are made: where all triangles around a vertex are whole it has the
/// normal that it has while nothing is cut.
void addWholeNormals(ProgramBuilder& program, const CutSurface& surface);

/// When those of the corners are there, which they lie between: of vertices that only parts have.
void addPartNormals(ProgramBuilder& program, const CutSurface& surface);

/// When a step with a cut came to its end, in place of hide_faces alone: what pieces do not stand for.
void addFacePasses(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
