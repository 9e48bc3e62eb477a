// Order of the phases of `jacobi`: predict; iterations of constraint pass, particle pass and planes; velocity
// update.
#include "sim/solvers/jacobi.hpp"

#include "kernels.hpp"
#include "sim/constraints/attachment.hpp"
#include "sim/constraints/bend.hpp"
#include "sim/constraints/correction_slots.hpp"
#include "sim/constraints/distance.hpp"
#include "sim/constraints/tether.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/rigid/colliders.hpp"
#include "sim/rigid/planes.hpp"

namespace sinew::sim::solvers::jacobi {

namespace {

// The permanent constraints: their corrections, and the lists by which a particle collects them.
struct Corrections {
    constraints::distance::Edges distances;
    constraints::bend::Rows bends;
    BufferId corrections, incidences, slots;
    std::uint32_t slotCount = 0;
};

Corrections addCorrections(ProgramBuilder& program, const SceneModel& model) {
    constraints::CorrectionSlots slots(model.scene.particles.size());
    Corrections result{.distances = constraints::distance::reserve(model, slots),
                       .bends = constraints::bend::reserve(model, slots)};
    result.slotCount = slots.size();
    if (result.slotCount == 0) return result;
    const std::vector<float> weights = slots.weights(model.settings);
    constraints::distance::upload(program, model, weights, result.distances);
    constraints::bend::upload(program, model, weights, result.bends);
    const constraints::CorrectionSlots::Lists lists = slots.lists(weights);
    result.corrections = program.scratch<layout::vec4>("corrections", result.slotCount);
    result.incidences = program.upload("incidences", lists.incidences);
    result.slots = program.upload("slots", lists.slots);
    return result;
}

void addIteration(ProgramBuilder& program, const ParticleBuffers& particles, const Corrections& corrections,
                  bool isFirst) {
    if (corrections.slotCount == 0) return;
    constraints::distance::addPass(program, particles, corrections.distances, corrections.corrections,
                                   isFirst);
    constraints::bend::addPass(program, particles, corrections.bends, corrections.corrections, isFirst);
    program.dispatch(kernels::applyCorrections, particles.count,
                     {corrections.incidences, corrections.slots, corrections.corrections, particles.positions,
                      particles.velocities, particles.step},
                     layout::CountPush{particles.count});
}

void addPasses(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles) {
    const Scene& scene = model.scene;
    const Settings& settings = model.settings;
    const Corrections corrections = addCorrections(program, model);
    const rigid::planes::Contacts contacts = rigid::planes::addContacts(program, scene);
    const auto attachments = constraints::attachment::add(program, scene, particles.layout);
    const auto tethers = constraints::tether::add(program, model);
    auto colliders = rigid::colliders::add(program, scene, settings, particles.layout);
    rigid::colliders::addMemory(program, colliders);
    const std::uint32_t iterations = corrections.slotCount > 0 ? settings.iterations : 1;
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        program.beginSubstep();
        rigid::planes::addOpen(program, particles, contacts);
        rigid::colliders::addOpening(program, particles, colliders, substep == 0);
        program.dispatch(kernels::predict, particles.count,
                         {particles.positions, particles.velocities, particles.step},
                         layout::CountPush{particles.count}, remainderConstants(particles.layout));
        for (std::uint32_t iteration = 0; iteration < iterations; ++iteration) {
            addIteration(program, particles, corrections, iteration == 0);
            rigid::planes::addSolve(program, particles, contacts);
        }
        constraints::attachment::addPass(program, particles, attachments, substep, settings.substeps);
        grabs::addPass(program, particles, substep, settings.substeps, Kick::half);
        constraints::tether::addPass(program, particles, tethers);
        rigid::colliders::addPass(program, particles, colliders, substep, Kick::half);
        if (scene.damping > 0 || !scene.planes.empty()) {
            rigid::planes::addVelocityUpdate(program, particles, contacts);
        }
    }
    program.endSubsteps();
    if (corrections.slotCount > 0) program.program().sweeps = std::uint64_t{settings.substeps} * iterations;
}

} // namespace

SolverPlan plan(const SceneModel& model) {
    return {model.inverseMass, [&model](ProgramBuilder& program, const ParticleBuffers& particles) {
                addPasses(program, model, particles);
            }};
}

} // namespace sinew::sim::solvers::jacobi
