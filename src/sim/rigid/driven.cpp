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

Driven add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout,
           const colliders::Colliders& placed) {
    std::vector<layout::DrivenParticle> particles;
    const std::uint32_t first = placed.count;
    forDriven(scene, [&](std::uint32_t body, const Pose& pose, std::uint32_t particle) {
        const Vec3 local = toLocal(pose, scene.particles[particle].position);
        particles.push_back({{local.x, local.y, local.z, 0}, layout.slot[particle], first + body, 0, 0});
    });
    if (particles.empty()) return {};
    return {.count = static_cast<std::uint32_t>(particles.size()),
            .row = placed.placed,
            .particles = program.upload("driven", particles),
            .poses = placed.poses};
}

void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Driven& driven,
             std::uint32_t substep) {
    if (driven.count == 0) return;
    program.dispatch(
        kernels::driveParticles, driven.count,
        {driven.particles, driven.poses, particles.positions, particles.velocities, particles.step},
        layout::DrivenPush{driven.count, substep * driven.row, (substep + 1) * driven.row});
}

} // namespace sinew::sim::rigid::driven
