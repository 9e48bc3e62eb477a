// Contacts of particles that a cut has parted (contacts: 3). Linked particles never touch; where a link dies,
// its ends leave the table of pairs that do not, and lists of contacts are made again in the same step. What
// they overlap by then parts slowly, as overlaps do when a scene is loaded.
#pragma once

#include "sim/collision/particle_contacts.hpp"

namespace sinew::sim::cutting {

/// Whether particles of bodies that may be cut are among what touches. After cutting::add.
bool canMeet(const StepProgram& program, const Scene& scene);

/// Before the substeps: who may touch from now on. Nothing where nobody can meet across a cut.
void addContactFilter(ProgramBuilder& program, const collision::particle_contacts::Contacts& contacts);

/// In the first substep, after lists were made and before contacts are counted. Likewise.
void addContactOpening(ProgramBuilder& program, const collision::particle_contacts::Contacts& contacts);

} // namespace sinew::sim::cutting
