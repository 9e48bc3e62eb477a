// Slots of the state: the layout in which a solver keeps its particles, and the buffers that features share.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/scene.hpp"

#include <memory>
#include <optional>
#include <vector>

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

namespace grabs {
struct Grabs;
}

namespace forces {
struct Forces;
}

namespace events {
struct Events;
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

/// The slots that hold a particle, then others up to whole work groups, if these are at most three quarters
/// of all slots; else none.
std::vector<std::uint32_t> compactSlots(const StateLayout& layout);

/// `particles` rounded up to whole work groups.
std::size_t paddedCount(std::size_t particles);

/// By slot: index of the particle's body in Scene::bodies, or `none`.
std::vector<std::uint32_t> bodiesOfSlots(const Scene& scene, const StateLayout& layout, std::uint32_t none);

/// Elements of a buffer of positions: one for each slot, twice as many with remainders.
std::size_t positionCount(const StateLayout& layout);

/// Specialisation constants of kernels that write positions.
ProgramBuilder::Constants remainderConstants(const StateLayout& layout);

/// Buffers that the solver and all features share while a program is built.
struct ParticleBuffers {
    std::uint32_t count = 0;
    BufferId step;      ///< layout::StepParams
    BufferId positions; ///< of the solver's state, positionCount elements; w depends on the solver
    /// The most that w of positions may be, a float a slot, where the state itself moves it: tau of bodies at
    /// rest with a sharp clamp. Unbound elsewhere.
    BufferId mostW = unbound;
    BufferId velocities; ///< layout.count elements; w = inverse mass [1/kg], 0 while asleep
    StateLayout layout;
    std::shared_ptr<sleep::Sleep> sleep;          ///< null if nothing sleeps
    std::shared_ptr<grabs::Grabs> grabs;          ///< null without grabs
    std::shared_ptr<const forces::Forces> forces; ///< null if no forces are kept
    std::shared_ptr<events::Events> events;       ///< null if no events are listed
    BufferId received = unbound; ///< impulses of the contacts of a substep (collision/recoils.hpp)
    float supportReach = 0; ///< beyond contact offsets, up to which contacts with colliders are events [m]
};

/// The constant of kernels that keep what particles receive from contacts in a substep.
ProgramBuilder::Constants receivedConstants(const ParticleBuffers& particles);

/// Share of the gravity kick h g, contained in the velocities, that particles have moved by when links are
/// solved.
enum class Kick { whole, half };

} // namespace sinew::sim
