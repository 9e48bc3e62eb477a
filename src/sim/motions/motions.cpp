// The host side of motions: the tables of bodies, the order of the passes, and the checks of a step's
// motions.
#include "sim/motions/motions.hpp"

#include "kernels.hpp"
#include "sim/motions/pool.hpp"
#include "sim/sleep/sleep.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::motions {

namespace {

namespace k = kernels;

static_assert(MOST_MOTIONS == ranges::mostMotions && MOST_MOTIONS <= GROUP_ITEMS);
static_assert(MOTION_ALL_BODIES == Motion::allBodies);

// constant_ids of motions.glsl, apply_motions.comp and forget_contacts.comp
constexpr std::uint32_t maySleepId = 1, hasDebrisId = 2, isCuttableId = 3, areEdgesId = 1, haveShapesId = 2;

// Buffers that the host writes; and by slot the body of the scene.
struct Requests {
    BufferId requests, arguments, bodies;
};

struct Motions {
    layout::MotionPush push{};
    BufferId requests, arguments, bodies, sums, frames, placed;
    ProgramBuilder::Constants constants; // of motions.glsl
    std::vector<BufferId> members;       // its buffers
};

std::uint32_t groupsOf(std::size_t items) {
    return static_cast<std::uint32_t>((items + GROUP_ITEMS - 1) / GROUP_ITEMS);
}

// The centre of mass of a body in the scene [m].
std::array<float, 3> centerOf(const SceneModel& model, const Body& body) {
    double mass = 0, x = 0, y = 0, z = 0;
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
        const double m = 1 / double{model.inverseMass[i]};
        const Vec3& at = model.scene.particles[i].position;
        mass += m;
        x += m * double{at.x};
        y += m * double{at.y};
        z += m * double{at.z};
    }
    return {static_cast<float>(x / mass), static_cast<float>(y / mass), static_cast<float>(z / mass)};
}

std::vector<MotionBody> bodiesOf(const SceneModel& model) {
    const StateLayout& layout = model.layout;
    const auto count = static_cast<std::uint32_t>(layout.count);
    std::vector<MotionBody> bodies;
    const std::vector<bool> restored = restoredBodies(model.scene);
    for (const Body& body : model.scene.bodies) {
        const bool isRestored = restored[bodies.size()];
        MotionBody& one = bodies.emplace_back(MotionBody{.first = count});
        one.origin = body.particleCount > 0 ? layout.slot[body.firstParticle] : 0;
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
            one.first = std::min(one.first, layout.slot[i]);
            one.end = std::max(one.end, layout.slot[i] + 1);
            one.isHeld = one.isHeld || !model.moves(i);
        }
        one.isAbsent = body.isAbsent;
        one.isRestored = isRestored;
        if (body.isAbsent) one.center = centerOf(model, body);
    }
    bodies.push_back({.first = 0, .end = count, .origin = layout.slot.front()});
    return bodies;
}

IndirectItems itemsOf(const Motions& motions, std::uint32_t element, std::size_t most) {
    return {motions.arguments, element, static_cast<std::uint32_t>(most)};
}

Requests requestsOf(Build& build) {
    if (const Requests* found = build.find<Requests>()) return *found;
    ProgramBuilder& program = build.program;
    const Requests made{
        program.scratchOfStep<layout::MotionRequest>("motions.requests", build.model.settings.motions),
        program.scratchOfStep<layout::DispatchArguments>("motions.arguments", MOTION_ARGUMENTS),
        program.upload("motions.bodies",
                       bodiesOfSlots(build.model.scene, build.model.layout, MOTION_NO_BODY))};
    program.updateMotions(made.requests, made.arguments);
    return build.keep(made);
}

