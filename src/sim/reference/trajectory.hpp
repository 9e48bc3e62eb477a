// R1, the true motion: the semi-discrete equations of motion m x'' = f(x) + m g of a scene's springs, solved
// by undamped velocity Verlet in double until a shorter step no longer changes the result. All figures of
// speed against error use it as reference. Free functions, safe from any thread.
#pragma once

#include "sim/reference/reference.hpp"

namespace sinew::sim::reference {

struct TrajectoryOptions {
    std::uint32_t frames = 1;
    double dt = 1.0 / 60;    ///< length of a frame [s], > 0
    double tolerance = 1e-6; ///< of body size; largest change of any particle in any frame when h is halved
    /// Perturbation by body size: every coordinate of a movable particle starts up to this far from its
    /// position in the scene, by a hash of its index. Reveals chaotic motion.
    double perturbation = 0;
};

struct Trajectory {
    std::vector<std::vector<Eigen::Vector3d>> frames; ///< frames[f]: positions [m] after frame f + 1
    double h = 0;                                     ///< the step that was accepted [s]
    double selfDifference = 0; ///< the largest distance from the result at 2 h, by body size
};

/// Throws std::invalid_argument with a sentence for a scene with anything but springs, masses and gravity or
/// for options out of range, and std::runtime_error if no h agrees with its half: the motion is chaotic or
/// diverges, usually detected after one halving. Starts at h <= 0.1 / largestFrequency. Time: frames x dt / h
/// x links x about 10 ns.
Trajectory trueTrajectory(const Scene& scene, const TrajectoryOptions& options);

/// `steps` steps of velocity Verlet of length h [s]: v += h/2 a(x); x += h v; v += h/2 a(x). Leaves x and v
/// at the same time. Throws std::invalid_argument as trueTrajectory does.
void stepVerlet(const Scene& scene, double h, std::uint64_t steps, State& state);

/// Diagonal of the bounding box of the particles [m]; 0 for none or one.
double bodySize(const Scene& scene);

/// Energy of the movable particles [J]; gravitational energy is 0 at the origin. x and v must belong to the
/// same time.
struct Energy {
    double kinetic = 0, elastic = 0, gravitational = 0;
    double total() const { return kinetic + elastic + gravitational; }
};

/// Throws std::invalid_argument if a link is rigid, and for bends and attachments, whose energy is not
/// counted.
Energy energy(const Scene& scene, const State& state);

} // namespace sinew::sim::reference
