// Candidates of contacts between particles: for each particle the others within 1.004 of contact
// distance (share_band.h) plus a margin M, or within it on their way in the substep, sorted by index. The
// device rebuilds the lists whenever a particle may have strayed from the expected motion of its body
// (body_frames.hpp) by half of M. No pair is ever missed, and no result depends on M.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/model/scene_model.hpp"

#include <vector>

namespace sinew::sim::collision::contact_lists {

/// Pairs of particles that never touch: for each state slot the index of the first of its partners in later
/// slots, one more entry for the end, then the partners of all slots, sorted. Empty = no such pair.
using Exclusions = std::vector<std::uint32_t>;

/// Linked pairs, and pairs of one linked body with a rest distance below 1.05 times contact distance. `radii`
/// by particle [m]; below 0 = touches nothing. `bodies` is that of linkedBodies().
Exclusions excludedPairs(const Scene& scene, std::span<const std::uint32_t> bodies,
                         std::span<const float> radii, const StateLayout& layout);

/// By state slot, as in linked_marks.glsl: the linked body, whether a cut may divide it, and
/// Particle::keepsRest.
std::vector<std::uint32_t> linkedMarks(const SceneModel& model);

struct Request {
    std::span<const float> radii; ///< by state slot [m]; below 0 = touches nothing
    float margin = 0;             ///< M [m]
    bool isKept = false;          ///< some pair keeps its rest distance: lists reach farther by its slack
    std::uint32_t capacity = 0;   ///< mean capacity, in candidates of a particle
    Exclusions exclusions;
    const body_frames::Bodies* bodies = nullptr; ///< as in hash_grid::Request
    bool hasWays = false;                        ///< as in hash_grid::Request
    std::uint32_t substeps = 1;                  ///< of a step
    bool hasMemory = false;                      ///< whether contacts have memory
    pooled_lists::Initial initial;
    bool listsOwners = false; ///< whether particles with a candidate are listed
};

/// Contact lists, owned by particles. A list includes pairs within the margin, which need not touch.
struct Lists {
    hash_grid::Grid grid;
    layout::FindPush push{};
    float quietMost = 0; ///< the largest radius of a particle that is in the grid [m]
    pooled_lists::Lists pooled;
    BufferId large, excluded;
    BufferId hits; ///< which candidates touch (shaders/glsl/common/hit_masks.glsl)
    bool hasOneRadius = false;
    BufferId touching; ///< slots of particles with a candidate; only if requested
};

Lists add(ProgramBuilder& program, const Request& request);

/// Appends, after the check of particles: builds the grid if lists are no longer complete, for particles that
/// are near, or were on their way. The old lists stay until addLists(). `isLast`: no other addBuild() of this
/// substep follows.
void addBuild(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved, bool isLast = true);

/// Appends the rebuild of lists if the grid was built. If they exceed their capacity the status says so
/// (StatusWords::candidates): pairs are lost, so the step must be undone.
void addLists(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved);

/// Appends the check of particles, addBuild() and addLists().
void addUpdate(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved);

} // namespace sinew::sim::collision::contact_lists
