// The buffers and passes of sleeping in order, and the choice of indirect dispatches.
#include "sim/sleep/sleep.hpp"

#include "kernels.hpp"
#include "sim/constraints/attachment.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/rigid/colliders.hpp"
#include "sim/rigid/driven.hpp"

#include <algorithm>
#include <numeric>

namespace sinew::sim::sleep {

namespace {

namespace k = kernels;

constexpr std::uint32_t hasWaysId = 14;              // constant_id in fall_asleep.comp
constexpr std::uint32_t fallId = 15, isFirstId = 16; // constant_ids in wake_islands.comp
constexpr std::uint32_t mostPasses = 64;             // passes that differ in kind or number of groups

std::uint32_t groupsOf(std::uint32_t items, std::uint32_t groupSize) {
    return (items - 1) / groupSize + 1;
}

// By slot the first slot of its linked component. Static particles connect nothing.
std::vector<std::uint32_t> componentsOf(const SceneModel& model) {
    const StateLayout& layout = model.layout;
    const std::vector<std::uint32_t>& components = model.components();
    std::vector<std::uint32_t> least(components.size(), ~0u), result(layout.count);
    for (std::size_t i = 0; i < components.size(); ++i)
        least[components[i]] = std::min(least[components[i]], layout.slot[i]);
    std::iota(result.begin(), result.end(), 0u);
    for (std::size_t i = 0; i < components.size(); ++i) result[layout.slot[i]] = least[components[i]];
    return result;
}

std::vector<float> weightsOf(const SceneModel& model) {
    const std::vector<bool> isDriven = rigid::driven::areDriven(model.scene);
    std::vector<float> weights(model.layout.count, 0);
    for (std::size_t i = 0; i < isDriven.size(); ++i)
        weights[model.layout.slot[i]] = isDriven[i] ? SLEEP_DRIVEN : model.inverseMass[i];
    return weights;
}

// By slot 1 for a particle without links.
std::vector<std::uint32_t> looseOf(const SceneModel& model) {
    const std::vector<std::uint32_t>& components = model.components();
    std::vector<std::uint32_t> sizes(components.size()), loose(model.layout.count);
    for (const std::uint32_t component : components) ++sizes[component];
    for (std::size_t i = 0; i < components.size(); ++i)
        loose[model.layout.slot[i]] = sizes[components[i]] == 1 ? 1 : 0;
    return loose;
}

IndirectItems itemsOf(Sleep& sleep, std::uint32_t kind, std::uint32_t items, std::uint32_t groupSize) {
    const layout::SleepPass pass{groupsOf(items, groupSize), kind};
    const auto isSame = [&](const layout::SleepPass& other) {
        return other.groups == pass.groups && other.kind == pass.kind;
    };
    const auto found = std::ranges::find_if(sleep.passesSeen, isSame);
    const auto element = static_cast<std::uint32_t>(found - sleep.passesSeen.begin());
    if (found == sleep.passesSeen.end()) sleep.passesSeen.push_back(pass);
    return {sleep.arguments, element, items};
}

// Passes over particles run for listed groups; any other pass runs entirely or not at all.
IndirectForm indirectForm(Sleep& sleep, const vk::KernelInterface& interface, std::uint32_t items) {
    const std::uint32_t groupSize = interface.groupSize[0];
    if (!interface.hasConstant(RUNS_OVER_ID)) return {itemsOf(sleep, SLEEP_ALL, items, groupSize), {}};
    return {itemsOf(sleep, SLEEP_LISTED, items, groupSize), sleep.listed};
}

IndirectItems wakingItems(const Sleep& sleep, std::uint32_t element, std::uint32_t items) {
    return {sleep.waking, element, items};
}

void addListAwake(ProgramBuilder& program, const Sleep& sleep, const IndirectItems& items) {
    program.dispatchIndirect(k::listAwake, items,
                             {sleep.groups, sleep.listed, sleep.passes, sleep.arguments, sleep.state},
                             sleep.push);
}

// Passes that wake the particles of marked islands, and then list the groups that run. `fall`: `particles`
// are predicted, and loose ones get the gravity of the substep.
void addWaking(ProgramBuilder& program, const Sleep& sleep, const ParticleBuffers& particles,
               std::uint32_t all, std::uint32_t one, bool fall = false) {
    ProgramBuilder::Constants constants;
    if (fall) constants = remainderConstants(particles.layout);
    constants[fallId] = fall;
    if (fall) constants[isFirstId] = !program.isAfterFirstSubstep();
    program.dispatchIndirect(k::wakeIslands, wakingItems(sleep, all, sleep.push.count),
                             {sleep.weights, particles.velocities, sleep.islands, sleep.marks, sleep.groups,
                              boundIf(fall, particles.positions), boundIf(fall, sleep.loose), particles.step},
                             sleep.push, constants);
    addListAwake(program, sleep, wakingItems(sleep, one, GROUP_ITEMS));
}

// Passes that wake islands marked in a substep.
void addWakingTouched(ProgramBuilder& program, Sleep& sleep, const ParticleBuffers& predicted, bool fall) {
    program.dispatchIndirect(k::planWaking, itemsOf(sleep, SLEEP_MIXED_ALL, 1, GROUP_ITEMS),
                             {sleep.state, sleep.waking}, sleep.push);
    addWaking(program, sleep, predicted, SLEEP_WAKING, SLEEP_WAKING_ONE, fall);
}

void makeIndirect(ProgramBuilder& program, const std::shared_ptr<Sleep>& sleep) {
    program.setIndirection([sleep](const vk::KernelInterface& interface, std::uint32_t items) {
        return indirectForm(*sleep, interface, items);
    });
}

// Sets the buffers of attachments and colliders, or placeholders for them.
void setMoving(ProgramBuilder& program, Sleep& sleep, const constraints::attachment::Attachments& attachments,
               const rigid::colliders::Colliders& colliders) {
    sleep.push.attachments = attachments.count;
    sleep.push.colliders = colliders.areMoving ? colliders.placed : 0;
    sleep.push.driven = colliders.areMoving ? colliders.placed - colliders.count : 0;
    const bool areAttached = attachments.count > 0, areMoving = colliders.areMoving;
    const std::uint64_t anchors = std::max(sleep.push.attachments, 1u);
    const std::uint64_t poses = std::max(sleep.push.colliders, 1u);
    sleep.attachments = areAttached ? attachments.particles
                                    : program.scratch<layout::AttachedParticle>("sleep.no_attachments", 1);
    sleep.anchors = areAttached ? attachments.anchors : program.scratch<layout::vec4>("sleep.no_anchors", 1);
    sleep.seenAnchors = program.scratch<layout::vec4>("sleep.anchors", anchors);
    sleep.colliders =
        areMoving ? colliders.shapes : program.scratch<layout::Collider>("sleep.no_colliders", 1);
    sleep.contactOffsets = areMoving && colliders.count > 0
                               ? colliders.contactOffsets
                               : program.scratch<float>("sleep.no_offsets", sleep.push.count);
    sleep.ways = areMoving ? colliders.ways : program.scratch<layout::ColliderPose>("sleep.no_ways", 1);
    sleep.seenPoses = program.scratch<layout::ColliderPose>("sleep.poses", poses);
    program.addToState(sleep.seenAnchors, sleep.seenAnchors, {.of = Elements::attachments});
    program.addToState(sleep.seenPoses, sleep.seenPoses, {.of = Elements::movers});
}

void setContents(ProgramBuilder& program, BufferId buffer, std::span<const std::byte> bytes) {
    std::vector<std::byte>& initial = program.program().buffers[buffer.index].initial;
    initial.assign(program.program().buffers[buffer.index].bytes(), std::byte{0});
    std::copy(bytes.begin(), bytes.end(), initial.begin());
}

// Buffers of listed groups, all of which run at first.
void addGroupBuffers(ProgramBuilder& program, Sleep& sleep) {
    std::vector<std::uint32_t> groups(sleep.push.groups);
    std::iota(groups.begin(), groups.end(), 0u);
    sleep.groups = program.upload("sleep.groups", std::vector<std::uint32_t>(groups.size(), 7));
    sleep.listed = program.upload("sleep.listed", groups);
    sleep.passes = program.scratch<layout::SleepPass>("sleep.passes", mostPasses);
    sleep.arguments = program.scratch<layout::DispatchArguments>("sleep.arguments", mostPasses);
}

// An empty list of passes with its counts and state; element 0 says whether anything runs.
std::shared_ptr<Sleep> makeSleep(Build& build) {
    const SceneModel& model = build.model;
    const auto count = static_cast<std::uint32_t>(model.layout.count);
    auto sleep = std::make_shared<Sleep>();
    sleep->push.count = count;
    sleep->push.groups = groupsOf(count, GROUP_ITEMS);
    sleep->push.passes = mostPasses; // unused ones have no groups
    sleep->push.substeps = model.settings.substeps;
    layout::SleepState state{};
    state.listed = sleep->push.groups;
    sleep->state = build.program.upload("sleep.state", std::vector{state});
    return sleep;
}

// Writes the passes that were seen, and their arguments of the first step: every particle is awake.
void setPasses(ProgramBuilder& program, const Sleep& sleep) {
    std::vector<layout::DispatchArguments> arguments;
    for (const layout::SleepPass& pass : sleep.passesSeen) {
        const bool runs = pass.kind == SLEEP_ALL || pass.kind == SLEEP_LISTED;
        arguments.push_back({runs ? pass.groups : 0, 1, 1, 0});
    }
    setContents(program, sleep.passes, std::as_bytes(std::span(sleep.passesSeen)));
    setContents(program, sleep.arguments, std::as_bytes(std::span(arguments)));
}

} // namespace

std::vector<float> restLimits(const Scene& scene, const StateLayout& layout) {
    constexpr float ofRadius = 0.02f, ofLength = 0.01f, ofNothing = 0.001f;
    std::vector<float> lengths(scene.particles.size()), links(scene.particles.size());
    for (const DistanceConstraint& d : scene.distances)
        for (const std::uint32_t end : {d.a, d.b}) {
            lengths[end] += d.restLength;
            links[end] += 1;
        }
    std::vector<float> limits(layout.count);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const float radius = scene.particles[i].radius;
        const float mean = links[i] > 0 ? lengths[i] / links[i] : 0;
        limits[layout.slot[i]] = radius > 0 ? ofRadius * radius : mean > 0 ? ofLength * mean : ofNothing;
    }
    return limits;
}

