// Names of the solvers, in scene files and on command lines.
#pragma once

#include "sinew/scene.hpp"

#include <string>
#include <vector>

namespace sinew::sim {

/// "jacobi", "split" or "gauss_seidel".
const char* solverName(Solver solver);

/// Returns false for an unknown name. The list of names stands only here.
bool parseSolver(const std::string& name, Solver& solver);

std::vector<std::string> solverNames();

} // namespace sinew::sim
