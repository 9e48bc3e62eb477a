// Which points may touch which faces before their lists are made again: for each point the faces nearer than
// touching, a margin M and what both move in a substep, sorted by index; for each face with a corner that
// moves, its points. Made on the device whenever a particle may have strayed from where its body is expected
// by half of M, in a substep or since: no pair that meets is ever missed, and no result depends on M.
// Candidates are found face by face in a hash grid of the points; a few large faces are compared with every
// point, wide or fast points with every face.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/compile.hpp"

#include <vector>

namespace sinew::sim::collision::face_lists {

/// Points and faces that can touch, between state slots.
struct Request {
    std::span<const float> radii;         ///< by state slot, whole work groups [m]; below 0 = touches no face
    std::span<const float> inverseMasses; ///< likewise; 0 = never moves [1/kg]
    std::span<const layout::ContactFace> faces;
    std::uint32_t moving = 0; ///< faces before that one have a corner that moves
    /// By face: the longest side of its box at first [m]. Below 0 of one that a cut may lay open: it has
    /// no part in how large cells are, and is searched in the grid.
    std::span<const float> extents;
    /// Points that a face never touches: for each face the first of them, one more for the end, then the
    /// points of all, sorted. A row that ends with EXCLUDED_LINKED | k is of a body that may be cut: its face
    /// does not touch what a live link joins to a corner either. Words k and k + 1 are the strides between
    /// rows and slices of its slots. Word k + 2 = 1: what diagonals alone join to corners touches at
    /// LINKED_REACH.
    std::span<const std::uint32_t> exclusions;
    BufferId liveLinks;         ///< CuttingBuffers::links; only where there are such rows
    float margin = 0;           ///< M [m]
    float beyond = 0;           ///< how much farther than touching and M pairs are listed besides [m]
    std::uint32_t capacity = 0; ///< faces near a point, on average
    bool usesTexels = true;
    const body_frames::Bodies* bodies = nullptr; ///< as hash_grid::Request has them
    std::uint32_t substeps = 1;                  ///< of a step
};

/// Owners are points, and faces that move have links.
struct Lists {
    hash_grid::Grid grid;
    layout::FaceFindPush push{};
    pooled_lists::Lists pooled;
    BufferId radii, inverseMasses, faces, excluded;
    BufferId points, searched, large;
    BufferId apart;           ///< points that the grid is too fine for; behind them faces that are
    BufferId liveLinks;       ///< as Request has it
    BufferId touching, marks; ///< work groups of particles of which one is in a list, as point or corner
};

Lists add(ProgramBuilder& program, const Request& request);

/// Once a step, at the end of its first substep, before addWatch().
void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Watches where `particles` have gone, and builds the grid of them where lists are no longer complete. Until
/// addLists() the old lists stand.
void addWatch(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Makes the lists where the grid was built. One that does not fit its room is said in the status
/// (StatusWords::candidates): what it lacks is lost, so the step must be undone.
void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

} // namespace sinew::sim::collision::face_lists
