// A hash grid on the device: particles in cells, built by a counting sort (shaders/glsl/hash_grid.glsl)
// whenever one of them has strayed farther than a given way from where it is expected, and only then: the
// passes that build it are indirect. A scene in which nothing can meet has none of this.
#pragma once

#include "layout.h"
#include "sim/collision/body_frames.hpp"
#include "sim/program.hpp"

#include <array>
#include <span>

namespace sinew::sim::collision::hash_grid {

/// What to put into the grid.
struct Request {
    std::span<const float> radii; ///< by state slot, whole work groups [m]; below 0 = no particle there
    float margin = 0; ///< how much farther than touching two particles may be and must still be found [m]
    float edge = 0;   ///< of a cell, at least [m]
    std::uint32_t others = 0; ///< items of further passes that run with a build; 0 = none
    /// How far a particle may move in a substep before contacts are looked for on its way [m]; below 0 where
    /// nobody watches.
    float quiet = -1;
    bool usesTexels = true;
    /// The bodies whose motion particles are expected to share; null = they are expected to stay.
    const body_frames::Bodies* bodies = nullptr;
    /// Slots of the state, where items of the grid are something else. `detected` is then written by whoever
    /// asks, when the grid is built.
    std::size_t particles = 0;
    std::span<const float> watched;           ///< by state slot: below 0 = never watched; empty = `radii`
    float reach = 0;                          ///< the largest at which two touch [m]
    std::uint32_t substeps = 1;               ///< of a step
    const char* name = "grid";                ///< of its buffers
    const char* radiiName = "contacts.radii"; ///< of that one
};

/// Particles where a substep has taken them, whole work groups.
struct Moved {
    BufferId positions;  ///< xyz [m]
    BufferId velocities; ///< with which they came there in step.h [m/s]; w = inverse mass [1/kg]
    BufferId step;       ///< layout::StepParams
};

/// The largest radius in the grid [m]: twice the median, so that a few large particles do not make
/// everybody's cells large; more where that would leave out more than `mostLarge`.
float largestInGrid(std::span<const float> radii);
constexpr std::size_t mostLarge = 64;

struct Grid {
    layout::GridPush push{};
    bool usesTexels = true;
    BufferId radii, bounds, arguments, counts, sums, starts, places, sorted, detected, fast;
    IndirectItems particles, particleChunks, cellChunks, oneGroup,
        others; ///< of passes that run with a build
    /// Items in work groups of which one has a candidate: owners of lists, particles.
    IndirectItems touching, touchingParticles;
    IndirectItems entries; ///< all entries of the pool that are in use; only where pairs have links
    BufferId watched;      ///< by slot: below 0 = nothing can touch it, nor what it is a corner of
    /// Bound by the pass that counts cells: places of items (it writes them), their bodies, which are
    /// watched.
    std::array<BufferId, 3> counted;
    IndirectItems swept, unswept; ///< likewise, a particle each, where contacts may or cannot lie on the way
    IndirectItems slowed;         ///< where too many are too fast
    body_frames::Frames frames;
};

Grid add(ProgramBuilder& program, const Request& request);

/// Fits frames to particles at the end of the first substep of a step, before they are watched.
void addFit(ProgramBuilder& program, const Grid& grid, const Moved& moved);

/// Watches all particles that are members of frames, and says whether the grid is built.
void addWatchOfMembers(ProgramBuilder& program, const Grid& grid, const Moved& moved);

/// After it: builds the grid of items at `positions`, where it is.
void addCells(ProgramBuilder& program, const Grid& grid, BufferId positions);

/// Watches particles.
void addWatch(ProgramBuilder& program, const Grid& grid, const Moved& moved);

/// After they were watched, by addWatch() or another pass: builds the grid of them where it must be.
/// Particles too fast for cells are listed, up to MOST_FAST; where there are more, all of those are slowed
/// down first, which the status counts. `isLast`: no other addBuild() of this substep follows.
void addBuild(ProgramBuilder& program, const Grid& grid, const Moved& moved, bool isLast = true);

} // namespace sinew::sim::collision::hash_grid
