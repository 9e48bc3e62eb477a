// Orders the gathers of `split`: one dispatch for particles with listed links, one for each kind of grid,
// none of which waits for another. Positions alternate between two buffers; the state always ends in the
// first.
#include "sim/solvers/split.hpp"

#include "kernels.hpp"
#include "sim/collision/planes.hpp"
#include "sim/constraints/attachment.hpp"
#include "sim/constraints/bend.hpp"
#include "sim/constraints/distance.hpp"
#include "sim/constraints/tether.hpp"
#include "sim/lattice/batches.hpp"
#include "sim/solvers/shares.hpp"
#include "sim/substeps.hpp"

#include <algorithm>
#include <functional>

namespace sinew::sim::solvers::split {

namespace {

constexpr std::uint32_t degreeId = 1, firstGroupEndId = 3; // constant_id in gather_split.comp
constexpr std::uint32_t bodyDiagonalsId = 6, residentSlotsId = 7,
                        recoveryId = 8;   // constant_id in gather_lattice.comp, split.glsl, cell_volume.glsl
constexpr std::uint32_t bendDegreeId = 6; // constant_id in gather_terms.glsl

// A kernel in its forms: positions fetched as texels or loaded, without and with boundary planes.
struct Kernel {
    const vk::ShaderCode *texels, *texelsPlanes, *loads, *loadsPlanes;
    const vk::ShaderCode& form(bool usesTexels, bool hasPlanes) const {
        return usesTexels ? (hasPlanes ? *texelsPlanes : *texels) : (hasPlanes ? *loadsPlanes : *loads);
    }
};
namespace k = kernels;
constexpr Kernel drift{&k::driftSplit, &k::driftSplitPlanes, &k::driftSplit, &k::driftSplitPlanes};
constexpr Kernel general{&k::gatherSplit, &k::gatherSplitPlanes, &k::gatherSplitLoads,
                         &k::gatherSplitLoadsPlanes};
constexpr Kernel bending{&k::gatherSplitBends, &k::gatherSplitBendsPlanes, &k::gatherSplitBends,
                         &k::gatherSplitBendsPlanes};
constexpr Kernel damped{&k::gatherSplitDamped, &k::gatherSplitDampedPlanes, &k::gatherSplitDamped,
                        &k::gatherSplitDampedPlanes};
constexpr Kernel bendingDamped{&k::gatherSplitBendsDamped, &k::gatherSplitBendsDampedPlanes,
                               &k::gatherSplitBendsDamped, &k::gatherSplitBendsDampedPlanes};
constexpr Kernel packed{&k::gatherSplitPacked, &k::gatherSplitPackedPlanes, &k::gatherSplitPackedLoads,
                        &k::gatherSplitPackedLoadsPlanes};
constexpr Kernel latticePairs{&k::gatherLattice, &k::gatherLatticePlanes, &k::gatherLatticeLoads,
                              &k::gatherLatticeLoadsPlanes};
constexpr Kernel latticeSingle{&k::gatherLatticeSingle, &k::gatherLatticeSinglePlanes,
                               &k::gatherLatticeSingleLoads, &k::gatherLatticeSingleLoadsPlanes};
constexpr Kernel residentLattice{&k::residentLattice, &k::residentLatticePlanes, &k::residentLattice,
                                 &k::residentLatticePlanes};
constexpr Kernel residentSheet{&k::residentSheet, &k::residentSheetPlanes, &k::residentSheet,
                               &k::residentSheetPlanes};
constexpr Kernel volumePairs{&k::gatherLatticeVolume, &k::gatherLatticeVolumePlanes,
                             &k::gatherLatticeVolumeLoads, &k::gatherLatticeVolumeLoadsPlanes};
constexpr Kernel volumeSingle{&k::gatherLatticeVolumeSingle, &k::gatherLatticeVolumeSinglePlanes,
                              &k::gatherLatticeVolumeSingleLoads, &k::gatherLatticeVolumeSingleLoadsPlanes};
constexpr Kernel residentVolume{&k::residentLatticeVolume, &k::residentLatticeVolumePlanes,
                                &k::residentLatticeVolume, &k::residentLatticeVolumePlanes};
constexpr Kernel sheet{&k::gatherSheet, &k::gatherSheetPlanes, &k::gatherSheetLoads,
                       &k::gatherSheetLoadsPlanes};

// One dispatch of every substep, still without the buffers that alternate.
struct Gather {
    std::vector<BufferId> buffers; // after positions, next, velocities and step
    ProgramBuilder::Constants constants;
    std::function<void(std::span<const BufferId> buffers, bool isFirst)> dispatch;
    bool alternatesVelocities = false;
};

// What all dispatches of a program have in common.
struct Common {
    ProgramBuilder& program;
    const Scene& scene;
    const Settings& settings;
    const StateLayout& layout;
    collision::planes::Colliders colliders;

