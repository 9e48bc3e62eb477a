// The tables of the collider pass.
#include "sim/rigid/colliders.hpp"

#include "kernels.hpp"
#include "sim/forces/forces.hpp"
#include "sim/rigid/collider_paths.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sinew::sim::rigid::colliders {

namespace {

static_assert(ranges::mostHostColliders + ranges::mostColliders + ranges::mostDriven == MOST_MOVERS);

constexpr std::uint32_t hasReboundId = 6, hasContactsId = 7; // constant_ids in solve_colliders.comp
constexpr std::uint32_t colliderCountId = 2, isMovingId = 3,
                        hostColliderCountId = 4; // constant_id in colliders.glsl

std::uint32_t groupsOf(std::uint32_t items) {
    return (items - 1) / GROUP_ITEMS + 1;
}

// Appends a pass that runs only with host colliders, unless something else `needsIt`: `element` is the group
// count that the host sets.
template <typename Push>
void dispatch(ProgramBuilder& program, const Colliders& colliders, bool needsIt, IndirectItems items,
              const vk::ShaderCode& code, std::span<const BufferId> buffers, const Push& push,
              const ProgramBuilder::Constants& constants = {}) {
    items.arguments = colliders.hostColliderArguments;
    if (needsIt)
        program.dispatch(code, items.most, buffers, push, constants);
    else
        program.dispatchIndirect(code, items, buffers, push, constants);
}

// Poses at the start of the step and after every substep; a single set if nothing moves.
void addPoses(ProgramBuilder& program, const Scene& scene, std::uint32_t substeps, Colliders& colliders) {
    if (!colliders.areMoving) {
        std::vector<layout::ColliderPose> poses;
        const ColliderPaths paths(scene.colliders, scene.driven);
        for (const Pose& pose : paths.allPoses()) poses.push_back(onDevice(pose, 1));
        colliders.poses = program.upload("colliders.poses", poses);
        return;
    }
    const std::uint32_t count = colliders.placed, items = count * (substeps + 1);
    colliders.ways = program.scratch<layout::ColliderPose>("colliders.ways", 2 * count);
    colliders.poses =
        program.scratch<layout::ColliderPose>("colliders.poses", std::uint64_t{count} * (substeps + 1));
    program.updateColliders(colliders.ways);
    const std::array buffers{colliders.ways, colliders.poses};
    dispatch(program, colliders, count > colliders.hostColliders, {{}, HOST_COLLIDERS_PLACED, items},
             kernels::placeColliders, buffers, layout::PlacePush{items, count, substeps});
    program.program().hostColliders.placed = groupsOf(items);
}

constexpr float mostStretch = 2; // of a link from a driven particle to one that rests on it

// A sphere around everything of a driven body that a particle may touch or be linked to, for tests of
// proximity (sleep).
layout::Collider ballAround(const DrivenBody& body, const Scene& scene) {
    float widest = 0, thickest = 0;
    double farthest = 0;
    for (const Particle& particle : scene.particles) widest = std::max(widest, particle.radius);
    for (const Face& face : scene.faces) thickest = std::max(thickest, face.thickness);
    const Pose pose = poseAt(body, 0);
    std::vector<float> reach(scene.particles.size(), -1); // of links from a driven particle
    for (const std::uint32_t particle : particlesOf(body)) reach[particle] = 0;
    for (const DistanceConstraint& link : scene.distances)
        for (const auto& [held, other] : {std::pair{link.a, link.b}, std::pair{link.b, link.a}})
            if (reach[held] >= 0 && reach[other] < 0)
                reach[held] = std::max(reach[held], mostStretch * link.restLength);
    for (const std::uint32_t particle : particlesOf(body)) {
        const Vec3 local = toLocal(pose, scene.particles[particle].position);
        farthest = std::max(farthest, std::hypot(double{local.x}, double{local.y}, double{local.z}) +
                                          double{reach[particle]});
    }
    layout::Collider ball{};
    ball.core.w = static_cast<float>(farthest) + 2 * widest + thickest;
    return ball;
}

constexpr float noParticle = -1e38f; // contact offset of a slot without one

void addShapes(ProgramBuilder& program, const Scene& scene, const StateLayout& layout, Colliders& colliders) {
    std::vector<layout::Collider> shapes(colliders.hostColliders);
    for (const Collider& collider : scene.colliders) shapes.push_back(shapeOf(collider));
    for (const DrivenBody& body : scene.driven) shapes.push_back(ballAround(body, scene));
    colliders.shapes = program.upload("colliders", shapes);
    if (colliders.hostColliders > 0) {
        colliders.hostColliderArguments =
            program.scratch<layout::DispatchArguments>("host_colliders.arguments", HOST_COLLIDER_ARGUMENTS);
        program.updateHostColliders(colliders.shapes, colliders.hostColliderArguments);
        program.program().hostColliders.touching = groupsOf(colliders.particles);
    }
    if (colliders.count == 0) return;
    const bool areMany = colliders.count > FEW_COLLIDERS;
    std::vector<float> offsets(layout.count, areMany ? noParticle : 0);
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        offsets[layout.slot[i]] = scene.particles[i].contactOffset;
    colliders.contactOffsets = program.upload("colliders.contact_offsets", offsets);
}

// The number of words of a record of near colliders.
std::uint32_t nearWords(const Colliders& colliders) {
    return NEAR_HEAD + (colliders.count + 31) / 32;
}

// Over all particles.
template <typename Push>
void dispatchTouching(ProgramBuilder& program, const Colliders& colliders, const vk::ShaderCode& code,
                      std::span<const BufferId> buffers, const Push& push,
                      const ProgramBuilder::Constants& constants = {}) {
    dispatch(program, colliders, colliders.count > colliders.hostColliders,
             {{}, HOST_COLLIDERS_TOUCHING, colliders.particles}, code, buffers, push, constants);
}

layout::ColliderPush pushOf(const Colliders& colliders, const Substep& substep) {
    const std::uint32_t row = colliders.areMoving ? colliders.placed : 0;
    const auto& forces = substep.particles.forces;
    return {colliders.particles, substep.index * row, (substep.index + 1) * row,
            substep.kick == Kick::half ? 0.5f : 0, forces ? forces->colliderForceScale : 0};
}

ProgramBuilder::Constants constantsOf(const Colliders& colliders) {
    return {{colliderCountId, colliders.count},
            {isMovingId, colliders.areMoving},
            {hostColliderCountId, colliders.hostColliders}};
}

// The pass that finds the colliders near each work group, if they are many.
void addNear(Build& build, Colliders& colliders) {
    if (colliders.count <= FEW_COLLIDERS) return;
    const Settings& settings = build.model.settings;
    const std::uint32_t groups = groupsOf(colliders.particles);
    colliders.near = build.program.scratchOfStep<std::uint32_t>("colliders.near",
                                                                std::uint64_t{groups} * nearWords(colliders));
    const ParticleBuffers& particles = build.particles;
    dispatchTouching(build.program, colliders, kernels::findNearColliders,
                     std::array{colliders.shapes, colliders.poses, colliders.contactOffsets,
                                particles.positions, particles.velocities, particles.step, colliders.near},
                     layout::NearPush{colliders.particles,
                                      colliders.areMoving ? settings.substeps * colliders.placed : 0,
                                      settings.substeps, particles.supportReach},
                     {{colliderCountId, colliders.count}, {hostColliderCountId, colliders.hostColliders}});
}

} // namespace

