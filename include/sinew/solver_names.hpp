// Names of the solvers, in scene files and on command lines.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <string>
#include <vector>

namespace sinew::sim {

/// "jacobi", "split" or "gauss_seidel".
SINEW_API const char* solverName(Solver solver);

/// Returns false for an unknown name, and leaves `solver` as it is.
SINEW_API bool parseSolver(const std::string& name, Solver& solver);

/// All names, in the order of Solver.
SINEW_API std::vector<std::string> solverNames();

} // namespace sinew::sim
