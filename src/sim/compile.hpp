// Scene + Settings -> StepProgram. The table of contents of a step: one line per feature.
#pragma once

#include "sim/program.hpp"
#include "sim/scene.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace sinew::sim {

/// Particles on full grids of one size, box behind box: a kernel computes their slots.
struct EqualBoxes {
    std::uint32_t particles = 0;          ///< of each grid; a node (x, y, z) is x + nodesX (y + nodesY z)
    std::uint32_t nodesX = 0, nodesY = 0; ///< of each grid
    std::uint32_t origin = 0;             ///< slot of the first particle
    std::uint32_t rowStride = 0, sliceStride = 0; ///< slots from a node to the next in y, in z
    std::uint32_t boxStride = 0;                  ///< slots from a grid to the next
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

/// Where a solver keeps its particles: most in the order of the scene, `split` spreads bodies on a grid over
/// dense boxes. Slots that hold no particle never move.
struct StateLayout {
    std::vector<std::uint32_t> slot; ///< of each particle
    std::size_t count = 0; ///< slots, whole work groups, so that a kernel may do without a bounds check
    bool isInOrder = true; ///< slot[i] == i
    std::optional<EqualBoxes> boxes; ///< the same as `slot`, where there is such a rule
    bool hasRemainders = false;      ///< positions have a second half: what rounding has taken (rounding.hpp)
};
StateLayout orderedLayout(std::size_t particles);
/// The slots that hold a particle, ascending.
std::vector<std::uint32_t> slotsInOrder(const StateLayout& layout);

/// Elements of a buffer of positions: those of all slots, and as many for their remainders where it has some.
std::size_t positionCount(const StateLayout& layout);
/// Constants that specialise kernels which write positions.
ProgramBuilder::Constants remainderConstants(const StateLayout& layout);

/// Buffers that every solver and feature shares while a program is built.
struct ParticleBuffers {
    std::uint32_t count = 0;
    BufferId step;       ///< layout::StepParams
    BufferId positions;  ///< of the solver's state, positionCount elements; meaning of w is the solver's
    BufferId velocities; ///< layout.count elements; w = inverse mass [1/kg], 0 while asleep
    StateLayout layout;
    std::shared_ptr<sleep::Sleep> sleep;             ///< none where nothing sleeps
    std::shared_ptr<constraints::grab::Grabs> grabs; ///< none without hands
    std::shared_ptr<const forces::Forces> forces;    ///< none where a step keeps none
};

/// How much of the h g in its velocities a solver has moved its particles by when links are solved.
enum class Kick { whole, half };

/// What a solver makes of a scene before anything is built.
struct SolverPlan {
    StateLayout layout;
    std::vector<float> positionW; ///< of every particle: the w of the state's positions
    /// Appends the passes of the phase "solve". Refers to the scene; all else that the plan was made from is
    /// in it.
    std::function<void(ProgramBuilder& program, const ParticleBuffers& particles)> addPasses;
};

/// `particles` rounded up to whole work groups.
std::size_t paddedCount(std::size_t particles);

/// `scene` must be valid (validate returned nothing). Forms that the settings leave open are those of a
/// software device. Throws std::invalid_argument for settings that are not, and std::logic_error for faults
/// of ours.
StepProgram compile(const Scene& scene, const Settings& settings);

/// Where the solver of `settings` keeps the particles, in any program compiled from both.
StateLayout stateLayout(const Scene& scene, const Settings& settings);

/// Inverse mass of every particle after fixed constraints [1/kg]; 0 = never moves.
std::vector<float> inverseMasses(const Scene& scene);

/// "jacobi", "split" or "gauss_seidel".
const char* solverName(Solver solver);
/// Returns false for a name that is none. The list is the one place solvers are named.
bool parseSolver(const std::string& name, Solver& solver);
std::vector<std::string> solverNames();

} // namespace sinew::sim
