// The host side of contacts between particles: their buffers, and the order of the passes.
#include "sim/collision/particle_contacts.hpp"

#include "common/rest_slack.h"
#include "kernels.hpp"
#include "sim/collision/cut_contacts.hpp"
#include "sim/collision/debris_contacts.hpp"
#include "sim/collision/overlaps.hpp"
#include "sim/events/events.hpp"
#include "sim/forces/forces.hpp"
#include "sim/sleep/sleep.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace sinew::sim::collision::particle_contacts {

namespace {

namespace k = kernels;

// Whether pairs with friction have different coefficients.
bool hasFrictionTable(const Contacts& contacts) {
    return contacts.surfaces.count > 0 && contacts.surfaces.hasFriction;
}

constexpr std::uint32_t checksListsId = 3, hasReboundId = 13; // constant_id in finish_without_contacts.comp
constexpr std::uint32_t hasFrictionId = 3, hasRecoveryId = 4; // constant_ids in gather_contacts.comp
constexpr std::uint32_t keepsRestId = 5;    // also in count_contacts.comp and in those of bounces
constexpr std::uint32_t hasMemoryId = 6;    // in gather_contacts.comp
constexpr std::uint32_t hasSurfacesId = 7;  // also in the kernels of bounces
constexpr std::uint32_t followsRowsId = 25; // in receive.glsl
constexpr std::uint32_t canOpenId = 6, countsNearId = 7; // in count_contacts.comp

// By state slot; below 0 = touches nothing.
std::vector<float> radiiOf(const SceneModel& model) {
    std::vector<float> radii(model.layout.count, -1);
    const std::vector<float>& loose = model.looseRadii();
    for (std::size_t i = 0; i < loose.size(); ++i)
        if (loose[i] > 0) radii[model.layout.slot[i]] = loose[i];
    return radii;
}

float medianRadius(std::vector<float> radii) {
    std::erase_if(radii, [](float radius) { return radius <= 0; });
    std::ranges::nth_element(radii, radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2));
    return radii[radii.size() / 2];
}

float smallestRadius(const std::vector<float>& radii) {
    float smallest = std::numeric_limits<float>::max();
    for (const float radius : radii)
        if (radius > 0) smallest = std::min(smallest, radius);
    return smallest;
}

contact_lists::Exclusions exclusionsOf(const SceneModel& model) {
    std::vector<float> radii = model.looseRadii();
    for (float& radius : radii)
        if (radius <= 0) radius = -1;
    return contact_lists::excludedPairs(model.scene, model.linkedBodies(), radii, model.layout);
}

// Overlaps of the scene at load that exceed `least`; empty if a particle has more of them than a list can
// hold. The first step is then undone as too crowded, so no rest distance is lost silently.
overlaps::Overlaps overlapsOf(const SceneModel& model, std::span<const float> radii,
                              const contact_lists::Exclusions& exclusions, float least) {
    const Scene& scene = model.scene;
    const StateLayout& layout = model.layout;
    std::vector<std::array<float, 3>> positions(layout.count);
    std::vector<float> inverseMass(layout.count, 0);
    std::vector<std::uint8_t> keepsRest(layout.count, 0);
    const std::vector<std::uint32_t> arrivalOf = arrivals(scene);
    std::vector<std::uint32_t> arrivalsBySlot(layout.count, 0);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Vec3& x = scene.particles[i].position;
        positions[layout.slot[i]] = {x.x, x.y, x.z};
        inverseMass[layout.slot[i]] = model.inverseMass[i];
        keepsRest[layout.slot[i]] = scene.particles[i].keepsRest ? 1 : 0;
        arrivalsBySlot[layout.slot[i]] = arrivalOf[i];
    }
    overlaps::Overlaps found = overlaps::find({.positions = positions,
                                               .radii = radii,
                                               .inverseMasses = inverseMass,
                                               .exclusions = exclusions,
                                               .keepsRest = keepsRest,
                                               .arrivals = arrivalsBySlot,
                                               .least = least,
                                               .limit = LIST_MOST});
    if (overlaps::mostPartners(found) > LIST_MOST) found.clear();
    return found;
}

