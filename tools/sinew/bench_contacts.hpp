// `sinew bench --contacts`: what contacts cost where nothing touches, where a body rests, and in shipped
// scenes.
#pragma once

#include "sim/program.hpp"
#include "sinew/json.hpp"
#include "sinew/session.hpp"

#include <string>
#include <vector>

namespace sinew::tools {

/// The work of a recording of a program in a substep, the mean over the substeps of a step.
struct SubstepCounts {
    double passes = 0; ///< dispatches, fills, copies and updates
    double direct = 0; ///< dispatches of which the program says how many groups they have
    /// Dispatches of which a kernel says so: of those that make lists none has a group while lists are
    /// complete.
    double indirect = 0;
    double barriers = 0;
};
SubstepCounts countSubstep(const sim::StepProgram& program, sim::Recording recording = sim::plainStep);

/// Time of a GPU that is predicted for the dispatches of a step [us]: 2.5 for a direct one, 2 for an indirect
/// one, as if none of these had a group. The computing of kernels is not in it.
double predictedUs(const sim::StepProgram& program, sim::Recording recording = sim::plainStep);

/// The names of the rows.
std::vector<std::string> contactRows();

/// The rows whose names contain `only`, at least one. The same steps of a scene are measured whatever their
/// speed, in rounds until `seconds` have passed. Stops early, with the rows so far, where a signal asks to.
Json measureContacts(Session& session, const std::string& only, double seconds);

/// The rows as text.
std::string contactsTable(const Json& rows);

} // namespace sinew::tools
