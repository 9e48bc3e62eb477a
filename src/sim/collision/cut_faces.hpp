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

/// An update of the faces or edges that remain, for the bodies of one run.
struct CutFilter {
    const vk::ShaderCode* code = nullptr;
    std::vector<BufferId> buffers;
    layout::CutFacesPush push{};
};

/// Adds the buffers of these updates; none if no face, or no edge, can be cut. Call it after
/// cutting::addOpening.
std::vector<CutFilter> faceFilters(ProgramBuilder& program, const face_contacts::Contacts& contacts);
std::vector<CutFilter> edgeFilters(ProgramBuilder& program, const edge_contacts::Contacts& contacts);
/// Appends the updates: before the substeps of a step with a blade, and after links were restored.
void addFilters(ProgramBuilder& program, std::span<const CutFilter> filters);
/// Appends, in the first substep after lists were made, the recording of overlaps of new faces, which are
/// removed slowly. Nothing if no cut makes faces.
void addFaceOpening(ProgramBuilder& program, const face_contacts::Contacts& contacts,
                    const ParticleBuffers& predicted);

} // namespace sinew::sim::collision
