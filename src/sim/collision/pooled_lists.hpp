// Contact lists in a common pool: each list has the length it needs, so that one owner may have many
// candidates while others have few (shaders/glsl/collision/listed_pairs.glsl, sort_lists.comp). A search
// writes pairs, in chains of both owners; lists are made from the chains. Entries carry the memory of
// contacts: slip, the side on which a face or an edge was met, and the remaining part of an overlap that
// existed when the scene was loaded. Memory is copied from old lists to new ones, saved after every finished
// step, and restored after an undone one.
#pragma once

#include "sim/collision/hash_grid.hpp"
#include "sim/program/program.hpp"
#include "sinew/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sinew::sim::collision::pooled_lists {

/// Contents before the first step; empty = no candidates.
struct Initial {
    std::vector<layout::ListRange> ranges;
    std::vector<layout::ContactCandidate> contacts;
    std::vector<layout::vec4> memory;
};

struct Request {
    std::string name; ///< of buffers: `name`.pairs and so on
    std::size_t owners = 0;
    std::uint32_t each = 0; ///< mean capacity of a list, in entries
    /// If above 0, a pair is in the list of one owner, and the other element, one of this many, has a link to
    /// it; 0 = a pair is in the lists of both.
    std::size_t others = 0;
    bool hasMemory = false;
    Initial initial;
};

/// A saved copy of memory: its range for each owner, its values, and the other element of each pair.
struct Kept {
    BufferId ranges, memory, others;
};

struct Memory {
    BufferId memory; ///< vec4 an entry
    Kept kept;       ///< during a rebuild of lists
    Kept saved;      ///< of the last finished step
};

/// Index from the other element of a pair to its entries: elements[ranges[f].first + s] is the entry of pair
/// s of f.
struct Links {
    BufferId elements, ranges;
    BufferId chains; ///< of pairs
    BufferId owners; ///< by element of `contacts`
};

/// Contact lists: element ranges[i].first + s of `contacts` is candidate s of owner i (layout::ListRange,
/// layout::ContactCandidate).
struct Lists {
    std::uint32_t room = 0; ///< capacity of all lists, in entries
    BufferId contacts, ranges;
    BufferId pairs;  ///< uvec4 each; also used for entries during sorting
    BufferId chains; ///< by owner
    std::optional<Memory> memory;
    std::optional<Links> links;
};

Lists add(ProgramBuilder& program, const Request& request);

/// The buffers of a kernel that saves memory (keep_list.glsl).
std::vector<BufferId> keepingBuffers(const Lists& lists);

/// Appends, after a search for rows: the plan of the passes that make lists of the found pairs. `points`:
/// FACE_POINTS_...; `kind`: constants of row_contacts::Kind.
void addPlan(ProgramBuilder& program, const hash_grid::Grid& grid, BufferId points,
             const layout::FaceFindPush& push, const ProgramBuilder::Constants& kind);

/// The first buffers of sort_lists.comp. `radii` by owner.
std::vector<BufferId> sortingBuffers(ProgramBuilder& program, const Lists& lists, const hash_grid::Grid& grid,
                                     BufferId radii);

/// The used entries of a pool, as items of a pass; plan_grid and plan_rows write their number.
IndirectItems entriesInUse(const Lists& lists, const hash_grid::Grid& grid);

/// Appends the end of a step. Lists of an undone step are made again; no lists are made while everything
/// sleeps.
void addPublishing(ProgramBuilder& program, const Lists& lists, const hash_grid::Grid& grid);

} // namespace sinew::sim::collision::pooled_lists
