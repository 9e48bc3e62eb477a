// Order of the gathers of `split`: one dispatch for particles with listed links, one for each kind of grid,
// without barriers between them. Positions alternate between two buffers; the final state is always in the
// first.
#include "sim/solvers/split.hpp"

#include "sim/collision/cut_contacts.hpp"
#include "sim/collision/cut_faces.hpp"
#include "sim/collision/edge_contacts.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/collision/particle_contacts.hpp"
#include "sim/constraints/attachment.hpp"
#include "sim/constraints/bend.hpp"
#include "sim/constraints/distance.hpp"
#include "sim/constraints/tether.hpp"
#include "sim/cutting/cut_lists.hpp"
#include "sim/forces/forces.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/model/grids.hpp"
#include "sim/model/touching.hpp"
#include "sim/rigid/colliders.hpp"
#include "sim/rigid/driven.hpp"
#include "sim/rigid/planes.hpp"
#include "sim/sleep/sleep.hpp"
#include "sim/solvers/batches.hpp"
#include "sim/solvers/split_kernels.hpp"
#include "sim/stiffness/shares.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace sinew::sim::solvers::split {

namespace {

// A dispatch of every substep, without the buffers that alternate.
struct Gather {
    std::vector<BufferId> buffers; // those after positions, next, velocities and step
    ProgramBuilder::Constants constants;
    std::function<void(std::span<const BufferId> buffers, bool isFirst)> dispatch;
    bool alternatesVelocities = false;
};

// Data that all dispatches of a program share.
struct Common {
    ProgramBuilder& program;
    const SceneModel& model;
    const stiffness::Shares& shares;
    rigid::planes::Planes planes;

