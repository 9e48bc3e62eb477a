// `sinew bench --contacts`: cost of contacts without any touch, with a body at rest, and in shipped scenes.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/json.hpp"
#include "sinew/session.hpp"

#include <string>
#include <vector>

namespace sinew::tools {

/// Counts of one recording of a program per substep: means over the substeps of a step.
struct SubstepCounts {
    double passes = 0; ///< dispatches, fills, copies and updates
    double direct = 0; ///< dispatches with a group count from the program
    /// Dispatches with a group count from a kernel; those that make lists have no groups while lists are
    /// complete.
    double indirect = 0;
    double barriers = 0;
};
SubstepCounts countSubstep(const sim::StepProgram& program, sim::Recording recording = sim::plainStep);

/// The names of the rows.
std::vector<std::string> contactRows();

/// Measures the rows whose names contain `only`, at least one: the same steps of each scene, whatever their
/// speed, in rounds until `seconds` have passed. Stops early, with the rows so far, if a signal asks for it.
Json measureContacts(Session& session, const std::string& only, double seconds);

/// The rows as text.
std::string contactsTable(const Json& rows);

} // namespace sinew::tools
