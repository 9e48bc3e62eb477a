// Tethers sorted by particle, in the order of the scene.
#include "sim/constraints/tether.hpp"

#include "kernels.hpp"
#include "sim/forces/forces.hpp"
#include "sim/program/first_contents.hpp"

#include <algorithm>

namespace sinew::sim::constraints::tether {

namespace {

// Tethers of a list on the device that a cut may remove: a cuttable body contains both ends. Labels of pieces
// are their lowest slots.
void addCuts(ProgramBuilder& program, const SceneModel& model, Tethers& tethers) {
    CuttingBuffers& cutting = program.program().cutting;
    if (cutting.runs.empty()) return;
    const auto labels = firstContents<std::uint32_t>(program, cutting.labels); // of uncut bodies
    const auto mayBeCut = [&](std::uint32_t slot) {
        return std::ranges::any_of(cutting.runs, [&](const CutRun& run) {
            return slot >= run.first && slot - run.first < run.count;
        });
    };
    std::vector<layout::CutTether> parted;
    for (std::uint32_t t = 0; t < model.tethers().size(); ++t) {
        const Tether& tether = model.tethers()[t];
        const std::uint32_t particle = model.layout.slot[tether.particle],
                            anchor = model.layout.slot[tether.anchor];
        if (mayBeCut(particle) && mayBeCut(anchor) && labels[particle] == labels[anchor])
            parted.push_back({t, particle, anchor, tether.length});
    }
    if (parted.empty()) return;
    cutting.topology.push_back(tethers.tethers);
    program.addToState(tethers.tethers, tethers.tethers);
    tethers.cut = program.upload("cut.tethers", parted);
    tethers.cutCount = static_cast<std::uint32_t>(parted.size());
}

} // namespace

void add(Build& build) {
    const SceneModel& model = build.model;
    if (model.tethers().empty()) return;
    std::vector<layout::TetheredParticle> particles;
    std::uint32_t last = 0; // last particle, once there is one
    std::vector<layout::TetherReach> reaches;
    for (const Tether& tether : model.tethers()) {
        if (particles.empty() || last != tether.particle)
            particles.push_back(
                {model.layout.slot[tether.particle], static_cast<std::uint32_t>(reaches.size()), 0});
        last = tether.particle;
        ++particles.back().count;
        reaches.push_back({model.layout.slot[tether.anchor], tether.length});
    }
    Tethers& tethers = build.keep(Tethers{.count = static_cast<std::uint32_t>(particles.size()),
                                          .particles = build.program.upload("tethers.particles", particles),
                                          .tethers = build.program.upload("tethers", reaches)});
    addCuts(build.program, model, tethers);
}

void addPass(Build& build, const Substep& substep) {
    const Tethers* tethers = build.find<Tethers>();
    if (!tethers) return;
    const ParticleBuffers& particles = substep.particles;
    std::vector<BufferId> buffers{tethers->particles, tethers->tethers, particles.positions,
                                  substep.changed(), particles.step};
    ProgramBuilder::Constants constants;
    forces::bindTo(particles, &forces::Forces::ofTethers, buffers, constants);
    build.program.dispatch(substep.isOpen() ? kernels::solveTethersOpen : kernels::solveTethers,
                           tethers->count, buffers, layout::CountPush{tethers->count}, constants);
}

void addCutPass(Build& build) {
    const Tethers* tethers = build.find<Tethers>();
    if (!tethers || tethers->cutCount == 0) return;
    build.program.only(When::cut, [&] {
        build.program.dispatch(kernels::disableCutTethers, tethers->cutCount,
                               {build.program.program().cutting.labels, tethers->cut, tethers->tethers},
                               layout::CountPush{tethers->cutCount});
    });
}

} // namespace sinew::sim::constraints::tether
