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
inline constexpr std::uint32_t bendDegreeId = 6; // constant_id in gather_terms.glsl

namespace k = kernels;

// A kernel in its forms: positions as texels or loads, without and with boundary planes.
struct Kernel {
    const vk::ShaderCode *texels, *texelsPlanes, *loads, *loadsPlanes;
    const vk::ShaderCode& form(bool usesTexels, bool hasPlanes) const {
        return usesTexels ? (hasPlanes ? *texelsPlanes : *texels) : (hasPlanes ? *loadsPlanes : *loads);
    }
};
// For a kernel with loads alone, or without neighbours to fetch.
constexpr Kernel inOneForm(const vk::ShaderCode& code, const vk::ShaderCode& planes) {
    return {&code, &planes, &code, &planes};
}
inline constexpr Kernel drift = inOneForm(k::driftSplit, k::driftSplitPlanes);
inline constexpr Kernel general{&k::gatherSplit, &k::gatherSplitPlanes, &k::gatherSplitLoads,
                                &k::gatherSplitLoadsPlanes};
inline constexpr Kernel bending{&k::gatherSplitBends, &k::gatherSplitBendsPlanes, &k::gatherSplitBendsLoads,
                                &k::gatherSplitBendsLoadsPlanes};
inline constexpr Kernel damped{&k::gatherSplitDamped, &k::gatherSplitDampedPlanes, &k::gatherSplitDampedLoads,
                               &k::gatherSplitDampedLoadsPlanes};
inline constexpr Kernel bendingDamped{&k::gatherSplitBendsDamped, &k::gatherSplitBendsDampedPlanes,
                                      &k::gatherSplitBendsDampedLoads, &k::gatherSplitBendsDampedLoadsPlanes};
inline constexpr Kernel ranged{&k::gatherSplitRanged, &k::gatherSplitRangedPlanes, &k::gatherSplitRangedLoads,
                               &k::gatherSplitRangedLoadsPlanes};
inline constexpr Kernel rangedBending{&k::gatherSplitRangedBends, &k::gatherSplitRangedBendsPlanes,
                                      &k::gatherSplitRangedBendsLoads, &k::gatherSplitRangedBendsLoadsPlanes};
inline constexpr Kernel rangedDamped{&k::gatherSplitRangedDamped, &k::gatherSplitRangedDampedPlanes,
                                     &k::gatherSplitRangedDampedLoads,
                                     &k::gatherSplitRangedDampedLoadsPlanes};
inline constexpr Kernel rangedBendingDamped{
    &k::gatherSplitRangedBendsDamped, &k::gatherSplitRangedBendsDampedPlanes,
    &k::gatherSplitRangedBendsDampedLoads, &k::gatherSplitRangedBendsDampedLoadsPlanes};
inline constexpr Kernel packed{&k::gatherSplitPacked, &k::gatherSplitPackedPlanes, &k::gatherSplitPackedLoads,
                               &k::gatherSplitPackedLoadsPlanes};
inline constexpr Kernel latticePairs{&k::gatherLattice, &k::gatherLatticePlanes, &k::gatherLatticeLoads,
                                     &k::gatherLatticeLoadsPlanes};
inline constexpr Kernel latticeSingle{&k::gatherLatticeSingle, &k::gatherLatticeSinglePlanes,
                                      &k::gatherLatticeSingleLoads, &k::gatherLatticeSingleLoadsPlanes};
inline constexpr Kernel residentLattice = inOneForm(k::residentLattice, k::residentLatticePlanes);
inline constexpr Kernel residentSheet = inOneForm(k::residentSheet, k::residentSheetPlanes);
inline constexpr Kernel volumePairs{&k::gatherLatticeVolume, &k::gatherLatticeVolumePlanes,
                                    &k::gatherLatticeVolumeLoads, &k::gatherLatticeVolumeLoadsPlanes};
inline constexpr Kernel volumeSingle{&k::gatherLatticeVolumeSingle, &k::gatherLatticeVolumeSinglePlanes,
                                     &k::gatherLatticeVolumeSingleLoads,
                                     &k::gatherLatticeVolumeSingleLoadsPlanes};
