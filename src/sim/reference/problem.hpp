// A Scene in double precision, and the parts of a substep that the sequential solvers share: half-kick
// prediction, boundary planes as temporary constraints, velocity update.
#pragma once

#include "sim/reference/cells.hpp"
#include "sinew/scene.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace sinew::sim::reference {

struct State;

struct Link {
    std::uint32_t a = 0, b = 0;
    double restLength = 0, compliance = 0; ///< [m], [m/N]
    double level =
        0; ///< in a grid: stiffness of its stiffest link of this length; otherwise its own; <= 1e20 [N/m]
    std::uint32_t constraint = 0; ///< index into Scene::distances
};

struct Bend {
    std::uint32_t a = 0, b = 0, c = 0;
    double compliance = 0;        ///< [m/N]
    std::uint32_t constraint = 0; ///< index into Scene::bends
};

struct Spring { ///< of an attachment
    std::uint32_t particle = 0;
    double compliance = 0, maxForce = 0, maxSpeed = 0; ///< [m/N], [N], [m/s]
};

struct Rope { ///< of a tether
    std::uint32_t particle = 0, anchor = 0;
    double length = 0; ///< [m]
};

struct Wall {
    Eigen::Vector3d normal;
    double offset = 0, friction = 0, staticFriction = 0, restitution = 0;
};

/// Properties of whole links of a lattice by kind. Only for grids whose cells have volumes.
struct LatticeLinks {
    std::size_t grid = 0;                    ///< index into Scene::grids
    std::vector<double> compliances, levels; ///< [m/N]; stiffness at which their shares level off [N/m]
};

/// The parts of a scene that solvers use. Links without a moving end are left out; cells are present only if
/// they have volumes.
struct Problem {
    explicit Problem(const Scene& scene);

    std::size_t size() const { return inverseMass.size(); }

    std::vector<double> inverseMass;      ///< after fixed constraints [1/kg]
    std::vector<double> contactOffset;    ///< [m]
    std::vector<std::uint32_t> linkCount; ///< links of each particle
    std::vector<std::uint32_t> bendCount; ///< bends of each particle
    std::vector<Link> links;
    std::vector<Bend> bends;     ///< those with a moving particle
    std::vector<Spring> springs; ///< one for each attachment
    std::vector<Rope> ropes;     ///< sorted by particle
    std::vector<Cell> cells;
    std::vector<LatticeLinks> lattices;
    std::vector<Wall> walls;
    Eigen::Vector3d gravity; ///< [m/s^2]
    double damping = 0;      ///< [1/s]
    double dampingTime = 0;  ///< [s]
};

Eigen::Vector3d toEigen(const Vec3& v);

/// Throws std::invalid_argument for a scene with cell volumes, which `solver` does not support.
void requireNoCells(const Scene& scene, const char* solver);

/// The walls that a particle touched: bit k = wall k.
using Touched = std::uint32_t;

/// Moves a particle that was at `before` at the start of the substep out of the walls, one after another,
/// with Coulomb friction in position form: the tangential displacement of the substep is reduced by up to
/// friction x depth.
Touched projectOntoWalls(const Problem& problem, std::size_t particle, const Eigen::Vector3d& before,
                         Eigen::Vector3d& x);

/// Newton's restitution at the touched walls, from the velocity `before` the substep; impacts slower than 2
/// |g| h do not rebound.
void rebound(const Problem& problem, Touched touched, double h, const Eigen::Vector3d& before,
             Eigen::Vector3d& v);

/// One substep in PBD order with the half-kick, for solvers that move positions: exact in free fall at any h.
class HalfKickSubstep {
public:
    /// Predicts: x += h v + h^2 g / 2.
    HalfKickSubstep(const Problem& problem, double h, State& state);
    void projectWalls();
    const std::vector<Eigen::Vector3d>& before() const { return before_; } ///< positions before the substep
    /// v += h g + corrections / h, then damping of the mean velocity dx / h, then restitution.
    void finish();

private:
    const Problem& problem_;
    double h_;
    State& state_;
    std::vector<Eigen::Vector3d> before_, predicted_; ///< positions
    std::vector<Touched> touched_;
};

} // namespace sinew::sim::reference