    const vk::ShaderCode& form(const Kernel& kernel) const {
        return kernel.form(settings.forms.usesTexels, colliders.count > 0);
    }
    Gather gather() const {
        if (colliders.count == 0) return {};
        return {{colliders.planes, colliders.contactOffsets}, colliders.constants(), {}};
    }
};

// The distance constraints that no grid computes, between slots.
std::vector<constraints::distance::GatherLink> listedLinks(const Scene& scene, const StateLayout& layout,
                                                           std::span<const std::uint32_t> grids,
                                                           std::span<const float> inverseMass,
                                                           std::span<const float> shares) {
    std::vector<bool> isComputed(scene.distances.size());
    for (const std::uint32_t grid : grids) {
        const auto first = isComputed.begin() + scene.grids[grid].firstDistance;
        std::fill(first, first + scene.grids[grid].distanceCount, true);
    }
    std::vector<constraints::distance::GatherLink> links;
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& constraint = scene.distances[c];
        if (isComputed[c] || !constraints::distance::canMove(constraint, inverseMass)) continue;
        links.push_back({layout.slot[constraint.a], layout.slot[constraint.b], constraint.restLength,
                         stiffnessOf(constraint.compliance), shares[c]});
    }
    return links;
}

template <typename Push>
void setDispatch(const Common& common, Gather& gather, const Kernel& kernel, Push push) {
    gather.dispatch = [&program = common.program, &code = common.form(kernel), constants = gather.constants,
                       push](std::span<const BufferId> buffers, bool isFirst) mutable {
        push.isFirst = isFirst;
        program.dispatch(code, push.count, buffers, push, constants);
    };
}

layout::PackedSubstepPush packedPush(const constraints::distance::GatherLinks& links,
                                     const constraints::distance::PackedLinks& packedLinks) {
    layout::PackedSubstepPush push{};
    for (std::uint32_t group = 0; group < PACKED_GROUPS; ++group) {
        const std::size_t existing = std::min<std::size_t>(group, links.groups.size() - 1);
        push.restLengths[group] = links.groups[existing].restLength;
        push.units[group] = packedLinks.units[existing];
        push.shares[group] = packedLinks.shares[existing];
    }
    return push;
}

// Bends and internal damping, over the general list.
Gather termsGather(const Common& common, constraints::distance::GatherLinks links,
                   const constraints::bend::GatherBends& bends, std::uint32_t count) {
    Gather gather = common.gather();
    const bool isDamped = links.degree > 0 && common.scene.dampingTime > 0;
    if (links.degree == 0) constraints::distance::pad(links, 1);
    gather.constants[degreeId] = links.degree;
    gather.buffers.push_back(common.program.upload("distance.links", links.links));
    if (bends.degree > 0) {
        gather.constants[bendDegreeId] = bends.degree;
        gather.buffers.push_back(common.program.upload("bends", bends.bends));
    }
    gather.alternatesVelocities = isDamped;
    if (!isDamped)
        setDispatch(common, gather, bending, layout::SubstepPush{count, 0});
    else
        setDispatch(common, gather, bends.degree > 0 ? bendingDamped : damped,
                    layout::DampedSubstepPush{count, 0, common.scene.dampingTime});
    return gather;
}

// `count` particles at the head of the state.
Gather listedGather(const Common& common, std::span<const constraints::distance::GatherLink> listed,
                    std::uint32_t count) {
    Gather gather = common.gather();
    const auto links = constraints::distance::gatherLinks(listed, count);
    const auto bends = constraints::bend::gatherBends(common.scene, inverseMasses(common.scene),
                                                      splitBudget(common.scene, common.settings).omegaBends);
    if (bends.degree > 0 || (links.degree > 0 && common.scene.dampingTime > 0))
        return termsGather(common, links, bends, count);
    if (links.degree == 0) {
        setDispatch(common, gather, drift, layout::SubstepPush{count, 0});
        return gather;
    }
    gather.constants[degreeId] = links.degree;
    const auto packedLinks = constraints::distance::pack(links);
    if (packedLinks.links.empty()) {
        gather.buffers.push_back(common.program.upload("distance.links", links.links));
        setDispatch(common, gather, general, layout::SubstepPush{count, 0});
        return gather;
    }
    gather.buffers.push_back(common.program.upload("distance.links", packedLinks.links));
    layout::PackedSubstepPush push = packedPush(links, packedLinks);
    push.count = count;
    for (std::uint32_t group = 0; group + 1 < PACKED_GROUPS; ++group)
        gather.constants[firstGroupEndId + group] =
            links.groups[std::min<std::size_t>(group, links.groups.size() - 1)].endSlot;
    setDispatch(common, gather, packed, push);
    return gather;
}

const Kernel& kernelFor(const lattice::Batch& batch, std::uint32_t columns) {
    if (batch.isSheet) return sheet;
    if (batch.hasVolumes) return columns == 2 ? volumePairs : volumeSingle;
    return columns == 2 ? latticePairs : latticeSingle;
}

Gather gridGather(const Common& common, const lattice::Batch& batch, BufferId cells) {
    Gather gather = common.gather();
    gather.constants[bodyDiagonalsId] = batch.hasBodyDiagonals;
    gather.buffers.push_back(cells);
    gather.buffers.push_back(common.program.upload("grid.chunks", batch.chunks));
    if (batch.hasVolumes) gather.constants[recoveryId] = batch.hasRecovery;
    setDispatch(common, gather, kernelFor(batch, common.settings.forms.columns), batch.push);
    return gather;
}

std::vector<Gather> addGathers(const Common& common) {
    const std::vector<std::uint32_t> grids = lattice::computedGrids(common.scene, common.settings);
    const std::vector<float> inverseMass = inverseMasses(common.scene);
    const std::vector<float> shares = shareStiffness(common.scene, common.settings, inverseMass);
    std::vector<Gather> gathers;
    const std::uint32_t listed = lattice::listedParticles(common.scene, grids);
    if (listed > 0)
        gathers.push_back(listedGather(
            common, listedLinks(common.scene, common.layout, grids, inverseMass, shares), listed));
    if (grids.empty()) return gathers;
    const std::vector<CellShares> cellsOfGrids =
        cellShares(common.scene, common.settings, inverseMass, shares);
    const lattice::Batches batches =
        lattice::batchesOf(common.scene, common.settings, grids, shares, cellsOfGrids);
    const BufferId cells = common.program.upload("grid.cells", batches.cells);
    for (const lattice::Batch& batch : batches.batches) gathers.push_back(gridGather(common, batch, cells));
    return gathers;
}

} // namespace