std::shared_ptr<Sleep> addGroups(Build& build) {
    auto sleep = makeSleep(build);
    addGroupBuffers(build.program, *sleep);
    return sleep;
}

void addListing(ProgramBuilder& program, const std::shared_ptr<Sleep>& sleep, const IndirectItems& items) {
    addListAwake(program, *sleep, items);
    makeIndirect(program, sleep);
}

void finishListing(ProgramBuilder& program, const Sleep& sleep) {
    program.setIndirection({});
    setPasses(program, sleep);
}

void add(Build& build) {
    const SceneModel& model = build.model;
    if (!model.settings.sleeps) return;
    ProgramBuilder& program = build.program;
    const StateLayout& layout = model.layout;
    const auto count = static_cast<std::uint32_t>(layout.count);
    auto sleep = makeSleep(build);
    sleep->weights = program.upload("sleep.weights", weightsOf(model));
    sleep->limits = program.upload("sleep.limits", restLimits(model.scene, layout));
    sleep->rests = program.scratch<layout::vec4>("sleep.rests", count);
    sleep->components = program.upload("sleep.components", componentsOf(model));
    // not where fields may bear what falls: they act on what is awake as a substep begins
    if (const std::vector<std::uint32_t> loose = looseOf(model);
        model.settings.fields == 0 && std::ranges::count(loose, 1u) > 0)
        sleep->loose = program.upload("sleep.loose", loose);
    sleep->islands = program.scratch<std::uint32_t>("sleep.islands", count);
    sleep->least = program.scratch<std::uint32_t>("sleep.least", count);
    sleep->marks = program.scratch<std::uint32_t>("sleep.marks", count);
    addGroupBuffers(program, *sleep);
    sleep->waking = program.scratch<layout::DispatchArguments>("sleep.waking", SLEEP_ARGUMENTS);
    program.program().sleep = {sleep->arguments, sleep->listed};
    program.addToState(sleep->state, sleep->state, {.of = Elements::one});
    program.addToState(sleep->rests, sleep->rests, {.of = Elements::slots});
    program.addToState(sleep->islands, sleep->islands, {.of = Elements::slots, .values = Elements::slots});
    itemsOf(*sleep, SLEEP_ALL, GROUP_ITEMS, GROUP_ITEMS); // element 0: whether anything runs
    build.particles.sleep = sleep;
}

