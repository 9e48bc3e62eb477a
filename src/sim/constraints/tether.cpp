// Tethers sorted by particle, in the order of the scene.
#include "sim/constraints/tether.hpp"

#include "kernels.hpp"
#include "sim/constraints/cut_tethers.hpp"
#include "sim/forces/forces.hpp"

#include <algorithm>

namespace sinew::sim::constraints::tether {

Tethers add(ProgramBuilder& program, const SceneModel& model) {
    if (model.tethers().empty()) return {};
    const StateLayout& layout = model.layout;
    std::vector<layout::TetheredParticle> particles;
    std::uint32_t last = 0; // last particle, once there is one
    std::vector<layout::TetherReach> reaches;
    std::vector<ListedTether> listed;
    for (const Tether& tether : model.tethers()) {
        if (particles.empty() || last != tether.particle)
            particles.push_back(
                {layout.slot[tether.particle], static_cast<std::uint32_t>(reaches.size()), 0});
        last = tether.particle;
        ++particles.back().count;
        reaches.push_back({layout.slot[tether.anchor], tether.length});
        listed.push_back({layout.slot[tether.particle], layout.slot[tether.anchor], tether.length});
    }
    const Tethers tethers{.count = static_cast<std::uint32_t>(particles.size()),
                          .particles = program.upload("tethers.particles", particles),
                          .tethers = program.upload("tethers", reaches)};
    addTetherFilter(program, tethers.tethers, listed);
    return tethers;
}

void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Tethers& tethers) {
    if (tethers.count == 0) return;
    std::vector<BufferId> buffers{tethers.particles, tethers.tethers, particles.positions,
                                  particles.velocities, particles.step};
    const layout::CountPush push{tethers.count};
    ProgramBuilder::Constants constants;
    forces::bindTo(particles, &forces::Forces::ofTethers, buffers, constants);
    program.dispatch(kernels::solveTethers, tethers.count, buffers, push, constants);
}

void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 const Tethers& tethers) {
    if (tethers.count == 0) return;
    std::vector<BufferId> buffers{tethers.particles, tethers.tethers, particles.positions, corrections,
                                  particles.step};
    const layout::CountPush push{tethers.count};
    ProgramBuilder::Constants constants;
    forces::bindTo(particles, &forces::Forces::ofTethers, buffers, constants);
    program.dispatch(kernels::solveTethersOpen, tethers.count, buffers, push, constants);
}

} // namespace sinew::sim::constraints::tether