// Mean number of entries a particle with which all overlaps fit: none may be lost for lack of capacity. It is
// independent of the substeps, so that a simulation with another number of substeps can take over.
std::uint32_t roomFor(const overlaps::Overlaps& overlaps, std::size_t slots) {
    std::size_t entries = 0;
    for (const std::vector<overlaps::Overlap>& list : overlaps) entries += list.size();
    return static_cast<std::uint32_t>((entries + slots - 1) / slots);
}

// Smallest overlap that recovery must handle: a smaller one vanishes within a substep at that speed.
float leastOverlap(const Scene& scene, const Settings& settings) {
    return scene.contacts.recoverySpeed * scene.dt / static_cast<float>(settings.substeps);
}

// Memory of an overlap: the whole reach means interlocked, so that other overlaps stay below it; a kept one
// is negative.
float rememberedOf(const overlaps::Overlap& overlap, float reach) {
    if (overlap.isKept) return -std::min(overlap.depth + REST_SLACK * reach, reach);
    return std::min(overlap.depth, 0.999999f * reach);
}

// Overlaps as the initial lists, whose memory the first update keeps.
pooled_lists::Initial firstLists(const overlaps::Overlaps& found, std::span<const float> radii) {
    pooled_lists::Initial first;
    for (std::size_t i = 0; i < found.size(); ++i) {
        first.ranges.push_back(
            {static_cast<std::uint32_t>(first.contacts.size()), static_cast<std::uint32_t>(found[i].size())});
        for (const overlaps::Overlap& overlap : found[i]) {
            const float reach = radii[i] + radii[overlap.other];
            first.contacts.push_back({overlap.other, reach});
            first.memory.push_back({0, 0, 0, rememberedOf(overlap, reach)});
        }
    }
    return first;
}

// Ends the substep for all particles as if they touched nothing, and checks them; or does only the first for
// particles that were slowed down since.
void addUncontactedEnd(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                       const ParticleBuffers& next, bool checksLists) {
    const hash_grid::Grid& grid = contacts.lists.grid;
    std::vector<BufferId> buffers{predicted.positions, grid.detected,      predicted.velocities,
                                  grid.bounds,         grid.radii,         grid.fast,
                                  predicted.step,      grid.frames.frames, predicted.positions,
                                  next.positions,      next.velocities};
    ProgramBuilder::Constants constants = remainderConstants(next.layout);
    buffers.push_back(boundIf(contacts.hasRebound, contacts.before));
    buffers.insert(buffers.end(), {contacts.planes.planes, contacts.planes.contactOffsets, grid.ways,
                                   boundIf(grid.ways != unbound, grid.frames.ofSlots)});
    constants.merge(contacts.planes.constants());
    constants.insert({{checksListsId, checksLists}, {hasReboundId, contacts.hasRebound}});
    constants.merge(grid.checkConstants());
    layout::GridPush push = grid.push;
    push.count = contacts.particleCount;
    buffers.push_back(contacts.particles);
    if (checksLists)
        program.dispatch(k::finishWithoutContacts, push.count, buffers, push, constants);
    else
        program.dispatchIndirect(k::finishWithoutContacts, grid.slowed, buffers, push, constants);
}

// Appends a pass over all particles, or over those with a candidate.
void addOverContacts(ProgramBuilder& program, const Contacts& contacts, const vk::ShaderCode& code,
                     std::vector<BufferId> buffers, ProgramBuilder::Constants constants = {}) {
    if (!contacts.solvesListed) {
        program.dispatch(code, contacts.push.count, buffers, contacts.push, constants);
        return;
    }
    constants.emplace(RUNS_OVER_ID, RUNS_OVER_COUNTED);
    program.dispatchListed(code, contacts.lists.grid.touching, buffers, contacts.lists.touching,
                           contacts.push, constants);
}

