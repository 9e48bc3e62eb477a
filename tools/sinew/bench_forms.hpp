// `sinew bench --by-form`: the same bodies in each form that a device may choose, one row each.
#pragma once

#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// Rows with `body`, `form`, `particles`, `substeps`, `steps`, `clock` ("device" or "host"), and per step
/// `ms_best`, `ms_median` (by that clock) and `host_ms_best` (with submission and wait). A form runs 60
/// steps, or for 0.2 s, but at least 2 steps. Prints each row on stderr when it is measured. Stops early if
/// the program is interrupted.
Json measureForms(Session& session);

std::string formsTable(const Json& rows);

} // namespace sinew::tools
