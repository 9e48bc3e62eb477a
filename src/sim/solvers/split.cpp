// Order of the gathers of `split`: one dispatch for particles with listed links, one for each kind of grid,
// without barriers between them. Positions alternate between two buffers; the final state is always in the
// first.
#include "sim/solvers/split.hpp"

#include "sim/constraints/bend.hpp"
#include "sim/constraints/distance.hpp"
#include "sim/cutting/cut_lists.hpp"
#include "sim/forces/forces.hpp"
#include "sim/levels/levels.hpp"
#include "sim/model/grids.hpp"
#include "sim/model/touching.hpp"
#include "sim/motions/pool.hpp"
#include "sim/rigid/planes.hpp"
#include "sim/solvers/batches.hpp"
#include "sim/solvers/split_kernels.hpp"
#include "sim/solvers/touching.hpp"
#include "sim/stiffness/shares.hpp"

#include <algorithm>
#include <bit>
#include <functional>

namespace sinew::sim::solvers::split {

namespace {

// A dispatch of every substep, without the buffers that alternate.
struct Gather {
    std::vector<BufferId> buffers; // those of the links
    ProgramBuilder::Constants constants;
    std::optional<IndirectItems> items = {}; // if bodies come and go
    std::function<void(std::span<const BufferId> buffers, std::uint32_t substep)> dispatch;
    bool alternatesVelocities = false;
};

// Data that all dispatches of a program share.
struct Common {
    Build& build;
    const stiffness::Shares& shares;
    rigid::planes::Planes planes;
    std::optional<levels::Levels> levels;
    ProgramBuilder& program = build.program;
    const SceneModel& model = build.model;