StateLayout layoutState(const Scene& scene, const Settings& settings) {
    return lattice::layoutOf(scene, lattice::computedGrids(scene, settings));
}

std::vector<float> positionW(const Scene& scene, const Settings& settings) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    const std::vector<float> shares = shareStiffness(scene, settings, inverseMass);
    return clampTimes(scene, settings, inverseMass, shares, cellShares(scene, settings, inverseMass, shares));
}

namespace {

const Kernel& residentKernelFor(const lattice::Batch& batch) {
    if (batch.isSheet) return residentSheet;
    return batch.hasVolumes ? residentVolume : residentLattice;
}

// One dispatch a kind of body, for the whole step: positions stay in shared memory (platform: residency).
bool addResident(const Common& common, const ParticleBuffers& particles) {
    const std::vector<std::uint32_t> grids = lattice::computedGrids(common.scene, common.settings);
    if (!lattice::isResident(common.scene, common.settings, grids)) return false;
    const std::vector<float> inverseMass = inverseMasses(common.scene);
    const std::vector<float> shares = shareStiffness(common.scene, common.settings, inverseMass);
    const lattice::Batches batches =
        lattice::batchesOf(common.scene, common.settings, grids, shares,
                           cellShares(common.scene, common.settings, inverseMass, shares));
    const BufferId cells = common.program.upload("grid.cells", batches.cells);
    for (const lattice::Batch& batch : batches.batches) {
        Gather gather = common.gather();
        gather.constants[bodyDiagonalsId] = batch.hasBodyDiagonals;
        if (batch.hasVolumes) gather.constants[recoveryId] = batch.hasRecovery;
        gather.constants[residentSlotsId] = batch.push.bodySlots;
        std::vector<BufferId> buffers{particles.positions, particles.velocities, particles.step};
        buffers.insert(buffers.end(), gather.buffers.begin(), gather.buffers.end());
        buffers.push_back(cells);
        buffers.push_back(common.program.upload("grid.chunks", batch.chunks));
        buffers.push_back(common.program.upload("grid.bodies", batch.bodies));
        common.program.dispatch(common.form(residentKernelFor(batch)), batch.push.count, buffers, batch.push,
                                gather.constants);
    }
    return true;
}

} // namespace

void addPasses(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               const ParticleBuffers& particles) {
    const StateLayout& layout = particles.layout;
    const Common common{program, scene, settings, layout,
                        collision::planes::addColliders(program, scene, layout)};
    program.program().sweeps = scene.distances.empty() ? 0 : settings.substeps;
    if (addResident(common, particles)) return;
    const std::vector<Gather> gathers = addGathers(common);
    const bool alternates = std::ranges::any_of(gathers, &Gather::alternatesVelocities);
    const auto attachments = constraints::attachment::add(program, scene, layout);
    const auto tethers = constraints::tether::add(program, scene, layout);
    ParticleBuffers current = particles, next = particles;
    next.positions = program.scratch<layout::vec4>("state.next_positions", layout.count);
    if (alternates) next.velocities = program.scratch<layout::vec4>("state.next_velocities", layout.count);
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        program.beginSubstep();
        for (const Gather& gather : gathers) {
            std::vector<BufferId> buffers{current.positions, next.positions, current.velocities,
                                          particles.step};
            buffers.insert(buffers.end(), gather.buffers.begin(), gather.buffers.end());
            if (alternates) buffers.push_back(next.velocities);
            gather.dispatch(buffers, substep == 0);
        }
        std::swap(current, next);
        constraints::attachment::addPass(program, current, attachments, substep, settings.substeps);
        constraints::tether::addPass(program, current, tethers);
    }
    program.endSubsteps();
    if (current.positions != particles.positions) program.copy(current.positions, particles.positions);
    if (current.velocities != particles.velocities) program.copy(current.velocities, particles.velocities);
}

} // namespace sinew::sim::solvers::split
