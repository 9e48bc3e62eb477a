// The coarse levels of a body on a grid, computed in double: blocks of 2 x 2 x 2 nodes, blocks of 2 x 2 x 2
// blocks, and so on, and the links between the blocks of a level.
//
// A block is at the mean of its children by mass. At the surface of a body, nodes weigh twice as much in that
// mean: loads of contacts and grabs act on them, and reach the block without the links inside it. Where a
// child never moves, the block is at the mean of those children and never moves either. Each level's links
// have the stiffness that is missing below: a substep clamps a link of stiffness k to k'
// (sim/stiffness/shares.hpp), and k - k' goes to the links of the same direction between the blocks of its
// two ends, so that a uniform strain has the same energy: k_c L_c^2 = sum of (k - k') L^2. A link inside a
// block counts half for each of the two block links before and behind it. At edges, where no pair of blocks
// lies in the direction s of a link, its part s' along block neighbours takes (|s'| / |s|)^4 of the energy.
//
// The energy of a level is a function of weighted means, so its forces act on a child by its weight, and
// conserve momentum and angular momentum.
//
// Stability: links of a level are clamped as those of particles are, with omega_l = 0.95 omega. Together they
// must stay below 4 / (1 + 2 theta). Whatever the directions n of links are, x^T K x = sum k (n . (x_a -
// x_b))^2 is at most the sum over the three coordinates of sum k (x_a - x_b)^2: the largest eigenvalue of the
// graphs of all levels, where links have no direction, bounds every deformation, for substeps of any length.
// Volumes and recovery of cells and bends enter with their limits. Power iteration estimates the eigenvalue;
// it is about 1.5 omega where few particles are fixed, because modes that alternate from node to node vanish
// in the means of the next level. If it is above 0.95 x 4 / (1 + 2 theta), all levels but the first take a
// share of their stiffness, in which the eigenvalue is convex.
#pragma once

#include "sim/stiffness/shares.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim::levels {

/// The largest eigenvalue of h^2 M^-1 K with levels, by that of stability.
inline constexpr double mostEigenvalue = 0.95;

/// A node of a level: a particle, or a block.
struct Node {
    std::array<std::int32_t, 3> place{}; ///< on the grid of its level
    std::array<double, 3> rest{};        ///< position on the undeformed grid [m]
    double inverseMass = 0;   ///< [1/kg]; of a block: sum of weight^2 x inverseMass of its children
    std::uint32_t parent = 0; ///< in the next level, if there is one
    double weight = 0;        ///< in the mean that places the parent
    bool isOfSurface = false; ///< a particle with fewer links than others of the body
};

/// A link between two nodes of a level.
struct Link {
    std::uint32_t a = 0, b = 0;
    std::array<std::int32_t, 3>
        step{};           ///< from the place of a to that of b, as the links have it that it stands for
    double length = 0;    ///< at rest [m]
    double stiffness = 0; ///< [N/m]
    double most = 0;      ///< limit of stiffness h^2 [kg]
};

struct Level {
    std::vector<Node> nodes;
    std::vector<Link> links;
};

/// The levels of one grid: that of its particles, in the order of the grid, then as many coarse ones as carry
/// something, at most Settings::levels. Only links of the grid have a part in them.
std::vector<Level> levelsOf(const Scene& scene, const Settings& settings, std::uint32_t grid,
                            std::span<const float> inverseMass, const stiffness::Shares& shares);

} // namespace sinew::sim::levels
