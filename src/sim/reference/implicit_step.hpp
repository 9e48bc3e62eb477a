// R2, the truth about a step: implicit Euler solved to convergence by Newton's method, so that solver error
// and time error can be told apart (cases: 1). And by the same method the state a scene comes to rest in.
// Free functions, safe from any thread.
#pragma once

#include "sim/reference/reference.hpp"

namespace sinew::sim::reference {

struct NewtonOptions {
    double tolerance = 1e-10; ///< on |grad| / |grad_0|, or as near as rounding of positions lets it come
    std::uint32_t mostIterations = 200;
};

struct NewtonReport {
    std::vector<double> gradients; ///< |grad| [N] at the start and after every iteration
    double residual() const;       ///< the last by the first; 0 if there was nothing to do
};

/// One step of length h [s]: x minimises |x - x_n - h v_n|_M^2 / (2 h^2) + E(x), v = (x - x_n) / h.
/// Throws std::invalid_argument with a sentence for a scene that is not springs, masses and gravity alone,
/// and std::runtime_error where Newton does not converge.
NewtonReport stepImplicitEuler(const Scene& scene, double h, State& state, const NewtonOptions& options = {});

/// Moves `state` to the equilibrium that it falls into, downhill all the way; velocities become 0. Damping
/// has no part in that. Otherwise throws as above, also where nothing holds the scene.
NewtonReport findEquilibrium(const Scene& scene, State& state, const NewtonOptions& options = {});

/// findEquilibrium from where the scene puts its particles.
State staticEquilibrium(const Scene& scene);

} // namespace sinew::sim::reference
