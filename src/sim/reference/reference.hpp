// The solvers, sequentially and in double precision on the CPU, written from the Scene alone: the sequential
// row of benchmarks, and the reference for a step on the device. Shares no code with kernels or compile.
#pragma once

#include "sim/reference/problem.hpp"

#include <span>

namespace sinew::sim::reference {

/// The multiplier from which a link starts the next substep.
struct KeptMultiplier {
    double lambda = 0;         ///< [N s^2]
    Eigen::Vector3d direction; ///< unit length, from end a to end b
};

/// Positions [m] and velocities [m/s], one entry a particle.
struct State {
    std::vector<Eigen::Vector3d> x, v;
    double previousH =
        0; ///< substep of the last step [s]; 0 at the start (there `split` starts with a half kick)
    double longestH = 0;            ///< `split`: substep that links were clamped for in the last step [s]
    std::vector<double> clampTimes; ///< of a sharp clamp: tau of each particle [s^2]; empty = the scene's
    std::vector<Eigen::Vector3d> anchors;    ///< points of attachments [m]
    std::vector<Eigen::Vector3d> targets;    ///< their targets in the next step; missing ones stay
    std::vector<KeptMultiplier> multipliers; ///< by link, kept by `gauss_seidel` with a warm start; empty = 0
};

/// The initial state of a scene; static particles have no velocity.
State initialState(const Scene& scene);

/// One step of `dt` [s] under the scene's gravity; settings.substeps must be resolved (withSubsteps). `split`
/// keeps v half a substep behind x, as the device does.
void stepGaussSeidel(const Scene& scene, const Settings& settings, double dt,
                     State& state); ///< in constraint order
void stepJacobi(const Scene& scene, const Settings& settings, double dt, State& state);
void stepSplit(const Scene& scene, const Settings& settings, double dt, State& state);

/// stepGaussSeidel with everything constant over steps computed once: the sequential rows of a benchmark.
/// Copies what it needs of the scene. `order` holds indices into scene.distances, each with a moving end
/// exactly once, and `bendOrder` similarly indices into scene.bends; empty = the order of the scene. With
/// settings.warmStart 0 and in scene order it is the classic sequential version.
class GaussSeidel {
public:
    GaussSeidel(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> order = {},
                std::span<const std::uint32_t> bendOrder = {});
    void step(double dt, State& state);

private:
    // A constraint in the layout of the inner loop, in one cache line.
    struct Row {
        std::uint32_t a = 0, b = 0;
        double inverseMassA = 0, inverseMassB = 0;
        double restLength = 0;
        double alpha = 0, inverseDenominator = 0; // compliance / h^2, 1 / (w_a + w_b + alpha)
        double lambda = 0;
    };
    void sweep(State& state);
    void damp(double h, State& state) const;
    void sweepBends(double h, State& state);
    void beginStep(double h, const State& state);
    void startWarm(State& state) const;
    void keepMultipliers();

    Problem problem_;
    std::uint32_t substeps_, iterations_;
    double warmStart_;
    std::vector<Eigen::Vector3d> bendMultipliers_;
    std::vector<Row> rows_;
    std::vector<std::uint32_t> linkOfRow_;
    std::vector<Eigen::Vector3d> directions_; ///< of each row at its last solve; for a warm start
};

} // namespace sinew::sim::reference