    Gather gather() const {
        ProgramBuilder::Constants constants = remainderConstants(model.layout);
        if (model.settings.keepsForces) constants.merge(forces::pullConstants());
        constants.merge(planes.constants());
        return {{planes.planes, planes.contactOffsets}, std::move(constants), {}};
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
    gather.dispatch = [&program = common.program, &code, constants = gather.constants,
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
        if (isCut) cutting::addListFilter(common.program, gather.buffers.back(), allOf(links), false);
        gather.buffers.push_back(common.program.upload("distance.first_links", links.first));
    } else {
        const auto links = constraints::distance::gatherLinks(listed, count);
        gather.constants[degreeId] = links.degree;
        gather.buffers.push_back(links.degree > 0 ? common.program.upload("distance.links", links.links)
                                                  : unbound);
        if (isCut && links.degree > 0)
            cutting::addListFilter(common.program, gather.buffers.back(), allOf(links), false);
    }
    gather.constants[bendDegreeId] = bends.degree;
    gather.buffers.push_back(bends.degree > 0 ? common.program.upload("bends", bends.bends) : unbound);
    if (isCut && bends.degree > 0)
        cutting::addListFilter(common.program, gather.buffers.back(), allOf(bends), true);
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
        setDispatch(common, gathers.back(), kernelFor(batch, common.model.settings.forms), batch.push);
    }
    return gathers;
}

// Appends one dispatch a kind of body, for the whole step: positions stay in shared memory.
void addResident(const Common& common, const ParticleBuffers& particles) {
    const auto [batches, cells] = uploadGrids(common, Residence::sharedMemory);
    sleep::addOpening(common.program, particles);
    for (const Batch& batch : batches.batches) {
        Gather gather = gridGather(common, batch, cells);
        gather.constants[residentSlotsId] = batch.push.bodySlots;
        std::vector<BufferId> buffers{particles.positions, particles.velocities, particles.step};
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
void addLinks(const std::vector<Gather>& gathers, const ParticleBuffers& current, const ParticleBuffers& next,
              bool isFirst) {
    for (const Gather& gather : gathers) {
        std::vector<BufferId> buffers{current.positions, next.positions, current.velocities, next.velocities,
                                      current.step};
        buffers.insert(buffers.end(), gather.buffers.begin(), gather.buffers.end());
        gather.dispatch(buffers, isFirst);
    }
}

// Adds the colliders other than planes.
rigid::colliders::Colliders addRigid(const Common& common) {
    auto rigid =
        rigid::colliders::add(common.program, common.model.scene, common.model.settings, common.model.layout);
    rigid::colliders::addMemory(common.program, rigid);
    return rigid;
}

void addSubsteps(const Common& common, const ParticleBuffers& particles) {
    ProgramBuilder& program = common.program;
    const StateLayout& layout = common.model.layout;
    const std::uint32_t substeps = common.model.settings.substeps;
    const std::vector<Gather> gathers = addGathers(common);
    const bool alternates = std::ranges::any_of(gathers, &Gather::alternatesVelocities);
    const auto attachments = constraints::attachment::add(program, common.model.scene, layout);
    const auto tethers = constraints::tether::add(program, common.model);
    const auto rigid = addRigid(common);
    const auto driven = rigid::driven::add(program, common.model.scene, layout, rigid);
    sleep::addOpening(program, particles, attachments, rigid);
    ParticleBuffers current = particles, next = particles;
    next.positions = program.scratch<layout::vec4>("state.next_positions", positionCount(layout));
    if (alternates) next.velocities = program.scratch<layout::vec4>("state.next_velocities", layout.count);
    for (std::uint32_t substep = 0; substep < substeps; ++substep) {
        program.beginSubstep();
        rigid::colliders::addOpening(program, current, rigid, substep == 0);
        addLinks(gathers, current, next, substep == 0);
        std::swap(current, next);
        rigid::driven::addPass(program, current, driven, substep);
        constraints::attachment::addPass(program, current, attachments, substep, substeps);
        grabs::addPass(program, current, substep, substeps, Kick::whole);
        constraints::tether::addPass(program, current, tethers);
        rigid::colliders::addPass(program, current, rigid, substep, Kick::whole);
    }
    program.endSubsteps();
    if (current.positions != particles.positions) program.copy(current.positions, particles.positions);
    if (current.velocities != particles.velocities) program.copy(current.velocities, particles.velocities);
}

// The contacts of a scene in order: of particles with faces, of edges of faces, of particles with particles.
struct Touching {
    std::optional<collision::face_contacts::Contacts> faces;
    std::optional<collision::edge_contacts::Contacts> edges;
    std::optional<collision::particle_contacts::Contacts> pairs;
    BufferId before; // velocities at the start of the substep
    // Planes and the slots that hold a particle; only if no particles touch each other.
    rigid::planes::Planes planes;
    BufferId particles;
    std::uint32_t particleCount = 0;

    // Starts a substep with these velocities, which stay until its contacts are solved.
    void begin(BufferId velocities) {
        before = velocities;
        if (faces) faces->rows.before = velocities;
        if (edges) edges->rows.before = velocities;
        if (pairs) pairs->before = velocities;
    }
    void addPasses(ProgramBuilder& program, const ParticleBuffers& predicted, const ParticleBuffers& next,
                   bool isFirst) const {
        if (faces) collision::face_contacts::addPasses(program, *faces, predicted, isFirst);
        if (edges) collision::edge_contacts::addPasses(program, *edges, predicted, isFirst);
        if (pairs)
            collision::particle_contacts::addPasses(program, *pairs, predicted, next, isFirst);
        else
            addFinish(program, predicted, next);
    }
    // Appends the end of a substep in which no particles touch each other.
    void addFinish(ProgramBuilder& program, const ParticleBuffers& predicted,
                   const ParticleBuffers& next) const {
        std::vector<BufferId> buffers{predicted.positions, predicted.velocities, next.step, next.positions,
                                      next.velocities};
        ProgramBuilder::Constants constants = remainderConstants(next.layout);
        buffers.insert(buffers.end(), {before, planes.planes, planes.contactOffsets});
        constants.merge(planes.constants());
        forces::bindTo(next, &forces::Forces::ofPlanes, buffers, constants);
        buffers.push_back(particles);
        program.dispatch(kernels::finishAfterSurfaces, particleCount, buffers,
                         layout::CountPush{particleCount}, constants);
    }
    // Appends restitution after all contacts of a substep; velocities alternate.
    void addBounces(ProgramBuilder& program, const ParticleBuffers& met, ParticleBuffers& current) {
        if (faces) collision::row_contacts::addBounces(program, faces->rows, current);
        if (edges) collision::row_contacts::addBounces(program, edges->rows, current);
        if (!pairs || !pairs->surfaces.hasRestitution) return;
        collision::particle_contacts::addBounces(program, *pairs, met, current);
        std::swap(current.velocities, pairs->rebounding);
    }
    // Whether a particle may end a substep at another position than its velocity gives.
    bool moveUnseen() const { return pairs || (faces && (faces->hasStops() || faces->zones.exist())); }
    void joinIslands(sleep::Sleep& sleep) const {
        if (faces) collision::row_contacts::joinIslands(faces->rows, sleep);
        if (edges) collision::row_contacts::joinIslands(edges->rows, sleep);
        if (pairs) collision::particle_contacts::joinIslands(*pairs, sleep);
    }
    void addPublishing(ProgramBuilder& program) const {
        if (faces) collision::row_contacts::addPublishing(program, faces->rows, faces->lists.grid);
        if (edges) collision::row_contacts::addPublishing(program, edges->rows, edges->lists.grid);
        if (pairs) collision::particle_contacts::addPublishing(program, *pairs);
    }
};

Touching addTouching(const Common& common, const ParticleBuffers& particles) {
    namespace faces = collision::face_contacts;
    namespace edges = collision::edge_contacts;
    const SceneModel& model = common.model;
    Touching touching;
    if (model.facesTouch()) touching.faces = faces::add(common.program, model, particles);
    if (const auto meeting = edges::edgesThatMeet(model); !meeting.empty())
        touching.edges = edges::add(common.program, model, meeting, particles, *touching.faces);
    if (model.particlesTouch()) {
        touching.pairs = collision::particle_contacts::add(common.program, model);
        return touching;
    }
    const std::vector<std::uint32_t> slots = slotsInOrder(model.layout);
    touching.planes = rigid::planes::add(common.program, model.scene, model.layout);
    touching.particles = common.program.upload("state.particles", slots);
    touching.particleCount = static_cast<std::uint32_t>(slots.size());
    return touching;
}

// Appends the substeps of a scene with contacts: gathers leave predicted positions, and the passes of the
// contacts turn these into the state after the substep. Positions end in the buffer that they started in;
// velocities end in another one, so that contacts can read the old ones.
void addTouchingSubsteps(const Common& common, const ParticleBuffers& particles) {
    ProgramBuilder& program = common.program;
    const StateLayout& layout = common.model.layout;
    const std::uint32_t substeps = common.model.settings.substeps;
    Touching contacts = addTouching(common, particles);
    if (particles.sleep) contacts.joinIslands(*particles.sleep);
    if (contacts.faces) collision::addFaceFilter(program, *contacts.faces);
    if (contacts.edges) collision::addEdgeFilter(program, *contacts.edges);
    if (contacts.pairs) collision::addContactFilter(program, *contacts.pairs);
    const std::vector<Gather> gathers = addGathers(common);
    const auto attachments = constraints::attachment::add(program, common.model.scene, layout);
    const auto tethers = constraints::tether::add(program, common.model);
    const auto rigid = addRigid(common);
    const auto driven = rigid::driven::add(program, common.model.scene, layout, rigid);
    sleep::addOpening(program, particles, attachments, rigid);
    ParticleBuffers current = particles, predicted = particles;
    predicted.positions = program.scratch<layout::vec4>("state.next_positions", positionCount(layout));
    predicted.velocities = program.scratch<layout::vec4>("state.linked_velocities", layout.count);
    BufferId spare = program.scratch<layout::vec4>("state.next_velocities", layout.count);
    for (std::uint32_t substep = 0; substep < substeps; ++substep) {
        program.beginSubstep();
        rigid::colliders::addOpening(program, current, rigid, substep == 0);
        contacts.begin(current.velocities);
        addLinks(gathers, current, predicted, substep == 0);
        if (particles.forces) forces::addPulls(program, predicted);
        rigid::driven::addPass(program, predicted, driven, substep);
        std::swap(current.velocities, spare);
        contacts.addPasses(program, predicted, current, substep == 0);
        contacts.addBounces(program, predicted, current);
        constraints::attachment::addPass(program, current, attachments, substep, substeps);
        grabs::addPass(program, current, substep, substeps, Kick::whole);
        constraints::tether::addPass(program, current, tethers);
        if (contacts.faces) {
            collision::face_contacts::addZones(program, *contacts.faces, predicted, current);
            collision::face_contacts::addStops(program, *contacts.faces, current);
        }
        rigid::colliders::addPass(program, current, rigid, substep, Kick::whole,
                                  contacts.moveUnseen() ? &predicted : nullptr);
    }
    program.endSubsteps();
    if (current.velocities != particles.velocities) program.copy(current.velocities, particles.velocities);
    program.keepForRepeat(particles.positions);
    program.keepForRepeat(particles.velocities);
    program.atEnd([&program, contacts] { contacts.addPublishing(program); });
}

void addPasses(ProgramBuilder& program, const SceneModel& model, const stiffness::Shares& shares,
               const ParticleBuffers& particles) {
    const Scene& scene = model.scene;
    program.program().sweeps = scene.distances.empty() ? 0 : model.settings.substeps;
    if (model.particlesTouch() || model.facesTouch() || model.settings.keepsForces) {
        addTouchingSubsteps({program, model, shares, {}}, particles);
        return;
    }
    const Common common{program, model, shares, rigid::planes::add(program, scene, model.layout)};
    if (isResident(scene, model.settings, model.grids))
        addResident(common, particles);
    else
        addSubsteps(common, particles);
}

} // namespace

bool contactsFollow(const Scene& scene, const Settings& settings) {
    return particlesTouch(scene) || facesTouch(scene) || settings.keepsForces;
}

SolverPlan plan(const SceneModel& model) {
    stiffness::Shares shares = stiffness::sharesOf(model.scene, model.settings, model.inverseMass);
    std::vector<float> times = shares.times;
    return {std::move(times),
            [&model, shares = std::move(shares)](ProgramBuilder& program, const ParticleBuffers& particles) {
                addPasses(program, model, shares, particles);
            }};
}

} // namespace sinew::sim::solvers::split