Motions& addBuffers(Build& build) {
    ProgramBuilder& program = build.program;
    const Requests given = requestsOf(build);
    const SceneModel& model = build.model;
    const std::uint32_t count = model.settings.motions;
    const auto slots = static_cast<std::uint32_t>(model.layout.count);
    const auto bodies = static_cast<std::uint32_t>(model.scene.bodies.size());
    const CuttingBuffers& cutting = program.program().cutting;
    const bool hasDebris = cutting.debris > 0, maySleep = build.particles.sleep != nullptr;
    Motions motions{
        .push = {slots, count, 0, bodies, model.settings.solver == Solver::split ? 1u : 0u},
        .requests = given.requests,
        .arguments = given.arguments,
        .bodies = given.bodies,
        .sums = program.scratchOfStep<layout::MotionSums>("motions.sums", std::size_t{count} * MOTION_CHUNKS),
        .frames = program.scratchOfStep<layout::MotionFrame>("motions.frames", count),
        .placed = program.scratchOfStep<std::uint32_t>("motions.placed", std::max(bodies, 1u)),
        .constants = remainderConstants(model.layout),
        .members = {}};
    motions.constants.insert({{maySleepId, maySleep}, {hasDebrisId, hasDebris}});
    motions.members = {motions.bodies, sleep::weightsOf(build.particles),
                       boundIf(hasDebris, cutting.particles), boundIf(hasDebris, cutting.pieces)};
    program.program().motions = {.slots = groupsOf(slots), .bodies = bodiesOf(model)};
    return build.keep(std::move(motions));
}

// Appends the passes of poses, or those of velocities.
void addRound(Build& build, const Motions& motions, bool isPose) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    const std::uint32_t first = isPose ? 0 : MOTION_VELOCITIES;
    layout::MotionPush push = motions.push;
    push.isPose = isPose ? 1 : 0;
    const auto with = [&](std::initializer_list<BufferId> more) {
        std::vector<BufferId> buffers{motions.requests, particles.positions, particles.velocities,
                                      particles.step};
        buffers.insert(buffers.end(), more);
        buffers.insert(buffers.end(), motions.members.begin(), motions.members.end());
        return buffers;
    };
    program.dispatchIndirect(
        k::measureMotions,
        itemsOf(motions, first + MOTIONS_MEASURED, std::size_t{push.motions} * MOTION_CHUNKS * GROUP_ITEMS),
        with({motions.sums}), push, motions.constants);
    program.dispatchIndirect(k::resolveMotions, itemsOf(motions, first + MOTIONS_RESOLVED, GROUP_ITEMS),
                             with({motions.sums, motions.frames, motions.placed}), push, motions.constants);
    const bool maySleep = particles.sleep != nullptr;
    std::vector<BufferId> buffers =
        with({motions.frames, maySleep ? particles.sleep->islands : unbound,
              maySleep ? particles.sleep->marks : unbound, maySleep ? particles.sleep->state : unbound});
    ProgramBuilder::Constants constants = motions.constants;
    if (isPose) {
        const BufferId before = program.program().cutting.placesBefore;
        constants.insert({isCuttableId, before != BufferId{}});
        buffers.insert(buffers.end(), {motions.placed, boundIf(before != BufferId{}, before)});
    }
    program.dispatchIndirect(isPose ? k::placeBodies : k::applyMotions,
                             itemsOf(motions, first + MOTIONS_APPLIED, push.count), buffers, push, constants);
}

bool isNear(const Vec3& v) {
    constexpr float farthest = 1e9f; // squares of differences fit into float32
    return std::abs(v.x) <= farthest && std::abs(v.y) <= farthest && std::abs(v.z) <= farthest;
}

double lengthOf(const Quaternion& q) {
    return std::hypot(std::hypot(double{q.x}, double{q.y}), std::hypot(double{q.z}, double{q.w}));
}

std::uint32_t kindOf(MotionKind kind) {
    switch (kind) {
    case MotionKind::addVelocity:
        return MOTION_ADD_VELOCITY;
    case MotionKind::setVelocity:
        return MOTION_SET_VELOCITY;
    case MotionKind::impulse:
        return MOTION_IMPULSE;
    case MotionKind::pose:
        return MOTION_POSE;
    case MotionKind::spawn:
        return MOTION_SPAWN;
    case MotionKind::despawn:
        return MOTION_DESPAWN;
    }
    return MOTION_NONE;
}

