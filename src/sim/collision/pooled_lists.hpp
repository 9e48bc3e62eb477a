// Lists of what may touch whom, in one pool: each as long as it has to be, so that one owner may have many
// candidates where others have few (shaders/glsl/listed_pairs.glsl, sort_lists.comp). A search writes pairs,
// in chains of both owners; lists are made of chains. What contacts remember goes with them: how far two have
// slid, the side on which a face or an edge was met, how much two still overlap of what they did when the
// scene was loaded. It is carried from old lists to new ones, saved with every step that comes to its end,
// and taken back with one that is undone.
#pragma once

#include "sim/collision/hash_grid.hpp"
#include "sim/compile.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sinew::sim::collision::pooled_lists {

/// Before the first step; empty = nobody is listed.
struct Initial {
    std::vector<layout::ListRange> ranges;
    std::vector<layout::ContactCandidate> contacts;
    std::vector<layout::vec4> memory;
};

struct Request {
    std::string name; ///< of buffers: `name`.pairs and so on
    std::size_t owners = 0;
    std::uint32_t each = 0; ///< entries of a list that there is room for, on average
    /// A pair is in the list of one owner, the other of this many others has a link to it; 0 = a pair is in
    /// the lists of both.
    std::size_t others = 0;
    bool hasMemory = false;
    Initial initial;
};

/// Memory that was put away: where that of each owner stands, what, and of whom.
struct Kept {
    BufferId ranges, memory, others;
};

struct Memory {
    BufferId memory; ///< vec4 an entry
    Kept kept;       ///< while lists are made again
    Kept saved;      ///< of the last step that came to its end
};

/// Index from the other of a pair to its entries: elements[ranges[f].first + s] is the entry of pair s of f.
struct Links {
    BufferId elements, ranges;
    BufferId chains; ///< of pairs
    BufferId owners; ///< by element of `contacts`
};

/// Element ranges[i].first + s of `contacts` is candidate s of owner i (layout::ListRange,
/// layout::ContactCandidate).
struct Lists {
    std::uint32_t room = 0; ///< entries of all together
    BufferId contacts, ranges;
    BufferId pairs;  ///< uvec4 each; behind them, entries while they are sorted
    BufferId chains; ///< by owner
    std::optional<Memory> memory;
    std::optional<Links> links;
};

Lists add(ProgramBuilder& program, const Request& request);

/// The buffers of a kernel that puts memory away (keep_list.glsl).
std::vector<BufferId> keepingBuffers(const Lists& lists);

/// The first buffers of sort_lists.comp. `radii` by owner.
std::vector<BufferId> sortingBuffers(ProgramBuilder& program, const Lists& lists, const hash_grid::Grid& grid,
                                     BufferId radii);

/// The entries of a pool that are in use, as items of a pass; plan_grid and link_rows say how many.
IndirectItems entriesInUse(const Lists& lists, const hash_grid::Grid& grid);

/// The end of a step. Lists of an undone step are made again; while all sleeps none are.
void addPublishing(ProgramBuilder& program, const Lists& lists, const hash_grid::Grid& grid);

} // namespace sinew::sim::collision::pooled_lists
