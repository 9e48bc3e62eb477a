// Contacts between edges of faces, in `split`: temporary constraints, solved after contacts of points with
// faces and before those between particles. Without them two faces may cross where no corner is near: coarse
// cloth on a ridge, cloth on cloth. row_contacts.hpp says how they are solved. A scene in which no two edges
// can meet has none of these passes.
#pragma once

#include "sim/collision/edge_lists.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/model/state.hpp"

namespace sinew::sim::collision::edge_contacts {

/// The edges of edgesOf(), if particles of the scene touch faces and two of their edges may meet: some moving
/// edge is longer than three times the thickness of its sheet when the scene is loaded. Corners alone keep
/// finer cloth apart; the result is then empty.
std::vector<edge_lists::Edge> edgesThatMeet(const SceneModel& model);

struct Contacts {
    edge_lists::Lists lists;
    row_contacts::Rows rows;             ///< with the surfaces of contacts with faces
    ProgramBuilder::Constants constants; ///< of the kernel that finds contacts
    /// Only if two sheets may meet: arguments of the search of zones, and those of impact_zones::FoundEdges.
    BufferId finding = unbound, meeting = unbound, looked = unbound;

    /// The edges that impact zones search; none if no two sheets may meet.
    std::optional<impact_zones::FoundEdges> passing() const;
};

/// `edges` is not empty; `faces` are the contacts with faces of the same scene.
Contacts add(ProgramBuilder& program, const SceneModel& model, const std::vector<edge_lists::Edge>& edges,
             const ParticleBuffers& particles, const face_contacts::Contacts& faces);

/// Appends passes that change predicted positions and velocities in place. `isFirst`: first substep of a
/// step.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst);

/// All edges that may touch others, between particles, in ascending order: edges of faces, except those
/// within a plane of two static faces.
std::vector<edge_lists::Edge> edgesOf(const Scene& scene, const std::vector<float>& inverseMass);

/// Edges that an edge never touches, as in edge_lists::Request: edges of its own linked body with a rest
/// distance below 1.05 times contact distance. `bodies` is that of linkedBodies().
std::vector<std::uint32_t> excludedEdges(const Scene& scene, std::span<const std::uint32_t> bodies,
                                         std::span<const edge_lists::Edge> edges);

} // namespace sinew::sim::collision::edge_contacts
