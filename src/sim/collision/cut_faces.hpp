// Contacts of faces and edges of a body after a cut. A face of a sheet whose corners are separated touches
// nothing, and its triangle is not drawn; nor does an edge with a dead link, or a face of a fragment, touch
// anything. The surface of a voxel body with faces is that of its cells without a dead edge: inner squares
// become faces when a cut exposes them. Particles still touch faces of other bodies. Contact lists are
// rebuilt in the same step.
#pragma once

#include "sim/collision/edge_contacts.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/model/state.hpp"

namespace sinew::sim::collision {

/// Appends, before the substeps, the update of faces and edges that remain. Nothing if none of them can be
/// cut. Call it after cutting::add.
void addFaceFilter(ProgramBuilder& program, const face_contacts::Contacts& contacts);
/// Appends, in the first substep after lists were made, the recording of overlaps of new faces, which are
/// removed slowly. Nothing if no cut makes faces.
void addFaceOpening(ProgramBuilder& program, const face_contacts::Contacts& contacts,
                    const ParticleBuffers& predicted);
void addEdgeFilter(ProgramBuilder& program, const edge_contacts::Contacts& contacts);

} // namespace sinew::sim::collision
