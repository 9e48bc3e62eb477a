// Contacts between particles, in `split`: temporary constraints, solved after the links of a substep and
// before the boundary planes. The gather of the links leaves predicted positions, without planes; two passes
// follow: one counts the contacts of each particle, one moves it and ends the substep. With restitution two
// more passes follow, for velocities. A scene in which no two particles can touch has none of these passes.
#pragma once

#include "sim/collision/contact_lists.hpp"
#include "sim/collision/interlocks.hpp"
#include "sim/collision/recoils.hpp"
#include "sim/collision/surfaces.hpp"
#include "sim/model/scene_model.hpp"
#include "sim/rigid/planes.hpp"

namespace sinew::sim::collision::particle_contacts {

struct Contacts {
    contact_lists::Lists lists;
    rigid::planes::Planes planes;
    surfaces::Surfaces surfaces;
    layout::ContactPush push{};
    /// Whether the substep ends for all particles as if they touched nothing, and then again for those
    /// with a candidate; otherwise one pass ends it for all.
    bool solvesListed = false;
    /// Whether pairs that hardly miss count in shares (SHARE_BAND): most particles are loose, and none
    /// rebound.
    bool countsNear = false;
    BufferId particles;              ///< slots that hold a particle; only if it settles
    std::uint32_t particleCount = 0; ///< their number
    bool hasRebound = false;         ///< of a plane
    bool hasRecovery = false;        ///< some pair overlaps when the scene is loaded, or may after a cut
    bool hasKept = false;            ///< some pair keeps its distance at load
    BufferId touching; ///< by slot: where contacts are looked for, and their number; then times of impacts
    BufferId bouncing, rebounding;
    BufferId before; ///< velocities at the start of the substep, set in each

    /// Pairs of the uncut bodies that never touch; invalid if no cuttable body touches.
    BufferId allExcluded;
    BufferId marks; ///< contact_lists::linkedMarks; invalid in the same case

    std::optional<interlocks::Interlocks> interlocks; ///< only if hasRecovery
    recoils::Recoils recoils;                         ///< only if the scene takes them back

    bool isCuttable() const { return allExcluded != BufferId{}; }
    bool hasMemory() const { return lists.pooled.memory.has_value(); }
};

/// Requires particles that touch.
Contacts add(ProgramBuilder& program, const SceneModel& model);

/// Joins particles that touch into one island of sleep.
void joinIslands(const Contacts& contacts, sleep::Sleep& sleep);

/// Appends the end of a substep, the first of a step or a later one: from predicted positions and velocities
/// to those of `next`.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               const ParticleBuffers& next, bool isFirst);

/// Appends restitution after addPasses(), if contacts.surfaces.hasRestitution. The velocities after the
/// substep are then in contacts.rebounding, which must not be those of `next`; the incoming ones are no
/// longer needed.
void addBounces(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                const ParticleBuffers& next);

/// Appends what takes recoils back, after all else that moves particles in a substep. `linked`: velocities
/// after links, before contacts. `predicted` and contacts.before are no longer needed.
void addRecoils(ProgramBuilder& program, const Contacts& contacts, BufferId linked,
                const ParticleBuffers& predicted, const ParticleBuffers& state, std::uint32_t substep);

/// Appends the end of a step: saves the memory of friction, or restores it after an undone step.
void addPublishing(ProgramBuilder& program, const Contacts& contacts);

} // namespace sinew::sim::collision::particle_contacts
