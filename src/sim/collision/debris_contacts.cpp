// The radii of a grid belong to the topology: an undo of cuts brings debris back.
#include "sim/collision/debris_contacts.hpp"

#include <algorithm>

namespace sinew::sim::collision {

void letDebrisLeave(ProgramBuilder& program, BufferId radii, const hash_grid::Grid& grid) {
    CuttingBuffers& buffers = program.program().cutting;
    if (buffers.debris == 0) return;
    buffers.contactGrids.push_back({radii, grid.bounds});
    buffers.topology.push_back(radii);
    program.addToState(radii, radii);
    if (std::ranges::find(buffers.contactsSeen, grid.detected) == buffers.contactsSeen.end())
        buffers.contactsSeen.push_back(grid.detected);
}

} // namespace sinew::sim::collision
