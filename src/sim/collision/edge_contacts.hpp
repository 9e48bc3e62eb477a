// Edges of faces that touch each other, in `split`: temporary constraints, solved after contacts of points
// with faces and before those between particles. Without them two faces may cross where no corner comes near:
// coarse cloth on a ridge, cloth on cloth. How contacts are solved: row_contacts.hpp. A scene in which no two
// edges can meet has none of this.
#pragma once

#include "sim/collision/edge_lists.hpp"
#include "sim/collision/face_contacts.hpp"

namespace sinew::sim::collision::edge_contacts {

/// Whether particles of the scene touch faces, and two of their edges may meet: some edge that moves is
/// longer than three times what its sheet is thick as the scene is loaded. Finer cloth is kept apart by its
/// corners.
bool areIn(const Scene& scene);

struct Contacts {
    edge_lists::Lists lists;
    row_contacts::Rows rows; ///< of the surfaces of contacts with faces
};

/// Only where areIn(), beside `faces`.
Contacts add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
             const ParticleBuffers& particles, const face_contacts::Contacts& faces);

/// Changes predicted positions and velocities where they stand. `isFirst`: of the substeps of a step.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst);

/// All edges that may touch others, between particles, in ascending order: those of faces, but for one in the
/// plane of two that never move.
std::vector<edge_lists::Edge> edgesOf(const Scene& scene);

/// Edges that one never touches, as edge_lists::Request says: those of its own linked body that are nearer
/// than 1.05 times touching at rest.
std::vector<std::uint32_t> excludedEdges(const Scene& scene, std::span<const edge_lists::Edge> edges);

} // namespace sinew::sim::collision::edge_contacts
