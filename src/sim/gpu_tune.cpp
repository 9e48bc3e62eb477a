// Coordinate search over the forms: few, because each costs its pipelines.
#include "sim/gpu_tune.hpp"

#include "sim/compile.hpp"
#include "sim/lattice/batches.hpp"
#include "sim/ranges.hpp"
#include "sim/substeps.hpp"
#include "vk/kernel_store.hpp"

#include <algorithm>
#include <limits>

namespace sinew::sim {

namespace {

constexpr int trialSteps = 4;

double shortestStep(const vk::Device& device, const Scene& scene, const Settings& settings,
                    const TimedSubmit& submit) {
    Simulation simulation(device, scene, settings);
    submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint64_t frame = 0; frame <= trialSteps; ++frame) {
        const double ms = submit(
            [&](VkCommandBuffer commands) { simulation.record(commands, {.dt = scene.dt, .frame = frame}); });
        if (frame > 0) shortest = std::min(shortest, ms); // the first may compile
    }
    return shortest;
}

bool isGrantable(const vk::Device& device, const Scene& scene, const Settings& settings,
                 std::span<const std::uint32_t> grids) {
    Settings resident = settings;
    resident.forms.residentBytes = device.limits().maxSharedMemory;
    return lattice::isResident(scene, resident, grids);
}

std::vector<const vk::ShaderCode*> codesOfStep(const Scene& scene, const Settings& settings) {
    const StepProgram program = compile(scene, settings);
    std::vector<const vk::ShaderCode*> codes;
    for (const Pass& pass : program.step)
        if (pass.kind == PassKind::dispatch && !pass.isOfCut)
            codes.push_back(program.kernels[pass.kernel].code);
    return codes;
}

/// Whether texels make other kernels of a step, which is what is timed: with bends, damping or resident
/// bodies `split` has one code for both, `jacobi` has no choice at all.
bool hasTexelForms(const Scene& scene, Settings settings) {
    settings.substeps = 1;
    const auto given = codesOfStep(scene, settings);
    settings.forms.usesTexels = !settings.forms.usesTexels;
    return given != codesOfStep(scene, settings);
}

/// What may be changed about the forms of this scene on this device.
std::vector<std::function<void(Forms&)>> changes(const vk::Device& device, const Scene& scene,
                                                 const Settings& settings) {
    std::vector<std::function<void(Forms&)>> result;
    if (hasTexelForms(scene, settings))
        result.push_back([](Forms& forms) { forms.usesTexels = !forms.usesTexels; });
    if (settings.solver != Solver::split || scene.distances.empty()) return result;
    const std::vector<std::uint32_t> grids = lattice::computedGrids(scene, settings);
    if (!grids.empty()) {
        result.push_back([](Forms& forms) { forms.chunk /= 2; });
        result.push_back([](Forms& forms) { forms.chunk *= 2; });
        const bool hasLattice =
            std::ranges::any_of(grids, [&](std::uint32_t g) { return !lattice::isSheet(scene.grids[g]); });
        if (hasLattice) result.push_back([](Forms& forms) { forms.columns = 3 - forms.columns; });
    }
    if (isGrantable(device, scene, settings, grids))
        result.push_back(
            [most = device.limits().maxSharedMemory](Forms& forms) { forms.residentBytes = most; });
    return result;
}

} // namespace

Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings,
            const TimedSubmit& submit) {
    constexpr std::uint32_t trialSubsteps = 8;
    constexpr double gain = 0.97;
    const vk::KeptKernels kept(device); // forms share most of them
    Tuning tuning{.fastest = settings.forms};
    Settings trial = withSubsteps(scene, settings);
    trial.substeps = std::min(trial.substeps, trialSubsteps);
    double best = std::numeric_limits<double>::infinity();
    const auto attempt = [&](const Forms& forms) {
        trial.forms = forms;
        tuning.trials.push_back({forms, shortestStep(device, scene, trial, submit)});
        if (tuning.trials.back().ms >= gain * best) return;
        best = tuning.trials.back().ms;
        tuning.fastest = forms;
    };
    const auto candidates = changes(device, scene, settings);
    if (candidates.empty()) return tuning;
    attempt(settings.forms);
    for (const auto& change : candidates) {
        Forms forms = tuning.fastest;
        change(forms);
        if (ranges::chunk.holds(forms.chunk)) attempt(forms);
    }
    return tuning;
}

} // namespace sinew::sim
