// Order of the phases of `jacobi`: predict; iterations of constraint pass, particle pass and planes; velocity
// update.
#include "sim/solvers/jacobi.hpp"

#include "kernels.hpp"
#include "sim/constraints/bend.hpp"
#include "sim/constraints/correction_slots.hpp"
#include "sim/constraints/distance.hpp"
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

void addPasses(Build& build) {
    ProgramBuilder& program = build.program;
    const Scene& scene = build.model.scene;
    const Settings& settings = build.model.settings;
    const ParticleBuffers& particles = build.particles;
    const Corrections corrections = addCorrections(program, build.model);
    const rigid::planes::Contacts contacts = rigid::planes::addContacts(program, scene);
    build.add(&Feature::open);
    const std::uint32_t iterations = corrections.slotCount > 0 ? settings.iterations : 1;
    for (std::uint32_t index = 0; index < settings.substeps; ++index) {
        program.beginSubstep();
        const Substep substep{.particles = particles, .index = index, .kick = Kick::half};
        rigid::planes::addOpen(program, particles, contacts);
        build.add(&Feature::substepBegin, substep);
        program.dispatch(kernels::predict, particles.count,
                         {particles.positions, particles.velocities, particles.step},
                         layout::CountPush{particles.count}, remainderConstants(particles.layout));
        for (std::uint32_t iteration = 0; iteration < iterations; ++iteration) {
            addIteration(program, particles, corrections, iteration == 0);
            rigid::planes::addSolve(program, particles, contacts);
        }
        build.add(&Feature::afterContacts, substep);
        build.add(&Feature::substepEnd, substep);
        if (scene.damping > 0 || !scene.planes.empty())
            rigid::planes::addVelocityUpdate(program, particles, contacts);
    }
    program.endSubsteps();
    if (corrections.slotCount > 0) program.program().sweeps = std::uint64_t{settings.substeps} * iterations;
}

} // namespace

SolverPlan plan(const SceneModel& model) {
    return {model.inverseMass, {}, addPasses};
}

} // namespace sinew::sim::solvers::jacobi
