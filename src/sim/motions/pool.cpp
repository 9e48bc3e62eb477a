// The host side of bodies that may be absent: their tables, the order of their passes, and who may be one.
#include "sim/motions/pool.hpp"

#include "common/absent.h"
#include "kernels.hpp"
#include "sim/core/complaints.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/model/links.hpp"
#include "sim/program/first_contents.hpp"
#include "sim/rigid/driven.hpp"
#include "sim/sleep/sleep.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/solver_names.hpp"
#include "sinew/step.hpp"

#include <algorithm>

namespace sinew::sim::motions {

namespace {

namespace k = kernels;

static_assert(Motion::absentPlace == ABSENT_PLACE);

constexpr std::uint32_t noBody = 0xffffffff;
// constant_ids of move_pool.comp and mask_pool.comp
constexpr std::uint32_t movesSleepersId = 1, mayBeGrabbedId = 2, hasRadiiId = 1, hasTouchingId = 2,
                        hasWatchedId = 3, leavesDebrisId = 4;

struct Pool {
    layout::PoolPush push{};
    BufferId particles, bodies, changes, absent, arguments; // bodies: by slot, of the scene
    std::vector<std::uint32_t> numbers;   // by slot: the body among those that may be absent
    std::shared_ptr<sleep::Sleep> listed; // groups that run, if nothing sleeps
    std::vector<BufferId> lists;          // arguments of dispatches over listed chunks
};

template <typename Visit> void forEachAbsent(const Scene& scene, const Visit& visit) {
    for (const Body& body : scene.bodies)
        for (std::uint32_t i = 0; body.isAbsent && i < body.particleCount; ++i) visit(body.firstParticle + i);
}

std::vector<layout::PoolBody> poolBodiesOf(const SceneModel& model) {
    std::vector<layout::PoolBody> bodies;
    for (std::uint32_t b = 0; b < model.scene.bodies.size(); ++b)
        if (const Body& body = model.scene.bodies[b]; body.isAbsent)
            bodies.push_back({b, model.layout.slot[body.firstParticle]});
    return bodies;
}

std::vector<layout::PoolParticle> poolParticlesOf(const SceneModel& model,
                                                  const std::vector<layout::vec4>& stored) {
    const std::vector<Vec3> start = lattice::startingPositions(model.scene, model.inverseMass);
    std::vector<layout::PoolParticle> particles;
    for (std::uint32_t b = 0; b < model.scene.bodies.size(); ++b) {
        const Body& body = model.scene.bodies[b];
        for (std::uint32_t p = body.firstParticle;
             body.isAbsent && p < body.firstParticle + body.particleCount; ++p) {
            const std::uint32_t slot = model.layout.slot[p];
            particles.push_back(
                {{start[p].x, start[p].y, start[p].z, model.inverseMass[p]}, slot, p, b, stored[slot].w});
        }
    }
    return particles;
}

// By particle: the body that may be absent, or none.
std::vector<std::uint32_t> absentBodies(const Scene& scene) {
    std::vector<std::uint32_t> bodies(scene.particles.size(), noBody);
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
        for (std::uint32_t i = 0; scene.bodies[b].isAbsent && i < scene.bodies[b].particleCount; ++i)
            bodies[scene.bodies[b].firstParticle + i] = b;
    return bodies;
}

// By slot: the number among bodies that may be absent.
std::vector<std::uint32_t> numbersOfSlots(const SceneModel& model) {
    std::vector<std::uint32_t> numbers(model.layout.count, POOL_PADDING), ofBodies(model.scene.bodies.size());
    std::uint32_t next = 0;
    for (std::size_t b = 0; b < ofBodies.size(); ++b)
        ofBodies[b] = model.scene.bodies[b].isAbsent ? next++ : POOL_STAYS;
    const std::vector<std::uint32_t> bodies = absentBodies(model.scene);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        numbers[model.layout.slot[i]] = bodies[i] == noBody ? POOL_STAYS : ofBodies[bodies[i]];
    return numbers;
}

// The same by chunk of a lattice, which may begin at a slot without a particle.
std::vector<std::uint32_t> numbersOfChunks(const SceneModel& model, std::span<const std::uint32_t> ofSlots,
                                           std::span<const layout::LatticeChunk> chunks) {
    std::vector<std::uint32_t> ofGrids(model.layout.count, POOL_STAYS); // by slot of a box
    for (std::size_t g = 0; g < model.grids.size(); ++g) {
        const Grid& grid = model.scene.grids[model.grids[g]];
        const lattice::Box& box = model.boxes[g];
        std::fill(ofGrids.begin() + box.origin, ofGrids.begin() + box.end,
                  ofSlots[model.layout.slot[grid.firstParticle]]);
    }
    std::vector<std::uint32_t> numbers;
    for (const layout::LatticeChunk& chunk : chunks) numbers.push_back(ofGrids.at(chunk.origin));
    return numbers;
}

// The reasons that keep bodies from being absent: the first that is found for each body.
class Reasons {
public:
    explicit Reasons(const Scene& scene) : bodies_(absentBodies(scene)), reasons_(scene.bodies.size()) {}