bool places(MotionKind kind) {
    return kindOf(kind) >= MOTION_POSE;
}

layout::MotionRequest onDevice(const Motion& motion, const MotionGroups& scene) {
    const MotionBody& body =
        scene.bodies[std::min<std::size_t>(motion.body, scene.bodies.size() - 1)]; // the last one is all
    const Vec3 &v = motion.linear, &a = motion.angular;
    const Vec3 mass{body.center[0], body.center[1], body.center[2]};
    const Vec3& c = motion.kind == MotionKind::spawn ? mass : motion.center;
    const Quaternion& q = motion.rotation;
    const double length = lengthOf(q);
    const auto unit = [length](float component) {
        return static_cast<float>(double{component} / (length > 0 ? length : 1));
    };
    return {.linear = {v.x, v.y, v.z, motion.radius},
            .angular = {a.x, a.y, a.z, 0},
            .center = {c.x, c.y, c.z, 0},
            .rotation = {unit(q.x), unit(q.y), unit(q.z), unit(q.w)},
            .kind = kindOf(motion.kind),
            .body = motion.body,
            .first = body.first,
            .end = body.end,
            .origin = body.origin,
            .unused0 = 0,
            .unused1 = 0,
            .unused2 = 0};
}

} // namespace

void add(Build& build) {
    if (build.model.settings.motions == 0) return;
    const Motions& motions = addBuffers(build);
    addRound(build, motions, true);
    addRound(build, motions, false);
}

void addComing(Build& build) {
    if (!haveAbsent(build.model.scene)) return;
    const Requests given = requestsOf(build);
    addPool(build, given.requests, given.bodies);
}

void addForgetting(Build& build) {
    const Motions* motions = build.find<Motions>();
    if (!motions) return;
    ProgramBuilder& program = build.program;
    const ContactBuffers& contacts = program.program().contacts;
    for (const GridBuffers& grid : program.program().grids)
        program.dispatchIndirect(k::strayPlaced, itemsOf(*motions, MOTIONS_APPLIED, motions->push.count),
                                 {motions->bodies, motions->placed, grid.detected}, motions->push);
    std::uint32_t list = 0;
    for (const ContactMemory& memory : program.program().contactMemory) {
        const bool ofFaces = memory.contacts == contacts.facePairs,
                   ofEdges = memory.contacts == contacts.edgePairs;
        layout::MotionPush push = motions->push;
        push.count = static_cast<std::uint32_t>(program.program().buffers[memory.ranges.index].count);
        program.program().motions.lists.at(list) = groupsOf(push.count);
        program.dispatchIndirect(k::forgetContacts, itemsOf(*motions, MOTIONS_FORGOTTEN + list++, push.count),
                                 {motions->bodies, motions->placed, motions->requests, motions->frames,
                                  memory.contacts, memory.ranges, memory.memory,
                                  ofFaces ? contacts.faces : boundIf(ofEdges, contacts.edges)},
                                 push, {{areEdgesId, ofEdges}, {haveShapesId, ofFaces || ofEdges}});
    }
    addPoolMasks(build);
}

void addPrevious(Build& build) {
    const Motions* motions = build.find<Motions>();
    if (!motions || !build.model.settings.keepsPrevious) return;
    ProgramBuilder& program = build.program;
    const Scene& scene = build.model.scene;
    const std::vector<std::uint32_t> bodies =
        bodiesOfSlots(scene, orderedLayout(scene.particles.size()), MOTION_NO_BODY);
    layout::MotionPush push = motions->push;
    push.count = static_cast<std::uint32_t>(scene.particles.size());
    program.program().motions.previous = groupsOf(push.count);
    program.dispatchIndirect(k::placePrevious, itemsOf(*motions, MOTIONS_PREVIOUS, push.count),
                             {program.upload("motions.bodies_of_particles", bodies), motions->placed,
                              motions->requests, motions->frames, program.program().status,
                              program.program().previousPositions, program.program().positions},
                             push);
}

