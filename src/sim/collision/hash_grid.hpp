// A hash grid on the device: particles in cells, built by a counting sort
// (shaders/glsl/collision/hash_grid.glsl). It is built only when a particle has strayed from its expected
// position by more than a given distance: its passes are indirect. A scene in which nothing can meet has no
// grid.
#pragma once

#include "common/layout.h"
#include "sim/collision/body_frames.hpp"
#include "sim/program/program.hpp"

#include <array>
#include <span>

namespace sinew::sim::collision::hash_grid {

/// The contents of a grid.
struct Request {
    std::span<const float> radii; ///< by state slot, whole work groups [m]; below 0 = no particle there
    Slots slots{};                ///< those that a build visits; none = all
    float margin = 0;             ///< distance beyond contact up to which pairs must be found [m]
    float edge = 0;               ///< smallest size of a cell [m]
    /// The same while no particle moves farther than `quiet` in a substep [m]; 0 = no other size.
    float quietEdge = 0;
    std::uint32_t searching = 0; ///< pairs of faces that may search for points
    std::uint32_t linked = 0;    ///< faces or edges that others have links to; 0 = lists have no links
    std::uint32_t others = 0;    ///< items of further passes that run with a build; 0 = none
    /// Distance that a particle may move in a substep before contacts are searched along its path [m]; below
    /// 0 if particles are not checked.
    float quiet = -1;
    /// The bodies whose motion particles are expected to share; null = they are expected to stay in place.
    const body_frames::Bodies* bodies = nullptr;
    /// Slots of the state, if items of the grid are not particles. The requesting code then writes `detected`
    /// when the grid is built.
    std::size_t particles = 0;
    std::span<const float> watched; ///< by state slot: below 0 = not checked; empty = `radii`
    float reach = 0;                ///< the largest distance at which two touch [m]
    /// Whether particles are expected to keep their velocities for some substeps (headings.glsl).
    bool hasHeadings = false;
    /// Whether the speed of a particle counts against its frame. Else it counts as it is.
    bool hasWays = false;
    std::uint32_t substeps = 1;               ///< of a step
    const char* name = "grid";                ///< of its buffers
    const char* radiiName = "contacts.radii"; ///< of the buffer of radii
};

/// Particles after the motion of a substep, whole work groups.
struct Moved {
    BufferId positions;         ///< xyz [m]
    BufferId velocities;        ///< of this motion, over step.h [m/s]; w = inverse mass [1/kg]
    BufferId step;              ///< layout::StepParams
    BufferId weights = unbound; ///< inverse masses, also of sleeping particles [1/kg]; unbound = none sleeps
    BufferId groups = unbound;  ///< work groups that check their particles; unbound = all do
};

/// The largest radius in the grid [m]: twice the median, so that a few large particles do not enlarge all
/// cells; more if that would leave out more than `mostLarge`.
float largestInGrid(std::span<const float> radii);
/// The largest radius of those up to that [m].
float largestUpTo(std::span<const float> radii, float most);
constexpr std::size_t mostLarge = 64;

constexpr std::uint32_t hasWaysId = 14; // constant_id of kernels that check particles or read `ways`

/// Lists that a substep makes of what touches (shaders/glsl/collision/touched.h), which plan_grid empties.
struct Touched {
    BufferId points = unbound;    ///< arguments of passes over points: one element
    BufferId arguments = unbound; ///< of passes over particles and over rows
    BufferId lists = unbound;
    std::uint32_t slots = 0; ///< of the state; 0 = no such lists

    /// Constants of the kernels that make or visit the lists.
    ProgramBuilder::Constants constants() const {
        constexpr std::uint32_t touchedSlotsId = 9; // constant_id in touched.glsl
        return {{touchedSlotsId, slots}};
    }
};

struct Grid {
    layout::GridPush push{};
    Touched touched;
    BufferId radii, bounds, arguments, counts, sums, starts, places, sorted, detected, fast;
    BufferId ways;     ///< by which particles may come near others in the substep [m]; unbound = none
    BufferId headings; ///< velocities of particles relative to frames when lists were made; unbound = none
    Slots slots;       ///< those that passes over particles visit; none = all
    IndirectItems particles, particleChunks, cellChunks, oneGroup, others,
        patches;                  ///< of passes that run with a build
    IndirectItems searching;      ///< pairs of faces that search for points
    IndirectItems owners, linked; ///< of rows: owners of found pairs, others with links
    /// Particles that have a candidate; work groups of particles that have one in a row.
    IndirectItems touching, touchingParticles;
    IndirectItems entries; ///< all used entries of the pool; only if pairs have links
    BufferId watched;      ///< by slot: below 0 = neither it nor anything it is a corner of can touch
    /// Buffers of the pass that counts cells: positions of items (which it writes), their bodies, and the
    /// particles that are checked.
    std::array<BufferId, 3> counted;
    IndirectItems swept, unswept; ///< one item a particle: contacts may lie on its way, or cannot
    IndirectItems slowed;         ///< if too many particles are too fast
    body_frames::Frames frames;

    /// Constants of kernels that check particles, and of those that read `ways`.
    ProgramBuilder::Constants wayConstants() const { return {{hasWaysId, ways != unbound}}; }
    ProgramBuilder::Constants checkConstants() const {
        ProgramBuilder::Constants constants = frames.constants();
        constants.merge(wayConstants());
        return constants;
    }
};

Grid add(ProgramBuilder& program, const Request& request);

/// Appends the fit of frames to particles at the end of the first substep of a step, before they are checked.
void addFit(ProgramBuilder& program, const Grid& grid, const Moved& moved);

/// Appends the check of all members of frames, which decides whether the grid is built.
void addListCheckOfMembers(ProgramBuilder& program, const Grid& grid, const Moved& moved);

/// Appends a pass over the particles that a build visits; the kernel may run over a list.
template <typename Push>
void addOverParticles(ProgramBuilder& program, const Grid& grid, const vk::ShaderCode& code,
                      const std::vector<BufferId>& buffers, const Push& push,
                      ProgramBuilder::Constants constants = {}) {
    if (grid.slots.items == 0)
        return program.dispatchIndirect(code, grid.particles, buffers, push, constants);
    constants.emplace(RUNS_OVER_ID, RUNS_OVER_ITEMS);
    program.dispatchListed(code, grid.particles, buffers, grid.slots.list, push, constants);
}

/// Appends, after the check: builds the grid of items at `positions`, if it is needed. Stores headings if
/// items are particles; else the requesting code does. `points`: counters of motions (face_points.h), only
/// with headings.
void addCells(ProgramBuilder& program, const Grid& grid, BufferId positions, const Moved& moved,
              BufferId points = unbound);

/// Appends the check of particles.
void addListCheck(ProgramBuilder& program, const Grid& grid, const Moved& moved);

/// Appends, after the check by addListCheck() or another pass: builds the grid of particles if it is needed.
/// Particles too fast for cells are listed, up to MOST_FAST; if there are more, all of them are slowed down
/// first, which the status counts. `isLast`: no other addBuild() of this substep follows.
void addBuild(ProgramBuilder& program, const Grid& grid, const Moved& moved, bool isLast = true);

} // namespace sinew::sim::collision::hash_grid