void addListUpdate(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                   const ParticleBuffers& next, bool isFirst, bool isLast) {
    const hash_grid::Moved moved{predicted.positions, predicted.velocities, predicted.step,
                                 sleep::weightsOf(predicted), sleep::groupsOf(predicted)};
    if (isFirst) hash_grid::addFit(program, contacts.lists.grid, moved);
    if (contacts.solvesListed)
        addUncontactedEnd(program, contacts, predicted, next, true);
    else
        hash_grid::addListCheck(program, contacts.lists.grid, moved);
    contact_lists::addBuild(program, contacts.lists, moved, isLast);
    if (contacts.solvesListed) addUncontactedEnd(program, contacts, predicted, next, false);
    contact_lists::addLists(program, contacts.lists, moved);
}

void addCount(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted) {
    const contact_lists::Lists& lists = contacts.lists;
    std::vector<BufferId> buffers{
        predicted.positions, lists.pooled.contacts, lists.pooled.ranges, predicted.velocities,
        contacts.touching,   predicted.step,        lists.grid.bounds,   lists.hits};
    const bool canOpen = contacts.hasRecovery && contacts.isCuttable();
    buffers.insert(buffers.end(),
                   {contacts.hasRecovery ? contacts.lists.pooled.memory->memory : unbound,
                    boundIf(canOpen, contacts.marks), contacts.recoils.near, contacts.recoils.received});
    ProgramBuilder::Constants constants = receivedConstants(predicted);
    constants.insert({{hasRecoveryId, contacts.hasRecovery},
                      {keepsRestId, contacts.hasRecovery && contacts.hasKept},
                      {canOpenId, canOpen},
                      {countsNearId, contacts.countsNear}});
    addOverContacts(program, contacts, k::countContacts, std::move(buffers), constants);
}

void addEvents(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted) {
    const contact_lists::Lists& lists = contacts.lists;
    events::SeenPairs pairs{lists.pooled.contacts, lists.pooled.ranges, lists.hits, contacts.touching,
                            lists.grid.bounds};
    if (contacts.solvesListed) {
        pairs.items = lists.grid.touching;
        pairs.listed = lists.touching;
    }
    events::addPairs(program, predicted, pairs);
}

void addGather(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               const ParticleBuffers& next) {
    const contact_lists::Lists& lists = contacts.lists;
    std::vector<BufferId> buffers{contacts.touching,   lists.pooled.contacts, predicted.velocities,
                                  lists.pooled.ranges, predicted.positions,   next.positions,
                                  next.velocities,     predicted.step,        lists.grid.bounds,
                                  lists.hits};
    const bool hasMemory = contacts.hasMemory(), isTable = hasMemory && hasFrictionTable(contacts);
    const bool rebounds = contacts.hasRebound && contacts.planes.count > 0;
    buffers.insert(buffers.end(), {boundIf(hasMemory || rebounds, contacts.before),
                                   hasMemory ? contacts.lists.pooled.memory->memory : unbound,
                                   boundIf(isTable, contacts.surfaces.ofParticles),
                                   boundIf(isTable, contacts.surfaces.pairs), contacts.planes.planes,
                                   contacts.planes.contactOffsets});
    ProgramBuilder::Constants constants = remainderConstants(next.layout);
    constants.merge(contacts.planes.constants());
    constants.insert({{hasFrictionId, hasMemory && contacts.surfaces.hasFriction},
                      {hasRecoveryId, hasMemory && contacts.hasRecovery},
                      {keepsRestId, hasMemory && contacts.hasKept},
                      {hasMemoryId, hasMemory},
                      {hasSurfacesId, isTable},
                      {hasReboundId, rebounds}});
    buffers.push_back(contacts.recoils.received);
    constants.merge(recoils::constants(contacts.recoils, next));
    constants[followsRowsId] = contacts.recoils.followsRows;
    forces::bindTo(next, &forces::Forces::ofPlanes, buffers, constants);
    addOverContacts(program, contacts, k::gatherContacts, std::move(buffers), constants);
}

