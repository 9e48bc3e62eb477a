// Scene + Settings -> StepProgram. compile.cpp lists the features of a step, one line each.
#pragma once

#include "sim/program.hpp"
#include "sim/scene.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace sinew::sim {

/// Particles on full grids of equal size, one box after another: a kernel computes their slots.
struct EqualBoxes {
    std::uint32_t particles = 0;          ///< of each grid; a node (x, y, z) is x + nodesX (y + nodesY z)
    std::uint32_t nodesX = 0, nodesY = 0; ///< of each grid
    std::uint32_t origin = 0;             ///< slot of the first particle
    std::uint32_t rowStride = 0, sliceStride = 0; ///< distance in slots between neighbours in y, in z
    std::uint32_t boxStride = 0;                  ///< distance in slots between grids
};

namespace sleep {
struct Sleep;
}
namespace constraints::grab {
struct Grabs;
}
namespace forces {
struct Forces;
}

/// Order of the particles in a solver's state: the order of the scene in most solvers; `split` places bodies
/// on a grid into dense boxes. Slots without a particle never move.
struct StateLayout {
    std::vector<std::uint32_t> slot; ///< by particle
    std::size_t count = 0; ///< number of slots: whole work groups, so that a kernel needs no bounds check
    bool isInOrder = true; ///< slot[i] == i
    std::optional<EqualBoxes> boxes; ///< a rule equivalent to `slot`, if there is one
    bool hasRemainders = false;      ///< positions have a second half: rounding remainders (rounding.hpp)
};
StateLayout orderedLayout(std::size_t particles);
/// The slots that hold a particle, ascending.
std::vector<std::uint32_t> slotsInOrder(const StateLayout& layout);

/// Elements of a buffer of positions: one for each slot, twice as many with remainders.
std::size_t positionCount(const StateLayout& layout);
/// Specialisation constants of kernels that write positions.
ProgramBuilder::Constants remainderConstants(const StateLayout& layout);

/// Buffers that the solver and all features share while a program is built.
struct ParticleBuffers {
    std::uint32_t count = 0;
    BufferId step;       ///< layout::StepParams
    BufferId positions;  ///< of the solver's state, positionCount elements; w depends on the solver
    BufferId velocities; ///< layout.count elements; w = inverse mass [1/kg], 0 while asleep
    StateLayout layout;
    std::shared_ptr<sleep::Sleep> sleep;             ///< null if nothing sleeps
    std::shared_ptr<constraints::grab::Grabs> grabs; ///< null without grabs
    std::shared_ptr<const forces::Forces> forces;    ///< null if no forces are kept
};

/// Share of the gravity kick h g, contained in the velocities, that particles have moved by when links are
/// solved.
enum class Kick { whole, half };

/// A solver's choices for a scene, made before anything is built.
struct SolverPlan {
    StateLayout layout;
    std::vector<float> positionW; ///< by particle: the w of the state's positions
    /// Appends the passes of the phase "solve". Refers to the scene and contains all other inputs of the
    /// plan.
    std::function<void(ProgramBuilder& program, const ParticleBuffers& particles)> addPasses;
};

/// `particles` rounded up to whole work groups.
std::size_t paddedCount(std::size_t particles);

/// Compiles a valid scene (validate() returned nothing). Forms that the settings leave open are those of a
/// software device. Throws std::invalid_argument for invalid settings, and std::logic_error for an internal
/// error.
StepProgram compile(const Scene& scene, const Settings& settings);

/// Order of the particles in the solver of `settings`, in any program compiled from both.
StateLayout stateLayout(const Scene& scene, const Settings& settings);

/// Inverse mass of every particle after fixed constraints [1/kg]; 0 = never moves.
std::vector<float> inverseMasses(const Scene& scene);

/// "jacobi", "split" or "gauss_seidel".
const char* solverName(Solver solver);
/// Returns false for an unknown name. The list of names stands only here.
bool parseSolver(const std::string& name, Solver& solver);
std::vector<std::string> solverNames();

} // namespace sinew::sim
