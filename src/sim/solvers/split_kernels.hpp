// The kernels of `split` in their forms, and the ids of their specialisation constants. Only split.cpp uses
// them.
#pragma once

#include "kernels.hpp"
#include "sim/solvers/batches.hpp"

namespace sinew::sim::solvers::split {

inline constexpr std::uint32_t degreeId = 1, firstGroupEndId = 3; // constant_id in gather_split.comp
inline constexpr std::uint32_t bodyDiagonalsId = 6, residentSlotsId = 7, recoveryId = 8,
                               volumesId =
                                   9; // constant_id in gather_lattice.comp, split.glsl, cell_volume.glsl
inline constexpr std::uint32_t hasLevelsId = 23; // constant_id in split.glsl
inline constexpr std::uint32_t followsDirectionsId = 24, mostOfLinksId = 25,
                               untilNextId = 26;                    // constant_id in directed_clamp.glsl
inline constexpr std::uint32_t bendDegreeId = 6, hasDampingId = 12; // constant_id in gather_terms.glsl

namespace k = kernels;

inline const vk::ShaderCode& nodeKernelFor(const Batch& batch) {
    if (batch.isCuttable)
        return batch.isSheet      ? k::gatherNodeCuttableSheet
               : batch.hasVolumes ? k::gatherNodeCuttableVolume
                                  : k::gatherNodeCuttable;
    return batch.isSheet ? k::gatherNodeSheet : batch.hasVolumes ? k::gatherNodeVolume : k::gatherNode;
}

// Moves a batch by one substep.
inline const vk::ShaderCode& kernelFor(const Batch& batch, const Forms& forms) {
    if (isOneNode(forms)) return nodeKernelFor(batch);
    if (batch.isCuttable)
        return batch.isSheet      ? k::gatherCuttableSheet
               : batch.hasVolumes ? k::gatherCuttableVolume
                                  : k::gatherCuttable;
    if (batch.isSheet) return k::gatherSheet;
    const bool isDouble = forms.columns == 2;
    if (batch.hasVolumes) return isDouble ? k::gatherLatticeVolume : k::gatherLatticeVolumeSingle;
    return isDouble ? k::gatherLattice : k::gatherLatticeSingle;
}

// Keeps a batch in shared memory for a whole step.
inline const vk::ShaderCode& residentKernelFor(const Batch& batch, const Forms& forms) {
    if (isOneNode(forms))
        return batch.isSheet      ? k::residentNodeSheet
               : batch.hasVolumes ? k::residentNodeVolume
                                  : k::residentNode;
    if (batch.isSheet) return k::residentSheet;
    return batch.hasVolumes ? k::residentLatticeVolume : k::residentLattice;
}

} // namespace sinew::sim::solvers::split