inline constexpr Kernel residentVolume = inOneForm(k::residentLatticeVolume, k::residentLatticeVolumePlanes);
inline constexpr Kernel sheet{&k::gatherSheet, &k::gatherSheetPlanes, &k::gatherSheetLoads,
                              &k::gatherSheetLoadsPlanes};
// For cuttable bodies.
inline constexpr Kernel cuttable{&k::gatherCuttable, &k::gatherCuttablePlanes, &k::gatherCuttableLoads,
                                 &k::gatherCuttableLoadsPlanes};
inline constexpr Kernel cuttableVolume{&k::gatherCuttableVolume, &k::gatherCuttableVolumePlanes,
                                       &k::gatherCuttableVolumeLoads, &k::gatherCuttableVolumeLoadsPlanes};
inline constexpr Kernel cuttableSheet{&k::gatherCuttableSheet, &k::gatherCuttableSheetPlanes,
                                      &k::gatherCuttableSheetLoads, &k::gatherCuttableSheetLoadsPlanes};
// One node an invocation. Loads alone: a texel unit fetches 16 bytes several times slower than a load does.
inline constexpr Kernel node = inOneForm(k::gatherNode, k::gatherNodePlanes);
inline constexpr Kernel nodeVolume = inOneForm(k::gatherNodeVolume, k::gatherNodeVolumePlanes);
inline constexpr Kernel nodeSheet = inOneForm(k::gatherNodeSheet, k::gatherNodeSheetPlanes);
inline constexpr Kernel nodeCuttable = inOneForm(k::gatherNodeCuttable, k::gatherNodeCuttablePlanes);
inline constexpr Kernel nodeCuttableVolume =
    inOneForm(k::gatherNodeCuttableVolume, k::gatherNodeCuttableVolumePlanes);
inline constexpr Kernel nodeCuttableSheet =
    inOneForm(k::gatherNodeCuttableSheet, k::gatherNodeCuttableSheetPlanes);

inline constexpr Kernel residentNode = inOneForm(k::residentNode, k::residentNodePlanes);
inline constexpr Kernel residentNodeVolume = inOneForm(k::residentNodeVolume, k::residentNodeVolumePlanes);
inline constexpr Kernel residentNodeSheet = inOneForm(k::residentNodeSheet, k::residentNodeSheetPlanes);

// Gathers links in the general form, with the bends and damping of the scene.
inline const Kernel& generalKernel(bool isRanged, bool bends, bool damps) {
    if (isRanged)
        return damps ? (bends ? rangedBendingDamped : rangedDamped) : bends ? rangedBending : ranged;
    return damps ? (bends ? bendingDamped : damped) : bends ? bending : general;
}

inline const Kernel& nodeKernelFor(const Batch& batch) {
    if (batch.isCuttable)
        return batch.isSheet ? nodeCuttableSheet : batch.hasVolumes ? nodeCuttableVolume : nodeCuttable;
    return batch.isSheet ? nodeSheet : batch.hasVolumes ? nodeVolume : node;
}

// Moves a batch by one substep.
inline const Kernel& kernelFor(const Batch& batch, const Forms& forms) {
    if (isOneNode(forms)) return nodeKernelFor(batch);
    const std::uint32_t columns = forms.columns;
    if (batch.isCuttable) return batch.isSheet ? cuttableSheet : batch.hasVolumes ? cuttableVolume : cuttable;
    if (batch.isSheet) return sheet;
    if (batch.hasVolumes) return columns == 2 ? volumePairs : volumeSingle;
    return columns == 2 ? latticePairs : latticeSingle;
}

// Keeps a batch in shared memory for a whole step.
inline const Kernel& residentKernelFor(const Batch& batch, const Forms& forms) {
    if (isOneNode(forms))
        return batch.isSheet ? residentNodeSheet : batch.hasVolumes ? residentNodeVolume : residentNode;
    if (batch.isSheet) return residentSheet;
    return batch.hasVolumes ? residentVolume : residentLattice;
}

} // namespace sinew::sim::solvers::split