void addOpening(Build& build) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    if (!particles.sleep) return;
    Sleep& sleep = *particles.sleep;
    const auto* attachments = build.find<constraints::attachment::Attachments>();
    const auto* colliders = build.find<rigid::colliders::Colliders>();
    setMoving(program, sleep, attachments ? *attachments : constraints::attachment::Attachments{},
              colliders ? *colliders : rigid::colliders::Colliders{});
    program.dispatch(k::openSleep, GROUP_ITEMS,
                     {sleep.state, program.program().status, sleep.waking, particles.step, sleep.anchors,
                      sleep.seenAnchors, sleep.ways, sleep.seenPoses},
                     sleep.push);
    if (const auto& grabs = particles.grabs)
        program.dispatchIndirect(k::wakeGrabbed, {grabs->pulling, 0, sleep.push.count},
                                 {grabs->bodies, grabs->held, grabs->pulling, sleep.weights,
                                  particles.velocities, sleep.islands, sleep.marks, sleep.waking},
                                 sleep.push);
    program.dispatchIndirect(k::markWaking, wakingItems(sleep, SLEEP_OPENING, sleep.push.count),
                             {sleep.state, sleep.weights, particles.velocities, particles.positions,
                              sleep.islands, sleep.marks, sleep.attachments, sleep.anchors, sleep.seenAnchors,
                              sleep.colliders, sleep.contactOffsets, sleep.ways, sleep.seenPoses},
                             sleep.push);
    addWaking(program, sleep, particles, SLEEP_OPENING, SLEEP_OPENING_ONE);
    makeIndirect(program, particles.sleep);
}

