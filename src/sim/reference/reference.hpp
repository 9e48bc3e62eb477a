// The solvers again, sequentially and in double precision on the CPU, written from the Scene alone. The
// slides' sequential row, and what a step on the device is held against. Shares no code with kernels or
// compile.
#pragma once

#include "sim/reference/problem.hpp"

#include <span>

namespace sinew::sim::reference {

/// What a link starts the next substep with.
struct KeptMultiplier {
    double lambda = 0;         ///< [N s^2]
    Eigen::Vector3d direction; ///< unit length, from end a to end b
};

/// Positions [m] and velocities [m/s], one entry a particle.
struct State {
    std::vector<Eigen::Vector3d> x, v;
    double previousH =
        0; ///< substep of the step before [s]; 0 at the start (`split` starts with a half-kick)
    std::vector<Eigen::Vector3d> anchors;    ///< where the points of attachments are [m]
    std::vector<Eigen::Vector3d> targets;    ///< where they go in the next step; those missing stay
    std::vector<KeptMultiplier> multipliers; ///< of each link, kept by a warm `gauss_seidel`; empty = 0
};

/// The state a scene describes; particles that never move have no velocity.
State initialState(const Scene& scene);

/// One step of `dt` [s] under the scene's gravity; settings.substeps is a number (withSubsteps). `split`
/// keeps v half a substep behind x, as the device does.
void stepGaussSeidel(const Scene& scene, const Settings& settings, double dt,
                     State& state); ///< in constraint order
void stepJacobi(const Scene& scene, const Settings& settings, double dt, State& state);
void stepSplit(const Scene& scene, const Settings& settings, double dt, State& state);

/// stepGaussSeidel with everything that stays the same from step to step looked up once: the sequential rows
/// of a benchmark. Copies what it needs of the scene. `order` holds indices into scene.distances, each that
/// has an end which moves once; `bendOrder` likewise into scene.bends; empty = as the scene lists them.
/// settings.warmStart 0 makes it the slides' version.
class GaussSeidel {
public:
    GaussSeidel(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> order = {},
                std::span<const std::uint32_t> bendOrder = {});
    void step(double dt, State& state);

private:
    // One constraint as the inner loop reads it, in one cache line.
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
    std::vector<Eigen::Vector3d> directions_; ///< of each row when it was last solved; for a warm start
};

} // namespace sinew::sim::reference