void add(Build& build) {
    ProgramBuilder& program = build.program;
    const Scene& scene = build.model.scene;
    const Settings& settings = build.model.settings;
    const StateLayout& layout = build.model.layout;
    const auto count = static_cast<std::uint32_t>(scene.colliders.size()) + settings.hostColliders;
    if (count == 0 && scene.driven.empty()) return;
    const auto moves = [](const auto& item) { return isMoving(item); };
    const auto rebounds = [](const auto& item) { return item.restitution > 0; };
    Colliders colliders{.count = count,
                        .hostColliders = settings.hostColliders,
                        .particles = static_cast<std::uint32_t>(layout.count),
                        .placed = count + static_cast<std::uint32_t>(scene.driven.size()),
                        .areMoving = settings.hostColliders > 0 ||
                                     std::ranges::any_of(scene.colliders, moves) ||
                                     std::ranges::any_of(scene.driven, moves)};
    colliders.hasRebound =
        colliders.count > 0 &&
        (std::ranges::any_of(scene.colliders, rebounds) || std::ranges::any_of(scene.planes, rebounds) ||
         rebounds(scene.contacts) ||
         std::ranges::any_of(scene.contacts.surfaces, rebounds)); // the way is then not h v
    addShapes(program, scene, layout, colliders);
    addPoses(program, scene, settings.substeps, colliders);
    addNear(build, colliders);
    if (colliders.hasRebound && settings.solver != Solver::gaussSeidel)
        colliders.before =
            program.scratch<layout::vec4>("colliders.before", 2 * std::uint64_t{colliders.particles});
    build.keep(colliders);
}

void addSaving(Build& build, const Substep& substep) {
    const Colliders* colliders = build.find<Colliders>();
    if (!colliders || colliders->before == BufferId{}) return;
    const ParticleBuffers& particles = substep.particles;
    const std::array buffers{particles.positions, particles.velocities, colliders->before, particles.step};
    dispatchTouching(build.program, *colliders, kernels::saveSubstepStart, buffers,
                     layout::SubstepPush{colliders->particles, substep.index == 0});
}

void addPass(Build& build, const Substep& substep) {
    const Colliders* found = build.find<Colliders>();
    if (!found || found->count == 0) return;
    const Colliders& colliders = *found;
    const ParticleBuffers& particles = substep.particles;
    std::vector<BufferId> buffers{colliders.shapes,    colliders.poses,      colliders.contactOffsets,
                                  particles.positions, particles.velocities, particles.step};
    ProgramBuilder::Constants constants = constantsOf(colliders);
    if (substep.isOpen()) {
        buffers.push_back(substep.corrections);
    } else {
        const bool hasContacts = substep.predicted && !colliders.hasRebound;
        buffers.insert(buffers.end(), {boundIf(colliders.hasRebound, colliders.before),
                                       hasContacts ? substep.predicted->positions : unbound,
                                       hasContacts ? substep.predicted->velocities : unbound});
        constants.insert({{hasReboundId, colliders.hasRebound}, {hasContactsId, hasContacts}});
        constants.merge(remainderConstants(particles.layout));
        constants.merge(receivedConstants(particles));
        buffers.push_back(particles.received);
    }
    forces::bindTo(particles, &forces::Forces::ofColliders, buffers, constants);
    buffers.push_back(particles.forces && particles.forces->summed > 0 ? particles.forces->colliderForces
                                                                       : unbound);
    buffers.push_back(colliders.near);
    dispatchTouching(build.program, colliders,
                     substep.isOpen() ? kernels::solveCollidersOpen : kernels::solveColliders, buffers,
                     pushOf(colliders, substep), constants);
}

} // namespace sinew::sim::rigid::colliders
