// Rows of `sinew bench --by-form`: the same bodies in each form that a device may be given, one line each.
#pragma once

#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// Rows with `body`, `form`, `particles`, `substeps`, `steps`, `clock` ("device" or "host"), `ms_best`,
/// `ms_median` (by that clock) and `host_ms_best` of a step, submission and wait included. A form runs 60
/// steps, or for 0.2 s, but 2 steps at least. Each row goes to stderr as it is measured. Stops early where
/// the program is interrupted.
Json measureForms(Session& session);

std::string formsTable(const Json& rows);

} // namespace sinew::tools
