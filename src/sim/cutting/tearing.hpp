// Bodies that tear (Grid::tearStrain). What counts is how far a cell is stretched in the direction in which
// it is stretched most, and what tears it is a straight cut across that direction: neither depends on how the
// grid lies in the material, as the strain of single links would. A cut that has reached the rim of a cell
// goes on from there, so tears grow at their ends, where they are stretched most.
//
// In every step of such a scene, after the blade: strain_cells (strain_voxels), find_tears (cells beyond the
// limit that are stretched more than all around them, or in bodies of voxels reached by a cut), tear_cells
// (tear_voxels; the first so many of those in order of strain). From there on a tear is a cut.
#pragma once

#include "sim/cutting/cut_plan.hpp"

namespace sinew::sim::cutting {

/// Of one run of slots.
struct TearingBody {
    layout::TearPush push{};
    BufferId found, count;
};

struct Tearing {
    std::vector<TearingBody> bodies;
    BufferId strains; ///< by slot
};

/// Only where a run tears; `slots` of the state. Steps without a blade are to be recorded with the passes of
/// a cut.
std::shared_ptr<Tearing> addTearing(ProgramBuilder& program, const Cut& cut, std::size_t slots);

/// After the blade and before links are settled.
void addTearingPasses(ProgramBuilder& program, const Tearing& tearing, const Cut& cut);

} // namespace sinew::sim::cutting
