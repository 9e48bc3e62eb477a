// R1, the truth about a motion: the semi-discrete equations of motion m x'' = f(x) + m g of a scene's
// springs, solved by undamped velocity Verlet in double until a shorter step no longer moves the answer
// (cases: 1; methods: C). What every speed-against-error figure is measured against. Free functions, safe
// from any thread.
#pragma once

#include "sim/reference/reference.hpp"

namespace sinew::sim::reference {

struct TrajectoryOptions {
    std::uint32_t frames = 1;
    double dt = 1.0 / 60;    ///< length of a frame [s], > 0
    double tolerance = 1e-6; ///< of body size; how far halving h may still move any particle in any frame
    /// Of body size: every coordinate of a movable particle starts up to this far from where the scene puts
    /// it, by a hash of its index. Shows when a motion has become chaotic.
    double perturbation = 0;
};

struct Trajectory {
    std::vector<std::vector<Eigen::Vector3d>> frames; ///< frames[f]: positions [m] after frame f + 1
    double h = 0;                                     ///< the step that was accepted [s]
    double selfDifference = 0; ///< the largest distance from the answer at 2 h, by body size
};

/// Throws std::invalid_argument with a sentence for a scene that is not springs, masses and gravity alone or
/// for options out of range, and std::runtime_error where no h agrees with its half: a chaotic or diverging
/// motion, mostly known after one halving. Starts at h <= 0.1 / largestFrequency. Time: frames x dt / h x
/// links x about 10 ns.
Trajectory trueTrajectory(const Scene& scene, const TrajectoryOptions& options);

/// `steps` steps of velocity Verlet of length h [s]: v += h/2 a(x); x += h v; v += h/2 a(x). Leaves x and v
/// at the same time. Throws std::invalid_argument as trueTrajectory does.
void stepVerlet(const Scene& scene, double h, std::uint64_t steps, State& state);

/// Diagonal of the bounding box of the particles [m]; 0 for none or one.
double bodySize(const Scene& scene);

/// Of the movable particles [J]; gravity's is 0 at the origin. x and v must belong to the same time.
struct Energy {
    double kinetic = 0, elastic = 0, gravitational = 0;
    double total() const { return kinetic + elastic + gravitational; }
};

/// Throws std::invalid_argument where a link is rigid, and for bends and attachments, whose energy is not
/// counted.
Energy energy(const Scene& scene, const State& state);

} // namespace sinew::sim::reference
