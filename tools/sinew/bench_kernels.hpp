// `sinew bench --kernels`: cost of a substep of `split` for bodies of many sizes.
#pragma once

#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// One row per body: its form (chosen by tune() unless `forms` sets it), shortest and median time of a
/// substep [ms], ns per link, bytes per particle. Stops early, with the rows so far, if a signal asks for it.
Json measureKernels(Session& session, const FormOptions& forms);

/// The rows as text.
std::string kernelsTable(const Json& rows);

} // namespace sinew::tools
