// Which particles may touch before their lists are made again: for each particle the others nearer than
// touching and a margin M, or were so on their way in the substep, sorted by index, made on the device
// whenever one may have strayed from where its body is expected (body_frames.hpp) by half of M. No pair is
// ever missed, and no result depends on M.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/compile.hpp"

#include <vector>

namespace sinew::sim::collision::contact_lists {

/// Pairs of particles that never touch: for each state slot the first of its partners, one more for the end,
/// then the partners of all, sorted. Empty = no such pair.
using Exclusions = std::vector<std::uint32_t>;

/// Linked ones, and those of one linked body that are at rest nearer than 1.05 times touching. `radii` by
/// particle [m]; below 0 = touches nothing.
Exclusions excludedPairs(const Scene& scene, std::span<const float> radii, const StateLayout& layout);

/// The smallest particle of each one's linked body.
std::vector<std::uint32_t> linkedBodies(const Scene& scene);

/// By state slot, as linked_marks.glsl has them: the linked body, whether a cut may part it, and
/// Particle::keepsRest.
std::vector<std::uint32_t> linkedMarks(const Scene& scene, const StateLayout& layout);

struct Request {
    std::span<const float> radii; ///< by state slot [m]; below 0 = touches nothing
    float margin = 0;             ///< M [m]
    bool isKept = false;          ///< some pair keeps its rest distance: lists reach farther by its slack
    std::uint32_t capacity = 0;   ///< candidates of a particle that there is room for, on average
    Exclusions exclusions;
    bool usesTexels = true;
    const body_frames::Bodies* bodies = nullptr; ///< as hash_grid::Request has them
    std::uint32_t substeps = 1;                  ///< of a step
    bool hasMemory = false;                      ///< whether contacts remember something
    pooled_lists::Initial initial;
    bool listsGroups = false; ///< whether groups in which a particle has a candidate are listed
};

/// Owners are particles. The margin is part of a list: a pair in it need not touch.
struct Lists {
    hash_grid::Grid grid;
    layout::FindPush push{};
    pooled_lists::Lists pooled;
    BufferId large, excluded;
    bool hasOneRadius = false;
    BufferId touching, marks; ///< work groups in which a particle has a candidate; only where asked for
};

Lists add(ProgramBuilder& program, const Request& request);

/// After particles were watched: builds the grid of them where lists are no longer complete, for those that
/// are near, or were on their way. Until addLists() the old lists stand. `isLast`: no other
/// addBuild() of this substep follows.
void addBuild(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved, bool isLast = true);

/// Makes the lists where the grid was built. Where they do not fit their room the status says so
/// (StatusWords::candidates): pairs are lost, so the step must be undone.
void addLists(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved);

/// Watches particles, and both.
void addUpdate(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved);

} // namespace sinew::sim::collision::contact_lists
