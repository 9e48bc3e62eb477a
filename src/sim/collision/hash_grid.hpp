// A hash grid on the device: particles in cells, built by a counting sort (shaders/glsl/hash_grid.glsl)
// whenever one of them has moved farther than a given way, and only then: the passes that build it are
// indirect. A scene in which nothing can meet has none of this.
#pragma once

#include "layout.h"
#include "sim/program.hpp"

#include <span>

namespace sinew::sim::collision::hash_grid {

/// What to put into the grid.
struct Request {
    std::span<const float> radii; ///< by state slot, whole work groups [m]; below 0 = no particle there
    float margin = 0; ///< how much farther than touching two particles may be and must still be found [m]
    float slack = 0;  ///< how far a particle may move before the grid is built again [m]
    float edge = 0;   ///< of a cell, at least [m]
    std::uint32_t others = 0; ///< items of further passes that run with a build; 0 = none
    bool usesTexels = true;
    const char* name = "grid";                ///< of its buffers
    const char* radiiName = "contacts.radii"; ///< of that one
};

/// The largest radius in the grid [m]: twice the median, so that a few large particles do not make
/// everybody's cells large; more where that would leave out more than `mostLarge`.
float largestInGrid(std::span<const float> radii);
constexpr std::size_t mostLarge = 64;

struct Grid {
    layout::GridPush push{};
    bool usesTexels = true;
    BufferId radii, bounds, arguments, counts, sums, starts, places, sorted, detected;
    IndirectItems particles, particleChunks, cellChunks, oneGroup,
        others; ///< of passes that run with a build
};

Grid add(ProgramBuilder& program, const Request& request);

/// Builds the grid of `positions` where bounds.moved says that somebody has gone too far.
void addSort(ProgramBuilder& program, const Grid& grid, BufferId positions);

/// Watches `positions` and builds the grid of them where it must be.
void addBuild(ProgramBuilder& program, const Grid& grid, BufferId positions);

} // namespace sinew::sim::collision::hash_grid
