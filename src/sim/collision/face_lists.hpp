// Candidates of contacts between points and faces: for each point the faces within contact distance, a margin
// M and their motion in a substep, sorted by index; for each face with a moving corner, its points. The
// device rebuilds the lists whenever a particle may have strayed from the expected motion of its body by half
// of M, in a substep or since the last rebuild: no pair that meets is ever missed, and no result depends on
// M. Candidates are found face by face in a hash grid of the points; a few large faces are compared with
// every point, wide or fast points with every face.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/collision/sheet_patches.hpp"
#include "sim/model/state.hpp"

#include <vector>

namespace sinew::sim::collision::face_lists {

/// Points and faces that can touch, in state slots.
struct Request {
    std::span<const float> radii;         ///< by state slot, whole work groups [m]; below 0 = touches no face
    std::span<const float> inverseMasses; ///< by state slot; 0 = never moves [1/kg]
    std::span<const layout::ContactFace> faces;
    std::uint32_t moving = 0; ///< faces before this one have a moving corner
    /// By face: the longest side of its initial box [m]. Below 0 for a face that a cut may expose: it does
    /// not affect the size of cells, and is searched in the grid.
    std::span<const float> extents;
    /// Points that a face never touches: for each face the first of them, one more entry for the end, then
    /// the points of all, sorted. A row that ends with EXCLUDED_LINKED | k belongs to a cuttable body: its
    /// face does not touch points that a live link joins to a corner either. Words k and k + 1 are the
    /// strides between rows and slices of its slots. Word k + 2 = 1: points joined to corners only by
    /// diagonals touch at LINKED_REACH.
    std::span<const std::uint32_t> exclusions;
    std::span<const sheet_patches::Sheet> sheets; ///< whose faces search in patches
    bool sharesPatches = false;                   ///< several invocations check a patch, as suits a GPU
    BufferId liveLinks;                           ///< CuttingBuffers::links; only if there are such rows
    float margin = 0;                             ///< M [m]
    float beyond = 0;                             ///< additional listing distance beyond contact and M [m]
    std::uint32_t capacity = 0;                   ///< mean capacity, in faces near a point
    const body_frames::Bodies* bodies = nullptr;  ///< as in hash_grid::Request
    std::uint32_t substeps = 1;                   ///< of a step
};

/// Lists owned by points; moving faces have links.
struct Lists {
    hash_grid::Grid grid;
    layout::FaceFindPush push{};
    pooled_lists::Lists pooled;
    BufferId radii, inverseMasses, faces, excluded;
    BufferId points; ///< FACE_POINTS_...: the points that the grid is too fine for, such faces
    BufferId searched, large;
    sheet_patches::Patches patches;
    BufferId liveLinks;       ///< as in Request
    BufferId touching, marks; ///< work groups with a particle that is a point or corner in a list
};

Lists add(ProgramBuilder& program, const Request& request);

/// Appends the fit of frames: once a step, at the end of its first substep, before addListCheck().
void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Appends the check of the motion of `particles`, and builds their grid if lists are no longer complete. The
/// old lists stay until addLists().
void addListCheck(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

/// Appends the rebuild of lists if the grid was built. If they exceed their capacity the status says so
/// (StatusWords::candidates): pairs are lost, so the step must be undone.
void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles);

} // namespace sinew::sim::collision::face_lists
