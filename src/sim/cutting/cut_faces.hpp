// Contacts of faces and of their edges on a body that a cut has parted. A face of a sheet between corners
// that no longer hang together touches nothing, as its triangle is drawn no more, and neither does an edge of
// which the link is dead, nor a face of a crumb. The surface of a voxel body with faces is that of its cells
// without a dead edge: squares that were inside become faces where a cut lays them open. Particles still
// touch the faces of others. Lists of contacts are made again in the same step.
#pragma once

#include "sim/collision/edge_contacts.hpp"
#include "sim/collision/face_contacts.hpp"

namespace sinew::sim::cutting {

/// Before the substeps: which faces and edges are left. Nothing where none of them may be cut. After
/// cutting::add.
void addFaceFilter(ProgramBuilder& program, const collision::face_contacts::Contacts& contacts);
/// In the first substep, after lists were made: what a new face overlaps parts slowly. Nothing where no cut
/// makes faces.
void addFaceOpening(ProgramBuilder& program, const collision::face_contacts::Contacts& contacts,
                    const ParticleBuffers& predicted);
void addEdgeFilter(ProgramBuilder& program, const collision::edge_contacts::Contacts& contacts);

} // namespace sinew::sim::cutting
