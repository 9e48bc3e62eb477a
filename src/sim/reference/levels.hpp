// Coarse levels of `split` in double: blocks of 2 x 2 x 2 nodes of a body on a grid, whose links carry the
// stiffness that a substep is too long for (sim/levels/blocks.hpp has the formulas).
#pragma once

#include "sim/reference/problem.hpp"

#include <array>
#include <cstdint>

namespace sinew::sim::reference {

/// The limits of a link between particles: its stiffness [N/m], and the most that it has times h^2 [kg].
struct ClampedLink {
    double stiffness = 0, most = 0;
};

/// The levels of all bodies, constant in time.
class Levels {
public:
    /// `links`: one for each link of the problem. `h`: length of a substep [s].
    Levels(const Scene& scene, const Settings& settings, const Problem& problem,
           const std::vector<ClampedLink>& links, double h);
    /// Adds the forces on all particles [N] for kicks of length h; y: positions of the particles.
    void addForces(double h, const std::vector<Eigen::Vector3d>& y,
                   std::vector<Eigen::Vector3d>& force) const;

    struct Node { // of a level: a particle, or a block
        std::array<std::int64_t, 3> place{};
        Eigen::Vector3d rest{0, 0, 0};
        double inverseMass = 0, importance = 1;
        std::size_t parent = 0; // block of the next level, and the weight there
        double weight = 0;
    };
    struct Bond {
        std::size_t a = 0, b = 0;
        std::array<std::int64_t, 3> step{};
        double length = 0, stiffness = 0, most = 0;
    };
    struct Level {
        std::vector<Node> nodes;
        std::vector<Bond> bonds;
    };
    struct Body {
        std::size_t first = 0;     // particle of the first node of the first level
        std::vector<Level> levels; // the first is that of particles
    };

private:
    std::vector<Body> bodies_;
};

} // namespace sinew::sim::reference