    void add(std::uint32_t particle, const char* reason) {
        if (bodies_[particle] != noBody && reasons_[bodies_[particle]] == nullptr)
            reasons_[bodies_[particle]] = reason;
    }
    template <typename Ends> void addUnlessOfOne(const Ends& ends, const char* reason) {
        for (const std::uint32_t end : ends)
            if (bodies_[end] != bodies_[ends[0]]) {
                for (const std::uint32_t one : ends) add(one, reason);
                return;
            }
    }
    const char* of(std::size_t body) const { return reasons_[body]; }

private:
    std::vector<std::uint32_t> bodies_;
    std::vector<const char*> reasons_;
};

// Particles of two bodies, and of skins that other bodies share.
void addShared(const Scene& scene, Reasons& reasons) {
    std::vector<std::uint8_t> owners(scene.particles.size(), 0);
    for (const Body& body : scene.bodies)
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
            if (++owners[i] > 1) {
                reasons.add(i, "shares a particle with another body");
                break;
            }
    for (const Skin& skin : scene.skins) {
        std::vector<std::uint32_t> carriers = skin.particles;
        for (const CellEmbedding& cell : skin.cells)
            carriers.insert(carriers.end(), cell.particles.begin(), cell.particles.end());
        if (!carriers.empty()) reasons.addUnlessOfOne(carriers, "has a skin with what is not of it");
    }
}

Reasons reasonsAgainst(const Scene& scene) {
    Reasons reasons(scene);
    addShared(scene, reasons);
    const std::vector<float> w = inverseMasses(scene);
    const std::vector<bool> isDriven = rigid::driven::areDriven(scene);
    for (std::uint32_t i = 0; i < w.size(); ++i) {
        if (w[i] == 0 || isDriven[i]) reasons.add(i, "has a fixed or driven particle");
        if (scene.particles[i].keepsRest) reasons.add(i, "keeps rest distances at load (keepsRest)");
    }
    forEachLink(scene,
                [&](const auto& ends) { reasons.addUnlessOfOne(ends, "is linked to what is not of it"); });
    for (const Face& face : scene.faces)
        reasons.addUnlessOfOne(face.particles, "has a face with a particle that is not of it");
    for (const Attachment& one : scene.attachments) reasons.add(one.particle, "has an attachment");
    for (const Tether& one : scene.tethers) reasons.add(one.particle, "has a tether");
    return reasons;
}

} // namespace

std::vector<Vec3> withAbsent(const Scene& scene, std::vector<Vec3> positions) {
    forEachAbsent(scene, [&](std::uint32_t i) { positions[i] = {ABSENT_PLACE, ABSENT_PLACE, ABSENT_PLACE}; });
    return positions;
}

std::vector<float> withAbsent(const Scene& scene, std::vector<float> inverseMasses) {
    forEachAbsent(scene, [&](std::uint32_t i) { inverseMasses[i] = 0; });
    return inverseMasses;
}

bool haveAbsent(const Scene& scene) {
    return std::ranges::any_of(scene.bodies, &Body::isAbsent);
}

std::vector<bool> restoredBodies(const Scene& scene) {
    std::vector<bool> restored(scene.bodies.size());
    const std::vector<std::uint32_t> bodies = absentBodies(scene);
    for (const Grid& grid : scene.grids)
        if (grid.isCuttable && bodies[grid.firstParticle] != noBody)
            restored[bodies[grid.firstParticle]] = true;
    return restored;
}

void addPool(Build& build, BufferId requests, BufferId bodiesOfSlots) {
    const SceneModel& model = build.model;
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    const std::vector<layout::PoolBody> bodies = poolBodiesOf(model);
    const std::vector<layout::PoolParticle> members =
        poolParticlesOf(model, firstContents<layout::vec4>(program, particles.positions));
    Pool pool{.push = {.count = static_cast<std::uint32_t>(members.size()),
                       .bodies = static_cast<std::uint32_t>(bodies.size()),
                       .motions = model.settings.motions,
                       .all = static_cast<std::uint32_t>(model.scene.bodies.size()),
                       .slots = static_cast<std::uint32_t>(model.layout.count)},
              .particles = program.upload("pool.particles", members),
              .bodies = bodiesOfSlots,
              .changes = program.scratch<std::uint32_t>("pool.changes", model.scene.bodies.size()),
              .absent = program.scratch<std::uint32_t>("pool.absent", bodies.size()),
              .arguments = program.scratchOfStep<layout::DispatchArguments>("pool.arguments", POOL_ARGUMENTS),
              .numbers = numbersOfSlots(model),
              .listed = nullptr};
    program.dispatch(k::planPool, GROUP_ITEMS,
                     {requests, particles.positions, program.upload("pool.bodies", bodies), pool.absent,
                      pool.changes, pool.arguments},
                     pool.push);
    const auto& sleep = particles.sleep;
    const auto& grabs = particles.grabs;
    ProgramBuilder::Constants constants = remainderConstants(particles.layout);
    constants.insert({{movesSleepersId, sleep != nullptr}, {mayBeGrabbedId, grabs != nullptr}});
    program.dispatchIndirect(k::movePool, {pool.arguments, POOL_PARTICLES, pool.push.count},
                             {requests, pool.particles, pool.changes, particles.positions,
                              particles.velocities, sleep::weightsOf(particles),
                              sleep ? sleep->islands : unbound, sleep ? sleep->marks : unbound,
                              sleep ? sleep->state : unbound, grabs ? grabs->grips : unbound, particles.step,
                              sleep::groupsOf(particles)},
                             pool.push, constants);
    build.keep(std::move(pool));
}

std::optional<Changes> changesOf(const Build& build) {
    const Pool* pool = build.find<Pool>();
    return pool ? std::optional(Changes{pool->bodies, pool->changes}) : std::nullopt;
}

void addPoolMasks(Build& build) {
    const Pool* pool = build.find<Pool>();
    if (!pool) return;
    ProgramBuilder& program = build.program;
    const ContactBuffers& contacts = program.program().contacts;
    const CuttingBuffers& cutting = program.program().cutting;
    const bool hasDebris = cutting.debris > 0;
    for (const GridBuffers& grid :
         std::vector(program.program().grids)) { // copied: adding buffers may move it
        const bool isOfEdges = grid.name == "edges.grid", hasTouching = grid.touching != BufferId{},
                   hasWatched = grid.watched != grid.radii;
        const BufferId initial = program.initialOf(grid.name + ".radii.initial", grid.radii);
        program.dispatchIndirect(
            k::maskPool, {pool->arguments, POOL_PARTICLES, pool->push.count},
            {pool->particles, pool->changes, grid.detected, grid.bounds, boundIf(!isOfEdges, initial),
             boundIf(!isOfEdges, grid.radii),
             hasTouching ? program.initialOf(grid.name + ".touching.initial", grid.touching) : unbound,
             boundIf(hasTouching, grid.touching),
             hasWatched ? program.initialOf(grid.name + ".watched.initial", grid.watched) : unbound,
             boundIf(hasWatched, grid.watched), boundIf(hasDebris, cutting.pieces)},
            pool->push,
            {{hasRadiiId, !isOfEdges},
             {hasTouchingId, hasTouching},
             {hasWatchedId, hasWatched},
             {leavesDebrisId, hasDebris}});
        if (!isOfEdges) continue;
        layout::PoolPush push = pool->push;
        push.count = grid.count;
        program.dispatchIndirect(k::maskPoolEdges,
                                 {pool->arguments, POOL_EDGES, POOL_EDGE_GROUPS * GROUP_ITEMS},
                                 {contacts.edges, pool->bodies, pool->changes, initial, grid.radii}, push);
    }
}

std::optional<IndirectItems> addPoolChunks(Build& build, BufferId chunks, std::uint32_t perGroup,
                                           std::uint32_t items) {
    Pool* pool = build.find<Pool>();
    if (!pool) return {};
    ProgramBuilder& program = build.program;
    const auto all = firstContents<layout::LatticeChunk>(program, chunks);
    const std::vector<std::uint32_t> bodies = numbersOfChunks(build.model, pool->numbers, all);
    if (std::ranges::count(bodies, POOL_STAYS) == std::ssize(bodies)) return {};
    const std::string name = "pool.chunks[" + std::to_string(pool->lists.size()) + "]";
    const auto count = static_cast<std::uint32_t>(all.size());
    const layout::DispatchArguments groups{(count + perGroup - 1) / perGroup, 1, 1, 0};
    const BufferId arguments =
        program.upload(name + ".arguments", std::vector<layout::DispatchArguments>{groups, groups});
    program.dispatchIndirect(k::listPoolChunks, {pool->arguments, POOL_LISTS, GROUP_ITEMS},
                             {program.initialOf(name + ".all", chunks),
                              program.upload(name + ".bodies", bodies), pool->absent, chunks, arguments},
                             layout::PoolListPush{count, perGroup, std::min(count, items)});
    pool->lists.push_back(arguments);
    return IndirectItems{arguments, 0, items};
}

void addPoolGroups(Build& build) {
    Pool* pool = build.find<Pool>();
    if (!pool) return;
    ProgramBuilder& program = build.program;
    if (const auto& sleep = build.particles.sleep) {
        for (const BufferId arguments : pool->lists)
            program.dispatchIndirect(k::gatePoolChunks, {pool->arguments, POOL_ALWAYS, 1},
                                     {sleep->arguments, arguments}, layout::PoolListPush{});
        return;
    }
    pool->listed = sleep::addGroups(build);
    program.dispatchIndirect(
        k::markPoolGroups, {pool->arguments, POOL_SLOTS, pool->push.slots},
        {program.upload("pool.slots", pool->numbers), pool->absent, pool->listed->groups}, pool->push);
    sleep::addListing(program, pool->listed, {pool->arguments, POOL_LISTS, GROUP_ITEMS});
}

void endPoolGroups(Build& build) {
    if (const Pool* pool = build.find<Pool>(); pool && pool->listed)
        sleep::finishListing(build.program, *pool->listed);
}

void checkPool(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if (!haveAbsent(scene)) return;
    if (settings.solver != Solver::split)
        complaints.add(std::string("solver ") + solverName(settings.solver) +
                           " does not support bodies that may be absent (Body::isAbsent)",
                       "use split");
    if (settings.motions == 0)
        complaints.add("settings.motions", "is 0, but the scene has bodies that may be absent, which motions "
                                           "spawn: must be at least 1");
    const Reasons reasons = reasonsAgainst(scene);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        const char* reason = body.particleCount == 0 ? "has no particles" : reasons.of(b);
        if (body.isAbsent && reason)
            complaints.add(element("body", b) + " \"" + body.name + "\"",
                           std::string("may be absent (isAbsent), but ") + reason);
    }
}

} // namespace sinew::sim::motions