Fault faultOf(const Motion& motion, const MotionGroups& scene) noexcept {
    constexpr float leastRadius = 1e-6f;                        // [m]
    constexpr double leastUnit = 1 - 1e-3, mostUnit = 1 + 1e-3; // length of a rotation
    const bool isOfAll = motion.body == Motion::allBodies;
    if (scene.bodies.empty()) return Fault::noRoom;
    if (kindOf(motion.kind) == MOTION_NONE) return Fault::kind;
    if (!isNear(motion.linear) || !isNear(motion.angular) || !isNear(motion.center) ||
        !std::isfinite(motion.radius))
        return Fault::number;
    if (!isOfAll && motion.body >= scene.bodies.size() - 1) return Fault::body;
    if (motion.radius != 0 && !(motion.radius >= leastRadius)) return Fault::radius;
    if (!places(motion.kind)) return Fault::none;
    if (isOfAll || motion.radius != 0) return Fault::notWhole;
    const MotionBody& body = scene.bodies[motion.body];
    if (motion.kind == MotionKind::despawn) return body.isAbsent ? Fault::none : Fault::isAlwaysThere;
    const double length = lengthOf(motion.rotation);
    if (!(length >= leastUnit && length <= mostUnit)) return Fault::rotation;
    if (motion.kind == MotionKind::spawn) return body.isAbsent ? Fault::none : Fault::isAlwaysThere;
    return body.isHeld ? Fault::isHeld : Fault::none;
}

const char* textOf(Fault fault) noexcept {
    switch (fault) {
    case Fault::none:
        break;
    case Fault::noRoom:
        return "is given, but settings.motions is 0";
    case Fault::kind:
        return "is of no known kind";
    case Fault::number:
        return "has a number that is not finite, or beyond 1e9";
    case Fault::body:
        return "is of a body that does not exist";
    case Fault::radius:
        return "has a radius that is neither 0 nor at least 1e-6 m";
    case Fault::notWhole:
        return "places a body, but not one whole one";
    case Fault::rotation:
        return "has a rotation that is not of unit length";
    case Fault::isHeld:
        return "is a pose of a body with a fixed or driven particle";
    case Fault::isAlwaysThere:
        return "spawns or despawns a body that the scene does not let be absent (isAbsent)";
    }
    return nullptr;
}

std::size_t MotionRequests::advance(std::span<const Motion> motions) noexcept {
    requests_ = {};
    undoCuts_ = false;
    std::size_t areFine = motions.size();
    bool arePoses = false, areVelocities = false;
    for (std::size_t m = 0; m < std::min<std::size_t>(count_, motions.size()); ++m) {
        if (faultOf(motions[m], *groups_) != Fault::none) {
            areFine = std::min(areFine, m);
            continue;
        }
        requests_[m] = onDevice(motions[m], *groups_);
        const bool isPose = places(motions[m].kind);
        arePoses = arePoses || isPose;
        undoCuts_ = undoCuts_ ||
                    (kindOf(motions[m].kind) >= MOTION_SPAWN && groups_->bodies[motions[m].body].isRestored);
        areVelocities = areVelocities || !isPose;
    }
    const auto set = [&](std::uint32_t element, bool runs, std::uint32_t groups) {
        arguments_[element] = {runs ? groups : 0, 1, 1, 0};
    };
    for (const bool isPose : {true, false}) {
        const std::uint32_t first = isPose ? 0 : MOTION_VELOCITIES;
        const bool runs = isPose ? arePoses : areVelocities;
        set(first + MOTIONS_MEASURED, runs, count_ * MOTION_CHUNKS);
        set(first + MOTIONS_RESOLVED, runs, 1);
        set(first + MOTIONS_APPLIED, runs, groups_->slots);
    }
    for (std::uint32_t list = 0; list < MOTION_LISTS; ++list)
        set(MOTIONS_FORGOTTEN + list, arePoses, groups_->lists[list]);
    set(MOTIONS_PREVIOUS, arePoses, groups_->previous);
    return areFine;
}

} // namespace sinew::sim::motions
