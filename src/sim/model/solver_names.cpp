// A table.
#include "sinew/solver_names.hpp"

namespace sinew::sim {

namespace {

struct SolverEntry {
    Solver solver;
    const char* name;
};

constexpr SolverEntry solverTable[] = {
    {Solver::jacobi, "jacobi"},
    {Solver::split, "split"},
    {Solver::gaussSeidel, "gauss_seidel"},
};

} // namespace

const char* solverName(Solver solver) {
    for (const SolverEntry& entry : solverTable)
        if (entry.solver == solver) return entry.name;
    return solverTable[0].name;
}

bool parseSolver(const std::string& name, Solver& solver) {
    for (const SolverEntry& candidate : solverTable) {
        if (name == candidate.name) {
            solver = candidate.solver;
            return true;
        }
    }
    return false;
}

std::vector<std::string> solverNames() {
    std::vector<std::string> names;
    for (const SolverEntry& candidate : solverTable) names.emplace_back(candidate.name);
    return names;
}

} // namespace sinew::sim
