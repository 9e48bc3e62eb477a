// The tables of driven particles.
#include "sim/rigid/driven.hpp"

#include "kernels.hpp"
#include "sinew/colliders.hpp"

namespace sinew::sim::rigid::driven {

namespace {

// Calls `visit(body, pose before the first step, particle)` for all particles of bodies that move.
template <typename Visit> void forDriven(const Scene& scene, const Visit& visit) {
    for (std::uint32_t b = 0; b < scene.driven.size(); ++b) {
        const DrivenBody& body = scene.driven[b];
        if (!isMoving(body)) continue;
        const Pose pose = poseAt(body, 0);
        for (const std::uint32_t particle : particlesOf(body)) visit(b, pose, particle);
    }
}

} // namespace

std::vector<bool> areDriven(const Scene& scene) {
    std::vector<bool> result(scene.particles.size(), false);
    forDriven(scene, [&](std::uint32_t, const Pose&, std::uint32_t particle) { result[particle] = true; });
    return result;
}

void add(Build& build) {
    const auto* placed = build.find<colliders::Colliders>();
    if (!placed) return;
    const Scene& scene = build.model.scene;
    std::vector<layout::DrivenParticle> particles;
    forDriven(scene, [&](std::uint32_t body, const Pose& pose, std::uint32_t particle) {
        const Vec3 local = toLocal(pose, scene.particles[particle].position);
        particles.push_back(
            {{local.x, local.y, local.z, 0}, build.model.layout.slot[particle], placed->count + body, 0, 0});
    });
    if (particles.empty()) return;
    build.keep(Driven{.count = static_cast<std::uint32_t>(particles.size()),
                      .row = placed->placed,
                      .particles = build.program.upload("driven", particles),
                      .poses = placed->poses});
}

void addPass(Build& build, const Substep& substep) {
    const Driven* driven = build.find<Driven>();
    if (!driven) return;
    const ParticleBuffers& particles = substep.particles;
    build.program.dispatch(
        kernels::driveParticles, driven->count,
        {driven->particles, driven->poses, particles.positions, particles.velocities, particles.step},
        layout::DrivenPush{driven->count, substep.index * driven->row, (substep.index + 1) * driven->row});
}

} // namespace sinew::sim::rigid::driven
