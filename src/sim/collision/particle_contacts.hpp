// Particles that touch particles, in `split`: temporary constraints, solved after the links of a substep and
// before the boundary planes (contacts: 7). The gather of the links leaves predicted positions, without
// planes; two passes follow: one counts what each particle touches, one moves it and ends the substep. Where
// particles rebound two more follow, for velocities. A scene in which no two particles can touch has none of
// this.
#pragma once

#include "sim/collision/contact_lists.hpp"
#include "sim/collision/interlocks.hpp"
#include "sim/collision/planes.hpp"
#include "sim/collision/surfaces.hpp"

namespace sinew::sim::collision::particle_contacts {

/// Whether particles of the scene may touch each other: two have a radius, and one of them can move.
bool areIn(const Scene& scene);

struct Contacts {
    contact_lists::Lists lists;
    planes::Colliders planes;
    surfaces::Surfaces surfaces;
    layout::ContactPush push{};
    /// Whether the substep ends for all as if they touched nothing, and then anew for groups in which
    /// somebody has a candidate; else for all in one pass.
    bool settles = false;
    BufferId particles;              ///< slots that hold a particle; only where it settles
    std::uint32_t particleCount = 0; ///< how many
    bool hasRebound = false;         ///< of a plane
    bool hasRecovery = false;        ///< some pair overlaps when the scene is loaded, or may after a cut
    bool hasKept = false;            ///< some pair keeps the distance that it has when the scene is loaded
    BufferId touching, firsts, bouncing, rebounding;
    BufferId before; ///< velocities when the substep began, set in each

    /// Pairs of the uncut bodies that never touch; invalid where no body that may be cut touches.
    BufferId allExcluded;
    BufferId marks; ///< contact_lists::linkedMarks; likewise

    std::optional<interlocks::Interlocks> interlocks; ///< only where hasRecovery

    bool isCuttable() const { return allExcluded != BufferId{}; }
    bool hasMemory() const { return lists.pooled.memory.has_value(); }
};

/// Only where areIn().
Contacts add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
             const StateLayout& layout);

/// Particles that touch sleep together.
void joinIslands(const Contacts& contacts, sleep::Sleep& sleep);

/// The end of a substep, the first of a step or not: from predicted positions and velocities to those of
/// `next`.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               const ParticleBuffers& next, bool isFirst);

/// After them, where contacts.surfaces.hasRestitution: what rebounds. The velocities after the substep then
/// are in contacts.rebounding, which must not be those of `next`; those that come in are free.
void addBounces(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                const ParticleBuffers& next);

/// The end of a step: what friction remembers is saved, or taken back with an undone step.
void addPublishing(ProgramBuilder& program, const Contacts& contacts);

} // namespace sinew::sim::collision::particle_contacts
