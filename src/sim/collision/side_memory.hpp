// What contacts with faces and between edges remember of each candidate: the side on which the two are, how
// far they have slid, and how much they still overlap of what they did when the scene was loaded. Carried
// from lists to lists, saved with every step that comes to its end and taken back with one that is undone.
#pragma once

#include "sim/collision/hash_grid.hpp"
#include "sim/compile.hpp"

#include <string>

namespace sinew::sim::collision::side_memory {

struct Memory {
    BufferId memory;           ///< vec4 a candidate
    BufferId contacts, counts; ///< the lists that it belongs to
    BufferId kept, keptOthers, keptCounts, saved, savedOthers, savedCounts;
    hash_grid::Grid grid; ///< which is built where lists are made again
    layout::FacePush push{};
};

/// For `elements` candidates in lists of push.count points or edges. Buffers are called `name`.memory and so
/// on.
Memory add(ProgramBuilder& program, const std::string& name, BufferId contacts, BufferId counts,
           const hash_grid::Grid& grid, const layout::FacePush& push, std::size_t elements);

/// Before lists are made again, and after.
void addKeeping(ProgramBuilder& program, const Memory& memory);
void addReturning(ProgramBuilder& program, const Memory& memory);

/// The end of a step.
void addPublishing(ProgramBuilder& program, const Memory& memory);

} // namespace sinew::sim::collision::side_memory
