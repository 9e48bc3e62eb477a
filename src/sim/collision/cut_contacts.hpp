// Contacts between particles that a cut has separated. Linked particles never touch; when a link is cut, its
// ends are removed from the table of excluded pairs, and contact lists are rebuilt in the same step. An
// overlap that they have then is removed slowly, like overlaps at load.
#pragma once

#include "sim/collision/particle_contacts.hpp"

namespace sinew::sim::collision {

/// Whether particles of cuttable bodies can touch. Call it after cutting::addOpening.
bool canMeet(const StepProgram& program, const Scene& scene);

/// Makes the table of excluded pairs part of the topology. Nothing if no pair can touch across a cut.
void addToTopology(ProgramBuilder& program, const particle_contacts::Contacts& contacts);
/// Appends the update of excluded pairs: before the substeps of a step with a blade, and after links were
/// restored.
void addContactFilter(ProgramBuilder& program, const particle_contacts::Contacts& contacts);

/// Appends, in the first substep after lists were made and before contacts are counted, the recording of new
/// overlaps. Nothing if no pair can touch across a cut.
void addContactOpening(ProgramBuilder& program, const particle_contacts::Contacts& contacts);

} // namespace sinew::sim::collision
