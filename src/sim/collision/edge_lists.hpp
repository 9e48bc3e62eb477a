// Which edges of faces may touch each other before their lists are made again: for each edge the others
// nearer than touching, a margin M and what both move in a substep, sorted by index. As for points and faces
// (face_lists), no pair that meets is ever missed, and no result depends on M. Candidates are found in a hash
// grid of the middles of edges; an edge stands for the ball around it that holds it.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/compile.hpp"

#include <array>
#include <vector>

namespace sinew::sim::collision::edge_lists {

/// An edge of a face, between state slots.
struct Edge {
    std::array<std::uint32_t, 2> ends{}; ///< ascending
    float thickness = 0;                 ///< from its middle [m]
    float radius = 0;                    ///< of the ball around it [m]
    bool moves = false;
};

struct Request {
    std::span<const Edge> edges;
    /// Edges that one never touches though they share no end: for each edge the first of them, one more for
    /// the end, then the edges of all, sorted.
    std::span<const std::uint32_t> exclusions;
    float margin = 0;           ///< M [m]
    float beyond = 0;           ///< how much farther than touching and M pairs are listed besides [m]
    std::uint32_t capacity = 0; ///< edges near an edge, on average
    bool usesTexels = true;
    std::size_t particles = 0;                   ///< slots of the state
    const body_frames::Bodies* bodies = nullptr; ///< as hash_grid::Request has them
    std::uint32_t substeps = 1;                  ///< of a step
};

/// Owners are edges. A pair is in the list of one that moves, if the other never does; else half of all edges
/// own it for each. The other has a link.
struct Lists {
    hash_grid::Grid grid;
    layout::FaceFindPush push{};
    pooled_lists::Lists pooled;
    BufferId edges;
    BufferId radii, thickness, middles, speeds, excluded, points, apart;
    BufferId touching, marks; ///< work groups of particles of which one is an end of an edge with a candidate
};

Lists add(ProgramBuilder& program, const Request& request);

/// Once a step, at the end of its first substep, before addWatch().
void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Watches where the ends of edges have gone, and builds the grid where lists are no longer complete. Until
/// addLists() the old lists stand.
void addWatch(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Makes the lists where the grid was built. One that does not fit its room is said in the status
/// (StatusWords::candidates): what it lacks is lost, so the step must be undone.
void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

} // namespace sinew::sim::collision::edge_lists
