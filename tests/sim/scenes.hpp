// Small scenes that several tests share. Random ones have fixed seeds.
#pragma once

#include "sim/scene.hpp"

#include <Eigen/Core>
#include <iosfwd>

namespace sinew::sim {

/// How GoogleTest names a solver.
void PrintTo(Solver solver, std::ostream* stream);

} // namespace sinew::sim

namespace sinew::test {

struct NamedScene {
    std::string name;
    sim::Scene scene;
};

struct ChainLinks {
    float compliance = 0;       ///< of every link [m/N]
    bool isEverySecond = false; ///< gives it to every second link only; the others are rigid
};

/// `count` particles of 0.5 to 1 kg in a row along x, 0.1 m apart, each linked to the next.
sim::Scene chain(std::uint32_t count, const ChainLinks& links = {});
/// A full voxel body of cells^3 cells with its lowest corner at (0, height, 0).
sim::Scene block(std::uint32_t cells, float spacing, float youngModulus, float height = 0);
/// A horizontal sheet of size^2 particles, 0.1 m apart, two corners pinned.
sim::Scene sheet(std::uint32_t size, float compliance = 0);
/// One particle of 1 kg.
sim::Scene particleAt(sim::Vec3 position, sim::Vec3 velocity = {});

/// Moves every particle by up to `distance` [m] and gives it up to `speed` [m/s] along each axis.
void disturb(sim::Scene& scene, float distance, float speed);
/// A floor through the lowest particle and a wall leaning on the first one, with friction and restitution.
void addRoom(sim::Scene& scene);

Eigen::Vector3d toVector(const sim::Vec3& v);
/// Diagonal of the bounding box [m], at least 0.1.
double sizeOf(const sim::Scene& scene);
/// Sum of the finite masses [kg].
double massOf(const sim::Scene& scene);

/// One of each kind: nothing, free particles, chains, lattices, cloth; with and without planes, skins and
/// fixed ends.
std::vector<NamedScene> allScenes();

} // namespace sinew::test
