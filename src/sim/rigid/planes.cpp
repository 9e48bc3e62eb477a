// The host side of boundary planes.
#include "sim/rigid/planes.hpp"

#include "kernels.hpp"
#include "sim/forces/forces.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <array>

namespace sinew::sim::rigid::planes {

namespace {

constexpr std::uint32_t planeCountId = 2; // constant_id in planes.glsl
static_assert(ranges::mostPlanes == MOST_PLANES);

// Appends a pass over all particles.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const vk::ShaderCode& code,
             std::vector<BufferId> buffers, ProgramBuilder::Constants constants) {
    forces::bindTo(particles, &forces::Forces::ofPlanes, buffers, constants);
    program.dispatch(code, particles.count, buffers, layout::CountPush{particles.count}, constants);
}

} // namespace

ProgramBuilder::Constants Planes::constants() const {
    return {{planeCountId, count}};
}

Planes add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout) {
    if (scene.planes.empty()) return {};
    std::array<layout::PlaneCollider, MOST_PLANES> table{}; // a uniform block
    for (std::size_t p = 0; p < scene.planes.size(); ++p) {
        const Plane& plane = scene.planes[p];
        const Vec3& n = plane.normal;
        table[p] = {{n.x, n.y, n.z, plane.offset},
                    plane.friction,
                    plane.restitution,
                    std::max(plane.friction, plane.staticFriction),
                    0};
    }
    std::vector<float> offsets(layout.count, 0);
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        offsets[layout.slot[i]] = scene.particles[i].contactOffset;
    return {.count = static_cast<std::uint32_t>(scene.planes.size()),
            .planes = program.upload("planes", std::vector{table}),
            .contactOffsets = program.upload("contact_offsets", offsets)};
}

void addTouch(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
              const Planes& planes) {
    if (planes.count == 0) return;
    addPass(program, particles, kernels::projectOntoPlanes,
            {particles.positions, particles.velocities, corrections, planes.planes, planes.contactOffsets,
             particles.step},
            planes.constants());
}

Contacts addContacts(ProgramBuilder& program, const Scene& scene) {
    if (scene.planes.empty()) return {};
    return {add(program, scene, orderedLayout(scene.particles.size())),
            program.scratch<layout::PlaneContact>("contacts", scene.particles.size())};
}

void addOpen(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts) {
    if (contacts.planes.count == 0) return;
    program.dispatch(kernels::openPlaneContacts, particles.count, {particles.velocities, contacts.contacts},
                     layout::CountPush{particles.count});
}

void addSolve(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts) {
    if (contacts.planes.count == 0) return;
    addPass(program, particles, kernels::solvePlanes,
            {particles.positions, particles.velocities, contacts.contacts, contacts.planes.planes,
             contacts.planes.contactOffsets, particles.step},
            contacts.planes.constants());
}

void addVelocityUpdate(ProgramBuilder& program, const ParticleBuffers& particles, const Contacts& contacts) {
    addPass(program, particles, kernels::updateVelocity,
            {particles.velocities, particles.step, contacts.contacts, contacts.planes.planes,
             boundIf(particles.forces != nullptr, particles.positions)},
            contacts.planes.constants());
}

} // namespace sinew::sim::rigid::planes
