// Order of the phases of `gauss_seidel`: open, sweeps, close. The close of a substep and the open of the next
// are one pass unless internal damping comes between them. A substep of one sweep is one dispatch a color and
// one more.
#include "sim/solvers/gauss_seidel.hpp"

#include "kernels.hpp"
#include "sim/constraints/bend.hpp"
#include "sim/constraints/distance.hpp"
#include "sim/forces/forces.hpp"
#include "sim/rigid/colliders.hpp"
#include "sim/rigid/planes.hpp"

namespace sinew::sim::solvers::gaussSeidel {

namespace {

// A pass between sweeps.
struct Between {
    bool closes, opens; // the substep before it, that after it
};
constexpr Between open{false, true}, advance{true, true}, close{true, false};

// The buffers that the passes of a step use.
struct Work {
    const ParticleBuffers& particles;
    constraints::distance::ColoredEdges edges;
    constraints::bend::ColoredBends bends;
    rigid::planes::Planes planes;
    BufferId corrections;
    bool hasColliders = false; // other than planes, which then come before them
};

constexpr std::uint32_t opensId = 3, closesId = 4; // constant_ids in advance_substep.comp
constexpr std::uint32_t hasCollidersId = 11;       // constant_id in close_substep.glsl

void addBetween(ProgramBuilder& program, const Work& work, Between between, bool isFirst) {
    const ParticleBuffers& particles = work.particles;
    const bool isWarm = between.opens && work.edges.degree > 0;
    std::vector<BufferId> buffers{particles.positions,
                                  particles.velocities,
                                  work.corrections,
                                  particles.step,
                                  boundIf(isWarm, work.edges.links),
                                  boundIf(isWarm, work.edges.multipliers)};
    ProgramBuilder::Constants constants = remainderConstants(particles.layout);
    constants.insert({{opensId, between.opens}, {closesId, between.closes}});
    if (isWarm) constants.merge(work.edges.constants());
    const bool meetsPlanes = between.closes && work.planes.count > 0;
    buffers.insert(buffers.end(), {boundIf(meetsPlanes, work.planes.planes),
                                   boundIf(meetsPlanes, work.planes.contactOffsets)});
    if (meetsPlanes) {
        constants.merge(work.planes.constants());
        constants[hasCollidersId] = work.hasColliders;
    }
    forces::bindTo(particles, &forces::Forces::ofPlanes, buffers, constants);
    program.dispatch(kernels::advanceSubstep, particles.count, buffers,
                     layout::SubstepPush{particles.count, isFirst}, constants);
}

// Sweeps of a substep. Without constraints there is nothing to repeat.
std::uint32_t sweepsOf(const Work& work, const Settings& settings) {
    return work.edges.colors.empty() && work.bends.colors.empty() ? 1 : settings.iterations;
}

void addSweeps(ProgramBuilder& program, const Work& work, const Settings& settings, bool isFirst) {
    const std::uint32_t iterations = sweepsOf(work, settings);
    for (std::uint32_t iteration = 0; iteration < iterations; ++iteration) {
        const bool isLast = iteration + 1 == iterations;
        constraints::distance::addSweep(program, work.particles, work.edges, work.corrections,
                                        settings.warmStart,
                                        {.isOpening = isFirst && iteration == 0, .isClosing = isLast});
        constraints::bend::addSweep(program, work.particles, work.bends, work.corrections, iteration == 0);
        if (!isLast) rigid::planes::addTouch(program, work.particles, work.corrections, work.planes);
    }
}

void addPasses(Build& build) {
    ProgramBuilder& program = build.program;
    const Scene& scene = build.model.scene;
    const Settings& settings = build.model.settings;
    const ParticleBuffers& particles = build.particles;
    Work work{.particles = particles,
              .edges = constraints::distance::uploadColors(program, build.model),
              .bends = constraints::bend::uploadColors(program, build.model),
              .planes = rigid::planes::add(program, scene, particles.layout),
              .corrections =
                  program.scratch<layout::ParticleCorrection>("state.displacements", particles.layout.count)};
    build.add(&Feature::open);
    const auto* colliders = build.find<rigid::colliders::Colliders>();
    work.hasColliders = colliders && colliders->count > 0;
    const bool isDamped = scene.dampingTime > 0 && !work.edges.colors.empty();
    for (std::uint32_t index = 0; index < settings.substeps; ++index) {
        const bool isFirst = index == 0;
        const Substep substep{
            .particles = particles, .index = index, .kick = Kick::half, .corrections = work.corrections};
        program.beginSubstep();
        addBetween(program, work, isFirst || isDamped ? open : advance, isFirst);
        addSweeps(program, work, settings, isFirst);
        build.add(&Feature::afterContacts, substep);
        if (work.hasColliders) rigid::planes::addTouch(program, particles, work.corrections, work.planes);
        build.add(&Feature::substepEnd, substep);
        if (!isDamped) continue;
        addBetween(program, work, close, false);
        constraints::distance::addDamping(program, particles, work.edges, scene.dampingTime);
    }
    if (!isDamped) addBetween(program, work, close, false);
    program.endSubsteps();
    if (!work.edges.colors.empty() || !work.bends.colors.empty())
        program.program().sweeps = std::uint64_t{settings.substeps} * settings.iterations;
}

} // namespace

SolverPlan plan(const SceneModel& model) {
    return {model.inverseMass, {}, addPasses};
}

} // namespace sinew::sim::solvers::gaussSeidel
