// The stages of a step, from top to bottom in the order in which the device runs them.
#include "sim/compile/compile.hpp"

#include "common/layout.h"
#include "kernels.hpp"
#include "sim/compile/features.hpp"
#include "sim/compile/publish.hpp"
#include "sim/core/hash.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/model/links.hpp"
#include "sim/motions/pool.hpp"
#include "sim/solvers/gauss_seidel.hpp"
#include "sim/solvers/jacobi.hpp"
#include "sim/solvers/solver_plan.hpp"
#include "sim/solvers/split.hpp"
#include "sim/surface/skin.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

namespace sinew::sim {

namespace {

solvers::SolverPlan planOf(const SceneModel& model) {
    switch (model.settings.solver) {
    case Solver::split:
        return solvers::split::plan(model);
    case Solver::gaussSeidel:
        return solvers::gaussSeidel::plan(model);
    case Solver::jacobi:
        break;
    }
    return solvers::jacobi::plan(model);
}

std::vector<layout::vec4> positionsOf(const std::vector<Vec3>& positions, const std::vector<float>& w) {
    std::vector<layout::vec4> result;
    result.reserve(w.size());
    for (std::size_t i = 0; i < w.size(); ++i)
        result.push_back({positions[i].x, positions[i].y, positions[i].z, w[i]});
    return result;
}

std::vector<layout::vec4> velocitiesOf(const Scene& scene, const std::vector<float>& w) {
    std::vector<layout::vec4> result;
    result.reserve(w.size());
    for (std::size_t i = 0; i < w.size(); ++i) {
        const Vec3 v = w[i] > 0 ? scene.particles[i].velocity : Vec3{}; // static particles have no velocity
        result.push_back({v.x, v.y, v.z, w[i]});
    }
    return result;
}

template <typename Value>
std::vector<Value> spread(const std::vector<Value>& values, const StateLayout& layout, std::size_t count) {
    std::vector<Value> result(count);
    for (std::size_t i = 0; i < values.size(); ++i) result[layout.slot[i]] = values[i];
    return result;
}

// Adds the solver's state.
ParticleBuffers addParticles(ProgramBuilder& program, const SceneModel& model,
                             const solvers::SolverPlan& solver, const std::vector<Vec3>& start) {
    const StateLayout& layout = model.layout;
    return {.count = program.program().particleCount,
            .step = program.program().parameters,
            .positions = program.upload("state.positions", spread(positionsOf(start, solver.positionW),
                                                                  layout, positionCount(layout))),
            .mostW = solver.mostW.empty()
                         ? unbound
                         : program.upload("state.most_w", spread(solver.mostW, layout, layout.count)),
            .velocities = program.upload(
                "state.velocities",
                spread(velocitiesOf(model.scene, motions::withAbsent(model.scene, model.inverseMass)), layout,
                       layout.count)),
            .layout = layout,
            .sleep = nullptr,
            .grabs = nullptr,
            .forces = nullptr,
            .events = nullptr};
}

// Settling resets the w of positions, which a solver may derive from the material, to the initial values, or
// to at most `mostW` where the state itself moves it: in the state and in its saved copy.
void addWeights(ProgramBuilder& program, const ParticleBuffers& particles) {
    const auto count = static_cast<std::uint32_t>(particles.layout.count);
    const bool isMoved = particles.mostW != unbound;
    const BufferId initial =
        isMoved ? particles.mostW : program.initialOf("state.initial", particles.positions);
    const vk::ShaderCode& kernel = isMoved ? kernels::limitWeights : kernels::setWeights;
    std::vector<BufferId> targets{particles.positions};
    for (const StateBuffer& stateBuffer : program.program().stateBuffers)
        if (stateBuffer.to == particles.positions && stateBuffer.from != particles.positions)
            targets.push_back(stateBuffer.from);
    program.into(List::refresh, [&] {
        for (const BufferId target : targets)
            program.dispatch(kernel, count, {target, initial}, layout::CountPush{count});
    });
}

void skipContacts(ProgramBuilder& program, const SceneModel& model) {
    const bool ofParticles = model.particlesTouch(), withFaces = model.facesTouch();
    if (!ofParticles) program.skip(withFaces ? "contacts between particles" : "contacts");
    if (!withFaces && ofParticles) program.skip("contacts with faces");
}

} // namespace

StateLayout stateLayout(const Scene& scene, const Settings& settings) {
    const Settings chosen = withSubsteps(scene, settings);
    return SceneModel(scene, chosen).layout;
}

StepProgram compile(const Scene& scene, const Settings& asked) {
    requireNone(validate(asked));
    Settings settings = withSubsteps(scene, asked);
    settings.forms = completed(settings.forms, DeviceKind::software);
    if (asked.substeps == 0) requireNone(validate(settings)); // the chosen number has a limit too
    ProgramBuilder program(settings.isReversed, settings.forms.usesTexels);
    StepProgram& built = program.program();
    built.particleCount = static_cast<std::uint32_t>(scene.particles.size());
    built.constraintCount =
        static_cast<std::uint32_t>(linkCount(scene) + scene.attachments.size() + scene.tethers.size());
    const SceneModel model(scene, settings);
    const std::vector<float> inverseMass = motions::withAbsent(scene, model.inverseMass);
    const StateLayout& layout = model.layout;
    const std::vector<Vec3> start =
        motions::withAbsent(scene, lattice::startingPositions(scene, model.inverseMass));
    built.positions = program.upload("positions", positionsOf(start, inverseMass));
    if (settings.publishesVelocities)
        built.velocities = program.upload("velocities", velocitiesOf(scene, inverseMass));
    if (settings.keepsPrevious) {
        built.previousPositions = program.scratch<layout::vec4>("positions.previous", scene.particles.size());
        program.addToState(built.previousPositions, built.previousPositions, {.of = Elements::particles});
    }
    built.status = program.scratch<layout::StatusWords>("status", 1);
    built.parameters = program.scratch<layout::StepParams>("step", 1);
    if (scene.particles.empty()) return program.finish();

    const solvers::SolverPlan solver = planOf(model);
    built.order = fnv1a(std::as_bytes(std::span(layout.slot)));
    built.slots = layout.slot;
    built.slotCount = static_cast<std::uint32_t>(layout.count);
    Build build(program, model, features());
    build.particles = addParticles(program, model, solver, start);
    built.statePositions = build.particles.positions;
    built.stateVelocities = build.particles.velocities;
    program.setSlots(compactSlots(layout), built.slotCount);
    build.add(&Feature::buffers);
    program.beginPhase("begin");
    program.updateParameters(built.parameters);
    program.fill(built.status, 0);
    if (settings.keepsPrevious) program.copy(built.positions, built.previousPositions);
    build.add(&Feature::begin);
    build.add(&Feature::cutBuffers);
    build.add(&Feature::move);
    build.add(&Feature::cut); // begins a phase of its own
    program.beginPhase("solve");
    solver.addPasses(build); // Feature::open, then the stages of each substep
    program.beginPhase("publish");
    addPublishing(build); // Feature::check between the check of the state and its copy
    build.add(&Feature::cutEnd);
    build.add(&Feature::end);
    if (solver.positionW != model.inverseMass) addWeights(program, build.particles);
    build.add(&Feature::finish);
    program.into(List::rewrite, [&] { build.add(&Feature::rewrite); });
    surface::addSkins(build); // Feature::skinNormals between positions and normals, Feature::skinEnd

    if (scene.distances.empty()) program.skip("distance constraints");
    if (scene.damping == 0) program.skip("damping");
    if (scene.planes.empty()) program.skip("boundary planes");
    skipContacts(program, model);
    if (!settings.sleeps) program.skip("sleep");
    if (scene.fixed.empty()) program.skip("fixed constraints");
    if (scene.skins.empty()) program.skip("skins");
    return program.finish();
}

} // namespace sinew::sim
