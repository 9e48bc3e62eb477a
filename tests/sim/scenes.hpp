// Small scenes shared by several tests. Random ones have fixed seeds.
#pragma once

#include "sinew/scene.hpp"
#include "sinew/simulation.hpp"

#include <Eigen/Core>
#include <functional>
#include <iosfwd>
#include <string>

namespace sinew::sim {

/// Prints a solver in messages of GoogleTest.
void PrintTo(Solver solver, std::ostream* stream);

} // namespace sinew::sim

namespace sinew::test {

struct NamedScene {
    std::string name;
    sim::Scene scene;
};

struct ChainLinks {
    float compliance = 0;       ///< of every link [m/N]
    bool isEverySecond = false; ///< only every second link has it; the others are rigid
};

/// `count` particles of 0.5 to 1 kg in a row along x, 0.1 m apart, each linked to the next.
sim::Scene chain(std::uint32_t count, const ChainLinks& links = {});
/// A chain of `links` links below a fixed particle at the origin, each with `mass` [kg] at its end.
sim::Scene hangingChain(std::uint32_t links, float spacing, float mass, float compliance);
/// A full voxel body of cells^3 cells with its lowest corner at (0, height, 0).
sim::Scene block(std::uint32_t cells, float spacing, float youngModulus, float height = 0);
/// A block of 3^3 cells of 0.1 m without gravity that moves at `speed` [m/s] and spins about (1, 2, -1) at
/// 2.4 rad/s.
sim::Scene spinningBlock(const sim::Vec3& speed);
/// Fills for a lattice from a hash: empty cells, slivers, half and full cells side by side.
std::vector<float> raggedFill(std::size_t cells);
/// A horizontal sheet of size^2 particles, 0.1 m apart, with two fixed corners.
sim::Scene sheet(std::uint32_t size, float compliance = 0);
/// A cuttable sheet of 9 x 9 particles, 0.1 m apart, without gravity, and a blade that halves it at x = 0.45
/// m in one step.
sim::Scene cuttableSheet();
sim::Blade bladeAcrossSheet();
/// A scene with one particle of 1 kg.
sim::Scene particleAt(sim::Vec3 position, sim::Vec3 velocity = {});

/// Message of the std::logic_error that `action` throws.
std::string refusal(const std::function<void()>& action);

/// Moves every particle by up to `distance` [m] along each axis and gives it up to `speed` [m/s] along each.
void disturb(sim::Scene& scene, float distance, float speed);
/// Adds a floor through the lowest particle and a tilted wall at the first one, with friction and
/// restitution.
void addRoom(sim::Scene& scene);

sim::Vec3 toFloats(const Eigen::Vector3d& v);
Eigen::Vector3d toVector(const sim::Vec3& v);
/// Diagonal of the bounding box [m], at least 0.1.
double sizeOf(const sim::Scene& scene);
/// Sum of the finite masses [kg].
double massOf(const sim::Scene& scene);
/// Kinetic energy of the moving particles at velocities `v` [J].
double kineticEnergy(const sim::Scene& scene, const std::vector<Eigen::Vector3d>& v);

/// One scene of each kind: empty, free particles, chains, lattices, cloth; with and without planes, skins and
/// fixed ends.
std::vector<NamedScene> allScenes();

} // namespace sinew::test
