// The buffers and passes of what contacts remember.
#include "sim/collision/side_memory.hpp"

#include "kernels.hpp"

namespace sinew::sim::collision::side_memory {

Memory add(ProgramBuilder& program, const std::string& name, BufferId contacts, BufferId counts,
           const hash_grid::Grid& grid, const layout::FacePush& push, std::size_t elements) {
    const std::size_t lists = push.count;
    Memory memory{.memory = program.scratch<layout::vec4>(name + ".memory", elements),
                  .contacts = contacts,
                  .counts = counts,
                  .kept = program.scratch<layout::vec4>(name + ".kept", elements),
                  .keptOthers = program.scratch<std::uint32_t>(name + ".kept_others", elements),
                  .keptCounts = program.scratch<std::uint32_t>(name + ".kept_counts", lists),
                  .saved = program.scratch<layout::vec4>(name + ".memory.saved", elements),
                  .savedOthers = program.scratch<std::uint32_t>(name + ".others.saved", elements),
                  .savedCounts = program.scratch<std::uint32_t>(name + ".counts.saved", lists),
                  .grid = grid,
                  .push = push};
    for (const BufferId buffer :
         {contacts, counts, memory.memory, memory.saved, memory.savedOthers, memory.savedCounts})
        program.carry(buffer, buffer);
    return memory;
}

void addKeeping(ProgramBuilder& program, const Memory& memory) {
    program.dispatchIndirect(
        kernels::keepSides, memory.grid.particles,
        {memory.contacts, memory.counts, memory.memory, memory.kept, memory.keptOthers, memory.keptCounts},
        memory.push);
}

void addReturning(ProgramBuilder& program, const Memory& memory) {
    program.dispatchIndirect(
        kernels::returnSides, memory.grid.particles,
        {memory.contacts, memory.counts, memory.memory, memory.kept, memory.keptOthers, memory.keptCounts},
        memory.push);
}

void addPublishing(ProgramBuilder& program, const Memory& memory) {
    program.dispatch(kernels::publishSides, memory.push.count,
                     {memory.contacts, memory.counts, memory.memory, memory.saved, memory.savedOthers,
                      memory.savedCounts, program.program().status, memory.grid.detected, memory.grid.bounds},
                     memory.push);
}

} // namespace sinew::sim::collision::side_memory
