// `sinew bench --kernels`: what a substep of `split` costs on bodies of many sizes.
#pragma once

#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// One row a body: its form as tune() chose it, unless `forms` says more, shortest and median time of a
/// substep [ms], ns for each link, bytes a particle. Stops early, with the rows so far, where a signal asks
/// to.
Json measureKernels(Session& session, const FormOptions& forms);

/// The rows as text.
std::string kernelsTable(const Json& rows);

} // namespace sinew::tools