    Gather gather() const {
        ProgramBuilder::Constants constants = remainderConstants(model.layout);
        if (model.settings.keepsForces) constants.merge(forces::pullConstants());
        constants.merge(planes.constants());
        if (levels) constants[hasLevelsId] = true;
        if (shares.isSharp())
            constants[mostOfLinksId] = std::bit_cast<std::uint32_t>(
                static_cast<float>(stiffness::mostOfLinks(model.scene, model.settings)));
        return {{}, std::move(constants), {}};
    }
};

// The distance constraints outside computed grids, between slots.
std::vector<constraints::distance::GatherLink> listedLinks(const Common& common) {
    const SceneModel& model = common.model;
    const Scene& scene = model.scene;
    const std::vector<std::uint32_t>& slot = model.layout.slot;
    std::vector<bool> isComputed(scene.distances.size());
    for (const std::uint32_t grid : model.grids) {
        const auto first = isComputed.begin() + scene.grids[grid].firstDistance;
        std::fill(first, first + scene.grids[grid].distanceCount, true);
    }
    std::vector<constraints::distance::GatherLink> links;
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& constraint = scene.distances[c];
        if (isComputed[c] || !constraints::distance::canMove(constraint, model.inverseMass)) continue;
        links.push_back({slot[constraint.a], slot[constraint.b], constraint.restLength,
                         stiffness::stiffnessOf(constraint.compliance), common.shares.ofLinks[c]});
    }
    return links;
}

template <typename Push>
void setDispatch(const Common& common, Gather& gather, const vk::ShaderCode& code, Push push) {
    gather.dispatch = [&program = common.program, &code, constants = gather.constants, push,
                       items = gather.items, isSharp = common.shares.isSharp(),
                       all = common.build.model.settings.substeps](std::span<const BufferId> buffers,
                                                                   std::uint32_t substep) mutable {
        push.isFirst = substep == 0;
        if (isSharp) {
            const bool isLook = substep % CLAMP_INTERVAL == 0;
            constants[followsDirectionsId] = isLook;
            constants[untilNextId] = isLook ? std::min<std::uint32_t>(CLAMP_INTERVAL, all - substep) : 0;
        }
        if (items)
            program.dispatchIndirect(code, *items, buffers, push, constants);
        else
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

// Links in slots, links in ranges, and bends that a blade can cut.
std::vector<cutting::Listed> allOf(const constraints::distance::GatherLinks& links) {
    std::vector<cutting::Listed> all;
    for (std::uint32_t i = 0; i < links.particles; ++i)
        for (std::uint32_t slot = 0; slot < links.degree; ++slot) {
            const std::size_t element = links.element(i, slot);
            const layout::SplitLink& link = links.links[element];
            if (link.other != i)
                all.push_back({static_cast<std::uint32_t>(element), {i, link.other}, 2, link.stiffness});
        }
    return all;
}

std::vector<cutting::Listed> allOf(const constraints::distance::RangedLinks& links) {
    std::vector<cutting::Listed> all;
    for (std::uint32_t i = 0; i + 1 < links.first.size(); ++i)
        for (std::uint32_t element = links.first[i]; element < links.first[i + 1]; ++element) {
            const layout::SplitLink& link = links.links[element];
            all.push_back({element, {i, link.other}, 2, link.stiffness});
        }
    return all;
}

std::vector<cutting::Listed> allOf(const constraints::bend::GatherBends& bends) {
    std::vector<cutting::Listed> all;
    for (std::uint32_t element = 0; element < bends.bends.size(); ++element) {
        const layout::SplitBend& bend = bends.bends[element];
        if (bend.a != bend.b) all.push_back({element, {bend.a, bend.b, bend.c}, 3, bend.stiffness});
    }
    return all;
}

// Gather of any links, with bends and internal damping if the scene has them.
Gather generalGather(const Common& common, std::span<const constraints::distance::GatherLink> listed,
                     bool isRanged, const constraints::bend::GatherBends& bends, std::uint32_t count) {
    Gather gather = common.gather();
    const bool isCut = cutting::haveLists(common.program.program(), count);
    if (isRanged) {
        const auto links = constraints::distance::rangedLinks(listed, count);
        gather.buffers.push_back(common.program.upload("distance.links", links.links));
        if (isCut) cutting::addListFilter(common.build, gather.buffers.back(), allOf(links), false);
        gather.buffers.push_back(common.program.upload("distance.first_links", links.first));
    } else {
        const auto links = constraints::distance::gatherLinks(listed, count);
        gather.constants[degreeId] = links.degree;
        gather.buffers.push_back(links.degree > 0 ? common.program.upload("distance.links", links.links)
                                                  : unbound);
        if (isCut && links.degree > 0)
            cutting::addListFilter(common.build, gather.buffers.back(), allOf(links), false);
    }
    gather.constants[bendDegreeId] = bends.degree;
    gather.buffers.push_back(bends.degree > 0 ? common.program.upload("bends", bends.bends) : unbound);
    if (isCut && bends.degree > 0)
        cutting::addListFilter(common.build, gather.buffers.back(), allOf(bends), true);
    gather.alternatesVelocities = !listed.empty() && common.model.scene.dampingTime > 0;
    gather.constants[hasDampingId] = gather.alternatesVelocities;
    setDispatch(common, gather, isRanged ? k::gatherSplitRanged : k::gatherSplit,
                layout::DampedSubstepPush{count, 0, common.model.scene.dampingTime});
    return gather;
}

// Gather of links in slots that have one rest length each: one word a link.
Gather packedGather(const Common& common, const constraints::distance::GatherLinks& links,
                    const constraints::distance::PackedLinks& packedLinks, std::uint32_t count) {
    Gather gather = common.gather();
    gather.constants[degreeId] = links.degree;
    gather.buffers.push_back(common.program.upload("distance.links", packedLinks.links));
    layout::PackedSubstepPush push = packedPush(links, packedLinks);
    push.count = count;
    for (std::uint32_t group = 0; group + 1 < PACKED_GROUPS; ++group)
        gather.constants[firstGroupEndId + group] =
            links.groups[std::min<std::size_t>(group, links.groups.size() - 1)].endSlot;
    setDispatch(common, gather, k::gatherSplitPacked, push);
    return gather;
}

// Gather of the first `count` particles of the state.
Gather listedGather(const Common& common, std::uint32_t count) {
    const auto listed = listedLinks(common);
    const auto bends =
        constraints::bend::gatherBends(common.model, stiffness::omegaOfBends(common.model.settings));
    const bool isDamped = !listed.empty() && common.model.scene.dampingTime > 0;
    const bool isRanged = constraints::distance::isIrregular(listed, count);
    if (listed.empty() || bends.degree > 0 || isDamped || isRanged ||
        cutting::haveLists(common.program.program(), count))
        return generalGather(common, listed, isRanged, bends, count);
    const auto links = constraints::distance::gatherLinks(listed, count);
    const auto packedLinks = constraints::distance::pack(links);
    return packedLinks.links.empty() ? generalGather(common, listed, false, bends, count)
                                     : packedGather(common, links, packedLinks, count);
}

// The bodies on computed grids, and the buffer that all their kernels read.
struct Grids {
    Batches batches;
    BufferId cells;
};

Grids uploadGrids(const Common& common, Residence residence) {
    Grids grids{.batches = batchesOf(common.model, common.shares, residence)};
    grids.cells = common.program.upload("grid.cells", grids.batches.cells);
    return grids;
}

constexpr std::size_t chunksPlace = 1; // among the buffers of a gather of a batch

// Buffers and constants shared by the kernels for a batch, those of a substep and those of a whole step.
Gather gridGather(const Common& common, const Batch& batch, BufferId cells) {
    Gather gather = common.gather();
    gather.constants[bodyDiagonalsId] = batch.hasBodyDiagonals;
    if (batch.hasVolumes) {
        gather.constants[recoveryId] = batch.hasRecovery;
        gather.constants[volumesId] = batch.push.volumeUnit > 0;
    }
    gather.buffers.push_back(cells);
    gather.buffers.push_back(common.program.upload("grid.chunks", batch.chunks));
    const CuttingBuffers& cutting = common.program.program().cutting;
    if (batch.isCuttable) gather.buffers.push_back(cutting.links);
    if (batch.isCuttable && batch.hasVolumes) gather.buffers.push_back(cutting.wholeCells);
    return gather;
}

std::vector<Gather> addGathers(const Common& common) {
    std::vector<Gather> gathers;
    const std::uint32_t listed = listedParticles(common.model.scene, common.model.grids);
    if (listed > 0) gathers.push_back(listedGather(common, listed));
    if (common.model.grids.empty()) return gathers;
    const auto [batches, cells] = uploadGrids(common, Residence::memory);
    for (const Batch& batch : batches.batches) {
        gathers.push_back(gridGather(common, batch, cells));
        gathers.back().items = motions::addPoolChunks(
            common.build, gathers.back().buffers[chunksPlace],
            isOneNode(common.model.settings.forms) ? GROUP_ITEMS / LATTICE_GROUP : LATTICE_GROUP,
            batch.push.count);
        setDispatch(common, gathers.back(), kernelFor(batch, common.model.settings.forms), batch.push);
    }
    return gathers;
}

// Appends one dispatch a kind of body, for the whole step: positions stay in shared memory.
void addResident(const Common& common) {
    const ParticleBuffers& particles = common.build.particles;
    const auto [batches, cells] = uploadGrids(common, Residence::sharedMemory);
    common.build.add(&Feature::open);
    for (const Batch& batch : batches.batches) {
        Gather gather = gridGather(common, batch, cells);
        gather.constants[residentSlotsId] = batch.push.bodySlots;
        if (common.shares.isSharp()) gather.constants[followsDirectionsId] = true;
        std::vector<BufferId> buffers{particles.positions,  particles.velocities,         particles.step,
                                      common.planes.planes, common.planes.contactOffsets, particles.mostW};
        buffers.insert(buffers.end(), gather.buffers.begin(), gather.buffers.end());
        buffers.push_back(common.program.upload("grid.bodies", batch.bodies));
        const vk::ShaderCode& code = residentKernelFor(batch, common.model.settings.forms);
        layout::LatticePush push = batch.push;
        push.count = static_cast<std::uint32_t>(batch.bodies.size()) * vk::readInterface(code).groupSize[0];
        common.program.dispatch(code, push.count, buffers, push, gather.constants);
    }
}

// Appends the links of a substep: one dispatch a kind of grid and one for listed links. `next` differs from
// `current` in the buffers that alternate.
void addLinks(const Common& common, const std::vector<Gather>& gathers, const ParticleBuffers& current,
              const ParticleBuffers& next, std::uint32_t substep) {
    if (common.levels) common.levels->addPasses(common.program, current, substep == 0);
    const BufferId blockOf = common.levels ? common.levels->blockOf() : unbound,
                   kicks = common.levels ? common.levels->kicks() : unbound;
    for (const Gather& gather : gathers) {
        std::vector<BufferId> buffers{current.positions,
                                      next.positions,
                                      current.velocities,
                                      next.velocities,
                                      current.step,
                                      common.planes.planes,
                                      common.planes.contactOffsets,
                                      blockOf,
                                      kicks,
                                      current.mostW};
        buffers.insert(buffers.end(), gather.buffers.begin(), gather.buffers.end());
        gather.dispatch(buffers, substep);
    }
}

void addSubsteps(const Common& common) {
    Build& build = common.build;
    ProgramBuilder& program = build.program;
    const StateLayout& layout = build.model.layout;
    const ParticleBuffers& particles = build.particles;
    const std::vector<Gather> gathers = addGathers(common);
    const bool alternates = std::ranges::any_of(gathers, &Gather::alternatesVelocities);
    build.add(&Feature::open);
    ParticleBuffers current = particles, next = particles;
    next.positions = program.scratch<layout::vec4>("state.next_positions", positionCount(layout));
    if (alternates) next.velocities = program.scratch<layout::vec4>("state.next_velocities", layout.count);
    for (std::uint32_t index = 0; index < build.model.settings.substeps; ++index) {
        program.beginSubstep();
        const Substep substep{.particles = current, .index = index};
        build.add(&Feature::substepBegin, substep);
        addLinks(common, gathers, current, next, index);
        std::swap(current, next);
        build.add(&Feature::afterLinks, substep);
        build.add(&Feature::afterContacts, substep);
        build.add(&Feature::substepEnd, substep);
    }
    program.endSubsteps();
    if (current.positions != particles.positions) program.copy(current.positions, particles.positions);
    if (current.velocities != particles.velocities) program.copy(current.velocities, particles.velocities);
}

// Appends the substeps of a scene with contacts: gathers leave predicted positions, and the passes of the
// contacts turn these into the state after the substep. Positions end in the buffer that they started in;
// velocities end in another one, so that contacts can read the old ones.
void addTouchingSubsteps(const Common& common) {
    Build& build = common.build;
    ProgramBuilder& program = build.program;
    const StateLayout& layout = build.model.layout;
    const ParticleBuffers& particles = build.particles;
    Touching& contacts = addTouching(build);
    const std::vector<Gather> gathers = addGathers(common);
    build.add(&Feature::open);
    ParticleBuffers current = particles, predicted = particles;
    predicted.positions = program.scratch<layout::vec4>("state.next_positions", positionCount(layout));
    predicted.velocities = program.scratch<layout::vec4>("state.linked_velocities", layout.count);
    BufferId spare = program.scratch<layout::vec4>("state.next_velocities", layout.count);
    const ParticleBuffers* unseen = contacts.moveUnseen() ? &predicted : nullptr;
    for (std::uint32_t index = 0; index < build.model.settings.substeps; ++index) {
        program.beginSubstep();
        const Substep substep{.particles = current, .index = index, .predicted = unseen};
        build.add(&Feature::substepBegin, substep);
        contacts.begin(current.velocities);
        addLinks(common, gathers, current, predicted, index);
        build.add(&Feature::afterLinks, {.particles = predicted, .index = index});
        std::swap(current.velocities, spare);
        contacts.addPasses(program, predicted, current, index == 0);
        contacts.addBounces(program, predicted, current);
        build.add(&Feature::afterContacts, substep);
        contacts.addStops(program, predicted, current);
        build.add(&Feature::substepEnd, substep);
        contacts.addRecoils(program, predicted, current, index);
    }
    program.endSubsteps();
    if (current.velocities != particles.velocities) program.copy(current.velocities, particles.velocities);
    program.keepForRepeat(particles.positions);
    program.keepForRepeat(particles.velocities);
}

void addPasses(Build& build, const stiffness::Shares& shares) {
    const SceneModel& model = build.model;
    build.program.program().sweeps = model.scene.distances.empty() ? 0 : model.settings.substeps;
    if (model.particlesTouch() || model.facesTouch() || model.settings.keepsForces) {
        addTouchingSubsteps({build, shares, {}, levels::add(build, shares)});
        return;
    }
    const Common common{build, shares, rigid::planes::add(build.program, model.scene, model.layout),
                        levels::add(build, shares)};
    if (isResident(model.scene, model.settings, model.grids))
        addResident(common);
    else
        addSubsteps(common);
}

} // namespace

bool contactsFollow(const Scene& scene, const Settings& settings) {
    return particlesTouch(scene) || facesTouch(scene) || settings.keepsForces;
}

SolverPlan plan(const SceneModel& model) {
    stiffness::Shares shares = stiffness::sharesOfMotion(model.scene, model.settings, model.inverseMass);
    std::vector<float> times = shares.startTimes, most;
    if (shares.isSharp()) most = shares.times;
    return {std::move(times), std::move(most),
            [shares = std::move(shares)](Build& build) { addPasses(build, shares); }};
}

} // namespace sinew::sim::solvers::split