BufferId weightsOf(const ParticleBuffers& particles) {
    return particles.sleep ? particles.sleep->weights : unbound;
}

BufferId groupsOf(const ParticleBuffers& particles) {
    return particles.sleep ? particles.sleep->groups : unbound;
}

void addTouches(ProgramBuilder& program, const ParticleBuffers& predicted) {
    if (!predicted.sleep) return;
    Sleep& sleep = *predicted.sleep;
    program.dispatchIndirect(k::wakeTouched, itemsOf(sleep, SLEEP_MIXED, sleep.push.count, GROUP_ITEMS),
                             {sleep.weights, predicted.velocities, predicted.positions, sleep.islands,
                              sleep.marks, sleep.state, sleep.pairs.contacts, sleep.pairs.lists,
                              predicted.step, sleep.listed},
                             sleep.push);
    // Not where faces and edges touch: their contacts, which would bear what falls, were found before.
    addWakingTouched(program, sleep, predicted, sleep.loose != unbound && sleep.rows.empty());
}

void addRowTouches(ProgramBuilder& program, const ParticleBuffers& predicted, const SeenRows& rows) {
    if (!predicted.sleep) return;
    Sleep& sleep = *predicted.sleep;
    std::vector<BufferId> buffers{sleep.weights, predicted.velocities, sleep.islands, sleep.marks,
                                  sleep.state};
    buffers.insert(buffers.end(), rows.buffers.begin(), rows.buffers.end());
    program.dispatchIndirect(k::wakeRows, itemsOf(sleep, SLEEP_MIXED_ALL, sleep.push.count, GROUP_ITEMS),
                             buffers, sleep.push, rows.constants);
    addWakingTouched(program, sleep, predicted, false);
}

void addDetection(Build& build) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    if (!particles.sleep) return;
    const Sleep& sleep = *particles.sleep;
    const auto& status = program.program().status;
    const BufferId positions = particles.positions, velocities = particles.velocities;
    const auto add = [&](const vk::ShaderCode& code, const std::vector<BufferId>& buffers,
                         const ProgramBuilder::Constants& constants = {}) {
        program.dispatchIndirect(code, wakingItems(sleep, SLEEP_RESTING, sleep.push.count), buffers,
                                 sleep.push, constants);
    };
    program.setIndirection({});
    program.dispatch(k::closeSleep, GROUP_ITEMS,
                     {sleep.state, status, sleep.waking, particles.step, sleep.anchors, sleep.seenAnchors,
                      sleep.ways, sleep.seenPoses, sleep.arguments},
                     sleep.push);
    add(k::measureRestTimes, {sleep.weights, sleep.limits, positions, velocities, particles.step, sleep.rests,
                              sleep.components, sleep.islands, sleep.least});
    const auto& pairs = sleep.pairs;
    if (pairs.contacts != BufferId{})
        add(k::joinIslands, {sleep.weights, velocities, sleep.islands, pairs.contacts, pairs.lists,
                             pairs.hits, pairs.touching});
    for (const SeenRows& rows : sleep.rows) {
        std::vector<BufferId> buffers{sleep.weights, velocities, sleep.islands};
        buffers.insert(buffers.end(), rows.buffers.begin(), rows.buffers.end());
        add(k::joinRows, buffers, rows.constants);
    }
    add(k::findIslands, {sleep.weights, velocities, sleep.rests, sleep.islands, sleep.least});
    const bool hasWays = pairs.contacts != BufferId{};
    ProgramBuilder::Constants constants = remainderConstants(particles.layout);
    constants.insert({hasWaysId, hasWays});
    program.dispatchIndirect(k::fallAsleep, wakingItems(sleep, SLEEP_RESTING, sleep.push.count),
                             {sleep.weights, positions, velocities, particles.step, sleep.islands,
                              sleep.least, sleep.rests, boundIf(hasWays, pairs.ways)},
                             sleep.push, constants);
    makeIndirect(program, particles.sleep);
}

void finish(Build& build) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    if (!particles.sleep) return;
    const Sleep& sleep = *particles.sleep;
    program.dispatch(k::countAwake, sleep.push.count,
                     {sleep.weights, particles.velocities, program.program().status, sleep.groups,
                      sleep.marks, sleep.state},
                     sleep.push);
    program.setIndirection({});
    addListAwake(program, sleep, wakingItems(sleep, SLEEP_CLOSING_ONE, GROUP_ITEMS));
    setPasses(program, sleep);
}

} // namespace sinew::sim::sleep
