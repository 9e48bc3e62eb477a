// Explicit integration of a scene's springs on the CPU, compiled for this machine: no solver, as many
// substeps as stability asks for. It is the floor that every solver is compared with, and in double the true
// motion of large scenes.
#pragma once

#include "sinew/scene.hpp"

#include <barrier>
#include <cstddef>
#include <thread>

namespace sinew::tools::native {

/// Velocity Verlet in the form of leapfrog: v += h a(x), x += h v, with half a kick first, so that positions
/// are those of velocity Verlet. Every particle gathers the forces of its links, which are grouped into runs
/// of equal links between consecutive particles: the inner loop is one for vector instructions. The first
/// thread is the caller's. Results do not depend on the number of threads.
template <typename Real> class Verlet {
public:
    /// `scene` has elastic springs, masses, gravity and fixed particles; the caller checks this
    /// (requireSprings). `substeps` and `threads` are 1 or more.
    Verlet(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t threads);
    ~Verlet();
    Verlet(const Verlet&) = delete;
    Verlet& operator=(const Verlet&) = delete;

    /// Takes one step of the scene's length.
    void step();

    std::size_t size() const { return inverseMass_.size(); }
    std::array<double, 3> position(std::size_t particle) const; ///< [m]

private:
    /// Links of `count` consecutive particles from `first`, each to the particle `offset` further on.
    struct Run {
        std::uint32_t first = 0, count = 0;
        std::int32_t offset = 0;
        Real rest = 0, stiffness = 0; // [m], [N/m]
    };
    using Axes = std::array<std::vector<Real>, 3>;

    void group(const sim::Scene& scene);
    void work(std::uint32_t thread);
    void advance(std::size_t tile, const Axes& from, Axes& to, Real kick);

    std::vector<Run> runs_;               // by tile
    std::vector<std::uint32_t> firstRun_; // of each tile, and the end
    std::vector<Real> inverseMass_;       // 0: does not move
    Axes x_, other_, v_;                  // [m], [m/s]
    std::array<Real, 3> gravity_{};
    Real h_ = 0; // [s]
    std::uint32_t substeps_ = 1, threads_ = 1;
    bool isStart_ = true, isEnding_ = false;
    std::barrier<> turn_;
    std::vector<std::thread> helpers_;
};

} // namespace sinew::tools::native
