// Shared code of the analytic cases: the list of solvers, settings with known stiffness, measurements, and a
// runner that repeats each run in reversed invocation order.
#pragma once

#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace sinew::test {

/// Solvers for which the SolverCases run. Other cases name their solvers. A new solver must be added here, in
/// accurate() and in reachedStiffness().
inline constexpr std::array caseSolvers{sim::Solver::jacobi, sim::Solver::split, sim::Solver::gaussSeidel};

class SolverCase : public testing::TestWithParam<sim::Solver> {};

inline std::string solverOf(const testing::TestParamInfo<sim::Solver>& info) {
    return sim::solverName(info.param);
}

/// Settings with which a solver has a known stiffness, equal to the material's for short substeps. `split`
/// uses theta 0. `jacobi` uses one iteration and full corrections, because averaging divides the stiffness of
/// a soft spring by its number of neighbours.
sim::Settings accurate(sim::Solver solver, std::uint32_t substeps);

/// Stiffness that constraint c reaches with these settings in substeps of h [s] [N/m]. Infinite between
/// particles that never move. For `jacobi`, valid with one iteration and equal weights at both ends.
/// `gauss_seidel` reaches the requested stiffness at rest if the substeps suffice to solve its constraints.
double reachedStiffness(const sim::Scene& scene, const sim::Settings& settings, double h, std::size_t c);

/// Stiffness of every constraint under `split` [N/m]; infinite between particles that never move.
std::vector<double> splitStiffnesses(const sim::Scene& scene, const sim::Settings& settings, double h);

/// Whether `split` reaches the full stiffness of all links and, with a tenth to spare, of all cells of the
/// scene. Must be true where a case claims to be unclamped. Each lattice must have full cells.
bool isUnclamped(const sim::Scene& scene, const sim::Settings& settings);

/// A full voxel body in a scene without gravity. Corner ranges include both ends.
struct Solid {
    using Corner = std::array<std::uint32_t, 3>;
    static constexpr double cell = 0.05, density = 1000; ///< [m], [kg/m^3]
    sim::Scene scene;
    sim::LatticeCorners corners;
    double speed = 0; ///< sqrt(E / rho) [m/s]

    double modulus() const { return density * speed * speed; } ///< E [Pa]
    /// Mean position of the corners in a range [m].
    Eigen::Vector3d mean(const std::vector<Eigen::Vector3d>& x, Corner low, Corner high) const;
    void fix(Corner low, Corner high);
    /// Positions at the start [m].
    std::vector<Eigen::Vector3d> initial() const;
};

/// Makes a body centred on the origin, where float32 is most precise.
Solid makeSolid(const char* name, std::array<std::uint32_t, 3> cells, double speed,
                float poissonRatio = 0.25f);

/// Runs a scene on the device twice, once in reversed invocation order. The destructor expects both states to
/// have equal bits.
class CaseRunner {
public:
    CaseRunner(const sim::Scene& scene, sim::Settings settings);
    ~CaseRunner();
    CaseRunner(const CaseRunner&) = delete;
    CaseRunner& operator=(const CaseRunner&) = delete;

    void step(float dt);
    void run(int steps);
    std::vector<Eigen::Vector3d> positions() const { return forward_.positions(); }   ///< [m]
    std::vector<Eigen::Vector3d> velocities() const { return forward_.velocities(); } ///< [m/s]

private:
    Runner forward_, reversed_;
};

/// Expects `measured` within the relative `tolerance` of `expected` and records the deviation under the name
/// `what`.
void expectWithin(const std::string& what, double measured, double expected, double tolerance);

/// Interpolated zero crossings of a sampled vibration.
class Crossings {
public:
    void add(double time, double value);
    std::size_t count() const { return times_.size(); }
    /// Mean period between the first and the last crossing [s]; needs at least two crossings.
    double period() const;

private:
    std::vector<double> times_;
    double lastTime_ = 0, lastValue_ = 0;
};

/// Spacing of float32 numbers at this value.
double ulp(double value);

} // namespace sinew::test
