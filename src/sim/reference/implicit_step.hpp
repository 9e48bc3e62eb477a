// R2, the converged result of a step: implicit Euler solved to convergence by Newton's method, so that solver
// error and time error can be separated; and, by the same method, the state in which a scene comes to rest.
// Free functions, safe from any thread.
#pragma once

#include "sim/reference/reference.hpp"

namespace sinew::sim::reference {

struct NewtonOptions {
    double tolerance = 1e-10; ///< on |grad| / |grad_0|, or the limit that rounding of positions sets
    std::uint32_t mostIterations = 200;
};

struct NewtonReport {
    std::vector<double> gradients; ///< |grad| [N] at the start and after every iteration
    double residual() const;       ///< the last over the first; 0 if there was nothing to do
};

/// One step of length h [s]: x minimises |x - x_n - h v_n|_M^2 / (2 h^2) + E(x), v = (x - x_n) / h. Throws
/// std::invalid_argument with a sentence for a scene with anything but springs, masses and gravity, and
/// std::runtime_error if Newton's method does not converge.
NewtonReport stepImplicitEuler(const Scene& scene, double h, State& state, const NewtonOptions& options = {});

/// Moves `state` downhill to the equilibrium that it falls into; velocities become 0. Damping does not matter
/// for it. Throws as above, also if nothing holds the scene.
NewtonReport findEquilibrium(const Scene& scene, State& state, const NewtonOptions& options = {});

/// findEquilibrium from the initial state of the scene.
State staticEquilibrium(const Scene& scene);

} // namespace sinew::sim::reference
