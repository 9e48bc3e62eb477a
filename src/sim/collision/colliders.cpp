// The tables of the collider pass.
#include "sim/collision/colliders.hpp"

#include "kernels.hpp"
#include "sim/collision/collider_paths.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::colliders {

namespace {

constexpr std::uint32_t colliderCountId = 2, isMovingId = 3; // constant_id in colliders.glsl

layout::Collider shapeOf(const Collider& collider) {
    layout::Collider shape{.core = {0, 0, 0, collider.radius + collider.margin},
                           .friction = collider.friction,
                           .staticFriction = std::max(collider.friction, collider.staticFriction),
                           .restitution = collider.restitution,
                           .unused0 = 0};
    const Vec3& extents = collider.halfExtents;
    if (collider.shape == ColliderShape::capsule) shape.core.y = collider.halfLength;
    if (collider.shape == ColliderShape::box) shape.core = {extents.x, extents.y, extents.z, collider.margin};
    return shape;
}

// After every substep, and at the beginning; where nothing moves, once and for all.
BufferId addPoses(ProgramBuilder& program, const Scene& scene, std::uint32_t substeps, bool areMoving,
                  BufferId& ways) {
    const ColliderPaths paths(scene.colliders, scene.driven);
    std::vector<layout::ColliderPose> poses;
    for (const Pose& pose : paths.allPoses()) {
        const Vec3& x = pose.position;
        const Quaternion& q = pose.rotation;
        poses.push_back({{x.x, x.y, x.z, 0}, {q.x, q.y, q.z, q.w}});
    }
    if (!areMoving) return program.upload("colliders.poses", poses);
    const auto count = static_cast<std::uint32_t>(poses.size());
    ways = program.scratch<layout::ColliderPose>("colliders.ways", 2 * count);
    const BufferId placed =
        program.scratch<layout::ColliderPose>("colliders.poses", std::uint64_t{count} * (substeps + 1));
    program.updateColliders(ways);
    const std::uint32_t items = count * (substeps + 1);
    program.dispatch(kernels::placeColliders, items, {ways, placed},
                     layout::PlacePush{items, count, substeps});
    return placed;
}

// A ball around all of a driven body that anybody may touch, for who asks what is near it (sleep).
layout::Collider ballAround(const DrivenBody& body, const Scene& scene) {
    float widest = 0, thickest = 0;
    double farthest = 0;
    for (const Particle& particle : scene.particles) widest = std::max(widest, particle.radius);
    for (const Face& face : scene.faces) thickest = std::max(thickest, face.thickness);
    const Pose pose = poseAt(body, 0);
    for (std::uint32_t i = 0; i < body.particleCount; ++i) {
        const Vec3 local = toLocal(pose, scene.particles[body.firstParticle + i].position);
        farthest = std::max(farthest, std::hypot(double{local.x}, double{local.y}, double{local.z}));
    }
    layout::Collider ball{};
    ball.core.w = static_cast<float>(farthest) + 2 * widest + thickest;
    return ball;
}

void addShapes(ProgramBuilder& program, const Scene& scene, const StateLayout& layout, Colliders& colliders) {
    std::vector<layout::Collider> shapes;
    for (const Collider& collider : scene.colliders) shapes.push_back(shapeOf(collider));
    for (const DrivenBody& body : scene.driven) shapes.push_back(ballAround(body, scene));
    colliders.shapes = program.upload("colliders", shapes);
    if (colliders.count == 0) return;
    std::vector<float> offsets(layout.count, 0);
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        offsets[layout.slot[i]] = scene.particles[i].contactOffset;
    colliders.contactOffsets = program.upload("colliders.contact_offsets", offsets);
}

layout::ColliderPush pushOf(const Colliders& colliders, std::uint32_t substep, Kick kick) {
    const std::uint32_t row = colliders.areMoving ? colliders.placed : 0;
    return {colliders.particles, substep * row, (substep + 1) * row, kick == Kick::half ? 0.5f : 0};
}

ProgramBuilder::Constants constantsOf(const Colliders& colliders) {
    return {{colliderCountId, colliders.count}, {isMovingId, colliders.areMoving}};
}

} // namespace

Colliders add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout,
              std::uint32_t substeps) {
    if (scene.colliders.empty() && scene.driven.empty()) return {};
    const auto moves = [](const auto& item) { return isMoving(item); };
    const auto rebounds = [](const auto& item) { return item.restitution > 0; };
    Colliders colliders{.count = static_cast<std::uint32_t>(scene.colliders.size()),
                        .particles = static_cast<std::uint32_t>(layout.count),
                        .placed = static_cast<std::uint32_t>(scene.colliders.size() + scene.driven.size()),
                        .areMoving = std::ranges::any_of(scene.colliders, moves) ||
                                     std::ranges::any_of(scene.driven, moves)};
    colliders.hasRebound =
        colliders.count > 0 &&
        (std::ranges::any_of(scene.colliders, rebounds) || std::ranges::any_of(scene.planes, rebounds) ||
         rebounds(scene.contacts) ||
         std::ranges::any_of(scene.contacts.surfaces, rebounds)); // the way is then not h v
    addShapes(program, scene, layout, colliders);
    colliders.poses = addPoses(program, scene, substeps, colliders.areMoving, colliders.ways);
    return colliders;
}

void addMemory(ProgramBuilder& program, Colliders& colliders) {
    if (colliders.hasRebound)
        colliders.before =
            program.scratch<layout::vec4>("colliders.before", 2 * std::uint64_t{colliders.particles});
}

void addOpening(ProgramBuilder& program, const ParticleBuffers& particles, const Colliders& colliders,
                bool isFirst) {
    if (!colliders.hasRebound) return;
    program.dispatch(kernels::openColliders, colliders.particles,
                     {particles.positions, particles.velocities, colliders.before, particles.step},
                     layout::SubstepPush{colliders.particles, isFirst});
}

void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Colliders& colliders,
             std::uint32_t substep, Kick kick) {
    if (colliders.count == 0) return;
    std::vector<BufferId> buffers{colliders.shapes,    colliders.poses,      colliders.contactOffsets,
                                  particles.positions, particles.velocities, particles.step};
    if (colliders.hasRebound) buffers.push_back(colliders.before);
    program.dispatch(colliders.hasRebound ? kernels::solveCollidersRebound : kernels::solveColliders,
                     colliders.particles, buffers, pushOf(colliders, substep, kick), constantsOf(colliders));
}

void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 const Colliders& colliders, std::uint32_t substep) {
    if (colliders.count == 0) return;
    program.dispatch(kernels::solveCollidersOpen, colliders.particles,
                     {colliders.shapes, colliders.poses, colliders.contactOffsets, particles.positions,
                      particles.velocities, particles.step, corrections},
                     pushOf(colliders, substep, Kick::half), constantsOf(colliders));
}

} // namespace sinew::sim::collision::colliders