// Whether most touching particles belong to linked bodies: few of these have a candidate at a time.
bool areMostlyLinked(const SceneModel& model) {
    std::size_t linked = 0, all = 0;
    const std::vector<float>& radii = model.looseRadii();
    const std::vector<std::uint32_t>& bodies = model.linkedBodies();
    std::vector<std::uint32_t> sizes(bodies.size());
    for (const std::uint32_t body : bodies) ++sizes[body];
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (radii[i] <= 0) continue;
        ++all;
        linked += sizes[bodies[i]] > 1 ? 1 : 0;
    }
    return 2 * linked > all;
}

} // namespace

Contacts add(ProgramBuilder& program, const SceneModel& model) {
    const Scene& scene = model.scene;
    const Settings& settings = model.settings;
    const StateLayout& layout = model.layout;
    const std::vector<float> radii = radiiOf(model);
    contact_lists::Exclusions exclusions = exclusionsOf(model);
    overlaps::Overlaps overlaps = overlapsOf(model, radii, exclusions, 0);
    const std::uint32_t room = std::max(settings.contactRoom, roomFor(overlaps, layout.count));
    overlaps::forget(overlaps, leastOverlap(scene, settings));
    surfaces::Surfaces surfaces = surfaces::add(program, scene, layout);
    const bool isMostlyLinked = areMostlyLinked(model);
    const bool solvesListed = // keeping forces requires one end of the substep
        !settings.sleeps && !settings.keepsForces && isMostlyLinked && !surfaces.hasRestitution &&
        !overlaps::haveParting(overlaps);
    const bool countsNear = !isMostlyLinked && !surfaces.hasRestitution;
    const bool isCuttable = !exclusions.empty() && collision::canMeet(program.program(), scene);
    const bool hasRecovery = !overlaps.empty() || isCuttable;
    BufferId allExcluded;
    BufferId marks;
    if (isCuttable) {
        allExcluded = program.upload("contacts.all_excluded", exclusions);
        marks = program.upload("contacts.marks", contact_lists::linkedMarks(model));
    }
    const body_frames::Bodies bodies = body_frames::bodiesOf(model);
    const pooled_lists::Initial first = firstLists(overlaps, radii);
    Contacts contacts{.lists = contact_lists::add(
                          program, {.radii = radii,
                                    .margin = settings.contactMargin * medianRadius(model.looseRadii()),
                                    .isKept = overlaps::haveKept(overlaps),
                                    .capacity = room,
                                    .exclusions = std::move(exclusions),
                                    .bodies = &bodies,
                                    .hasWays = true,
                                    .substeps = settings.substeps,
                                    .hasMemory = surfaces.hasFriction || hasRecovery,
                                    .initial = first,
                                    .listsOwners = solvesListed}),
                      .planes = rigid::planes::add(program, scene, layout),
                      .surfaces = std::move(surfaces),
                      .solvesListed = solvesListed,
                      .countsNear = countsNear,
                      .hasRebound = std::ranges::any_of(
                          scene.planes, [](const Plane& plane) { return plane.restitution > 0; }),
                      .hasRecovery = hasRecovery,
                      .hasKept = overlaps::haveKept(overlaps),
                      .allExcluded = allExcluded,
                      .marks = marks};
    collision::letDebrisLeave(program, contacts.lists.grid.radii, contacts.lists.grid);
    contacts.push = {.count = contacts.lists.push.count,
                     .friction = contacts.surfaces.friction,
                     .staticFriction = contacts.surfaces.staticFriction,
                     .restitution = contacts.surfaces.restitution,
                     .recoverySpeed = scene.contacts.recoverySpeed,
                     .surfaces = contacts.surfaces.count};
    ContactBuffers& shown = program.program().contacts;
    shown.pairs = contacts.lists.pooled.contacts;
    shown.pairLists = contacts.lists.pooled.ranges;
    if (solvesListed) {
        const std::vector<std::uint32_t> slots = slotsInOrder(layout);
        contacts.particles = program.upload("contacts.particles", slots);
        contacts.particleCount = static_cast<std::uint32_t>(slots.size());
    }
    contacts.touching =
        program.scratch<layout::vec4>("contacts.touching", 2 * std::uint64_t{contacts.push.count});
    contacts.interlocks =
        interlocks::add(program, interlocks::find(scene, layout, model.linkedBodies(), overlaps),
                        layout.count, scene.contacts.recoverySpeed);
    if (scene.contacts.takesRecoils && countsNear)
        contacts.recoils = recoils::add(program, model, 2 * smallestRadius(radii));
    if (contacts.surfaces.hasRestitution) {
        contacts.bouncing = program.scratch<float>("contacts.bouncing", layout.count);
        contacts.rebounding = program.scratch<layout::vec4>("contacts.rebounding", layout.count);
    }
    return contacts;
}

