// Tearing of bodies (Grid::tearStrain). The criterion is the largest stretch of a cell in any direction, and
// a tear is a straight cut perpendicular to that direction: neither depends on the orientation of the grid in
// the material, as the strain of single links would. A cut that has reached the rim of a cell continues from
// there, so tears grow at their ends, where stretch is largest.
//
// Every step of such a scene runs, after the blade: strain_cells (strain_voxels), find_tears (cells beyond
// the limit that are stretched more than all around them, or in voxel bodies reached by a cut), tear_cells
// (tear_voxels; the first Grid::tearsPerStep of those in order of strain). From then on a tear is a cut.
#pragma once

#include "sim/cutting/cut_plan.hpp"

namespace sinew::sim::cutting {

/// Tearing of one run of slots.
struct TearingBody {
    layout::TearPush push{};
    BufferId found, count;
};

struct Tearing {
    std::vector<TearingBody> bodies;
    BufferId strains; ///< by slot
};

/// Null if no run tears; `slots` is the number of slots of the state. With tearing, steps without a blade
/// must also be recorded with the passes of a cut.
std::shared_ptr<Tearing> addTearing(ProgramBuilder& program, const Cut& cut, std::size_t slots);

/// Appends the passes, after the blade and before links are settled.
void addTearingPasses(ProgramBuilder& program, const Tearing& tearing, const Cut& cut);

} // namespace sinew::sim::cutting
