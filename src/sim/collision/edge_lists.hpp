// Candidates of contacts between edges of faces: for each edge the others within contact distance, a margin M
// and their motion in a substep, sorted by index. Like in face_lists, no pair that meets is ever missed, and
// no result depends on M. Candidates are found in a hash grid of the midpoints of edges; an edge is
// represented by its bounding sphere.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/model/state.hpp"

#include <array>
#include <vector>

namespace sinew::sim::collision::edge_lists {

/// An edge of a face, between state slots.
struct Edge {
    std::array<std::uint32_t, 2> ends{}; ///< ascending
    float thickness = 0;                 ///< from its axis [m]
    float radius = 0;                    ///< of its bounding sphere [m]
    bool moves = false;
};

struct Request {
    std::span<const Edge> edges;
    /// Edges that an edge never touches although they share no end: for each edge the first of them, one more
    /// entry for the end, then the edges of all, sorted.
    std::span<const std::uint32_t> exclusions;
    float margin = 0;                            ///< M [m]
    float beyond = 0;                            ///< additional listing distance beyond contact and M [m]
    std::uint32_t capacity = 0;                  ///< mean capacity, in edges near an edge
    std::size_t particles = 0;                   ///< slots of the state
    const body_frames::Bodies* bodies = nullptr; ///< as in hash_grid::Request
    std::uint32_t substeps = 1;                  ///< of a step
};

/// Lists owned by edges. If one edge of a pair never moves, the moving one owns the pair; otherwise ownership
/// is spread so that each edge owns about half of its pairs. The other edge has a link.
struct Lists {
    hash_grid::Grid grid;
    layout::FaceFindPush push{};
    pooled_lists::Lists pooled;
    BufferId edges;
    BufferId radii, thickness, middles, speeds, excluded, points;
    BufferId touching, marks; ///< work groups of particles with an end of an edge in a list
};

Lists add(ProgramBuilder& program, const Request& request);

/// Appends the fit of frames: once a step, at the end of its first substep, before addListCheck().
void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Appends the check of the ends of edges, and builds the grid if lists are no longer complete. The old lists
/// stay until addLists().
void addListCheck(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Appends the rebuild of lists if the grid was built. If they exceed their capacity the status says so
/// (StatusWords::candidates): pairs are lost, so the step must be undone.
void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

} // namespace sinew::sim::collision::edge_lists