void joinIslands(const Contacts& contacts, sleep::Sleep& sleep) {
    sleep.pairs = {
        contacts.lists.pooled.contacts, contacts.lists.pooled.ranges, contacts.lists.hits, contacts.touching,
        contacts.lists.grid.bounds,     contacts.lists.grid.ways};
}

void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               const ParticleBuffers& next, bool isFirst) {
    addListUpdate(program, contacts, predicted, next, isFirst, !contacts.interlocks);
    if (isFirst) collision::addContactOpening(program, contacts);
    if (contacts.interlocks) {
        interlocks::addPasses(program, *contacts.interlocks,
                              {contacts.lists, contacts.lists.pooled.memory->memory, contacts.touching},
                              predicted);
        addListUpdate(program, contacts, predicted, next, false, true); // they have moved since
    }
    sleep::addTouches(program, predicted);
    addCount(program, contacts, predicted);
    addEvents(program, contacts, predicted);
    addGather(program, contacts, predicted, next);
}

void addBounces(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                const ParticleBuffers& next) {
    const contact_lists::Lists& lists = contacts.lists;
    const bool isTable = contacts.surfaces.count > 0;
    std::vector<BufferId> shared{predicted.positions,  lists.pooled.contacts, contacts.before,
                                 predicted.velocities, lists.pooled.ranges,   next.step,
                                 lists.grid.bounds,    contacts.touching};
    shared.insert(shared.end(),
                  {boundIf(isTable, contacts.surfaces.ofParticles), boundIf(isTable, contacts.surfaces.pairs),
                   lists.hits, contacts.hasKept ? lists.pooled.memory->memory : unbound, next.velocities,
                   contacts.bouncing});
    ProgramBuilder::Constants constants{{keepsRestId, contacts.hasKept}, {hasSurfacesId, isTable}};
    program.dispatch(k::countRebounds, contacts.push.count, shared, contacts.push, constants);
    shared.insert(shared.end(), {next.positions, contacts.rebounding});
    forces::bindTo(next, &forces::Forces::ofContacts, shared, constants);
    program.dispatch(k::solveRebounds, contacts.push.count, shared, contacts.push, constants);
}

void addRecoils(ProgramBuilder& program, const Contacts& contacts, BufferId linked,
                const ParticleBuffers& predicted, const ParticleBuffers& state, std::uint32_t substep) {
    recoils::addPasses(program, contacts.recoils,
                       {contacts.lists, contacts.touching, contacts.hasRecovery, linked, contacts.before,
                        predicted.positions},
                       state, substep);
}

void addPublishing(ProgramBuilder& program, const Contacts& contacts) {
    pooled_lists::addPublishing(program, contacts.lists.pooled, contacts.lists.grid);
    if (contacts.interlocks) interlocks::addClosing(program, *contacts.interlocks);
}

} // namespace sinew::sim::collision::particle_contacts
