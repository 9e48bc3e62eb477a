// Recoils: the speed at which loose particles part because contacts have pushed them out of each other. A
// contact without restitution should leave none. One solution a substep hands momentum on by one contact, so
// a column that falls onto a plane is compressed, and thrown up again by half of its speed.
//
// At the end of a substep each contact may take back impulses, up to what both of its particles received
// along its line, while it parts. Iterations approach the impulses of least kinetic energy:
//
//   receive_rows        what faces gave, before contacts between particles; where some are static or driven
//   find_recoils        particles that part fast; runs only while something is as fast
//   take_recoils_back   one work group: iterations, from these particles on; runs only if there are any
//
// Particles with more than three contacts with others take no part: inside a heap, shares take recoils away.
// Only scenes that ask for it (ContactSettings::takesRecoils), of mostly loose particles without restitution
// between them, have these passes. Faces that give way, those of cloth and bodies, take nothing back.
#pragma once

#include "sim/collision/contact_lists.hpp"
#include "sim/collision/row_contacts.hpp"
#include "sim/model/scene_model.hpp"

namespace sinew::sim::collision::recoils {

struct Recoils {
    float leastReach = 0;        ///< smallest distance at which two particles touch [m]
    BufferId received = unbound; ///< what passes that give impulses keep (received.glsl)
    bool followsRows = false;    ///< whether addRows() is called in each substep
    BufferId contacts;           ///< layout::Recoil, RECOIL_CONTACTS a slot
    BufferId members, degrees;   ///< slots of particles; by slot: contacts
    BufferId near = unbound;     ///< by slot: candidates that touch or count in shares (few_contacts.glsl)
    BufferId arguments;          ///< of the second pass, by substep; unused0: number of members
    bool exist() const { return received != unbound; }
};

/// For a scene whose contacts count nearly touching pairs (Contacts::countsNear).
Recoils add(ProgramBuilder& program, const SceneModel& model, float leastReach);

/// Constants of the kernel that finds impulses between particles.
ProgramBuilder::Constants constants(const Recoils& recoils, const ParticleBuffers& particles);

/// Appends the pass that keeps what `rows` of faces gave, after they were applied; `places` as in
/// face_contacts::Contacts::linkedPositions.
void addRows(ProgramBuilder& program, const Recoils& recoils, const row_contacts::Rows& rows, BufferId places,
             const ParticleBuffers& predicted, bool isFirst);

/// Contacts between particles in this substep.
struct Found {
    const contact_lists::Lists& lists;
    BufferId touching; ///< positions at which contacts were found
    bool hasRecovery = false;
    BufferId linked;    ///< velocities before contacts
    BufferId even, odd; ///< of vec4, by slot: no longer needed in this substep
};

/// Appends the passes after all else that moves particles in a substep, whose index is from 0.
void addPasses(ProgramBuilder& program, const Recoils& recoils, const Found& found,
               const ParticleBuffers& state, std::uint32_t substep);

} // namespace sinew::sim::collision::recoils
