// What the analytic cases share: which solvers run, how they are set where their stiffness is known, a runner
// that also runs everything in reversed invocation order, and measurements.
#pragma once

#include "sim/bodies.hpp"
#include "sim/compile.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace sinew::test {

/// SolverCases run with these, other cases with the solvers that they name; a new solver is added here, and
/// to accurate() and reachedStiffness().
inline constexpr std::array caseSolvers{sim::Solver::jacobi, sim::Solver::split, sim::Solver::gaussSeidel};

class SolverCase : public testing::TestWithParam<sim::Solver> {};

inline std::string solverOf(const testing::TestParamInfo<sim::Solver>& info) {
    return sim::solverName(info.param);
}

/// The form of a solver whose stiffness is known and, for short substeps, the material's: `split` at theta 0;
/// `jacobi` with one iteration and whole corrections, since averaging divides a soft spring's stiffness by
/// its neighbours.
sim::Settings accurate(sim::Solver solver, std::uint32_t substeps);

/// The stiffness of constraint c that these settings reach in substeps of h [s] [N/m] (methods: D). Infinite
/// between particles that never move. For `jacobi` with one iteration, and the same weight at both ends;
/// `gauss_seidel` has at rest what was asked for, where substeps suffice to solve its constraints.
double reachedStiffness(const sim::Scene& scene, const sim::Settings& settings, double h, std::size_t c);

/// Of `split`: the same for every constraint, infinite between particles that never move [N/m].
std::vector<double> splitStiffnesses(const sim::Scene& scene, const sim::Settings& settings, double h);

/// Whether `split` has all the stiffness of the scene with these settings, of links and (with a tenth to
/// spare) of cells; must hold where a case says unclamped. Lattices are full somewhere.
bool isUnclamped(const sim::Scene& scene, const sim::Settings& settings);

/// A full voxel body in a scene without gravity. Ranges are of corners, both ends included.
struct Solid {
    using Corner = std::array<std::uint32_t, 3>;
    static constexpr double cell = 0.05, density = 1000; ///< [m], [kg/m^3]
    sim::Scene scene;
    sim::LatticeCorners corners;
    double speed = 0; ///< sqrt(E / rho) [m/s]

    double modulus() const { return density * speed * speed; } ///< E [Pa]
    /// Of positions [m].
    Eigen::Vector3d mean(const std::vector<Eigen::Vector3d>& x, Corner low, Corner high) const;
    void fix(Corner low, Corner high);
    /// Positions [m].
    std::vector<Eigen::Vector3d> initial() const;
};

/// Centred on the origin, where float32 is finest.
Solid makeSolid(const char* name, std::array<std::uint32_t, 3> cells, double speed,
                float poissonRatio = 0.25f);

/// A scene on the device twice, once in reversed invocation order; on destruction, the bits of both states
/// must agree.
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

/// Expects `measured` within `tolerance` (relative) of `expected` and records the deviation under `what`.
void expectWithin(const std::string& what, double measured, double expected, double tolerance);

/// The zero crossings of a sampled vibration, interpolated.
class Crossings {
public:
    void add(double time, double value);
    std::size_t count() const { return times_.size(); }
    /// Mean period between the first and the last crossing [s]; at least two must have been seen.
    double period() const;

private:
    std::vector<double> times_;
    double lastTime_ = 0, lastValue_ = 0;
};

/// Length of a float32 step at this value.
double ulp(double value);

} // namespace sinew::test
