// Coordinate search over the forms; a few trials only, because each creates pipelines.
#include "sinew/gpu_tune.hpp"

#include "sim/compile/compile.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sim/model/grids.hpp"
#include "sim/solvers/batches.hpp"
#include "sim/solvers/split.hpp"
#include "sinew/ranges.hpp"
#include "sinew/substeps.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/timestamps.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace sinew::sim {

namespace {

constexpr std::uint64_t trialSteps = 4;

// Warm-up steps before the measured ones: the first step may compile, and an idle GPU needs time to reach its
// full clock.
constexpr std::uint64_t firstSteps = 1, wakingSteps = 32;

double shortestStep(const vk::Device& device, const Scene& scene, const Settings& settings,
                    const TimedSubmit& submit, std::uint64_t stepsBefore) {
    Simulation simulation(device, scene, settings);
    submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint64_t frame = 0; frame < stepsBefore + trialSteps; ++frame) {
        const double ms = submit(
            [&](VkCommandBuffer commands) { simulation.record(commands, {.dt = scene.dt, .frame = frame}); });
        if (frame >= stepsBefore) shortest = std::min(shortest, ms);
    }
    return shortest;
}

bool isGrantable(const vk::Device& device, const Scene& scene, const Settings& settings,
                 std::span<const std::uint32_t> grids) {
    if (solvers::split::contactsFollow(scene, settings)) return false;
    Settings resident = settings;
    resident.forms.residentBytes = device.limits().maxSharedMemory;
    return solvers::isResident(scene, resident, grids);
}

/// Whether usesTexels changes the kernels of a step, which are what is timed: with resident bodies of one
/// node an invocation, and with `jacobi`, there is no choice.
bool hasTexelForms(const Scene& scene, Settings settings) {
    settings.substeps = 1;
    settings.forms.usesTexels = true;
    const StepProgram program = compile(scene, settings);
    return std::ranges::any_of(program[List::step], [&](const Pass& pass) {
        if (pass.kind != PassKind::dispatch || pass.isOfCut()) return false;
        const auto& bindings = program.kernels[pass.kernel].interface.bindings;
        return std::ranges::any_of(bindings, &vk::KernelBinding::isTwin);
    });
}

using Change = std::function<void(Forms&)>;

/// Changes to other marches, starting from the form that suits the device.
std::vector<Change> marches(const Scene& scene, std::span<const std::uint32_t> grids, DeviceKind kind) {
    std::vector<Change> result;
    if (kind == DeviceKind::gpu) {
        for (const auto& [columns, chunk] : {std::pair{1u, 1u}, {1u, 4u}}) // longer marches never won
            result.push_back([columns, chunk](Forms& forms) {
                forms.columns = columns;
                forms.chunk = chunk;
            });
        return result;
    }
    result.push_back([](Forms& forms) { forms.chunk /= 2; });
    result.push_back([](Forms& forms) { forms.chunk *= 2; });
    const bool hasLattice =
        std::ranges::any_of(grids, [&](std::uint32_t g) { return !lattice::isSheet(scene.grids[g]); });
    if (hasLattice) result.push_back([](Forms& forms) { forms.columns = 3 - forms.columns; });
    return result;
}

/// The changes of forms to try for this scene on this device.
std::vector<Change> changes(const vk::Device& device, const Scene& scene, const Settings& settings,
                            DeviceKind kind) {
    std::vector<Change> result;
    if (hasTexelForms(scene, settings))
        result.push_back([](Forms& forms) { forms.usesTexels = !forms.usesTexels; });
    if (settings.solver != Solver::split || scene.distances.empty()) return result;
    const std::vector<std::uint32_t> grids = computedGrids(scene, settings);
    if (!grids.empty()) std::ranges::move(marches(scene, grids, kind), std::back_inserter(result));
    if (isGrantable(device, scene, settings, grids))
        result.push_back([most = device.limits().maxSharedMemory, kind](Forms& forms) {
            forms.residentBytes = most;
            if (kind == DeviceKind::gpu) forms.columns = forms.chunk = 1; // the form for a whole group
        });
    return result;
}

} // namespace

Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings,
            const TimedSubmit& submit) {
    return tune(device, scene, settings, submit, kindOf(device));
}

Tuning tune(const vk::Device& device, const Scene& scene, const Settings& settings, const TimedSubmit& submit,
            DeviceKind kind) {
    constexpr std::uint32_t trialSubsteps = 8;
    constexpr double gain = 0.97;
    const vk::KeptKernels kept(device); // the trials share most kernels
    Settings trial = withSubsteps(scene, settings);
    trial.substeps = std::min(trial.substeps, trialSubsteps);
    trial.forms = completed(settings.forms, kind);
    Tuning tuning{.fastest = trial.forms};
    double best = std::numeric_limits<double>::infinity();
    const auto attempt = [&](const Forms& forms, std::uint64_t stepsBefore) {
        trial.forms = forms;
        tuning.trials.push_back({forms, shortestStep(device, scene, trial, submit, stepsBefore)});
        if (tuning.trials.back().ms >= gain * best) return;
        best = tuning.trials.back().ms;
        tuning.fastest = forms;
    };
    const auto isNew = [&](const Forms& forms) {
        return std::ranges::find(tuning.trials, forms, &Trial::forms) == tuning.trials.end();
    };
    const auto candidates = changes(device, scene, trial, kind);
    if (candidates.empty()) return tuning;
    attempt(trial.forms, kind == DeviceKind::gpu ? wakingSteps : firstSteps);
    for (const Change& change : candidates) {
        Forms forms = tuning.fastest;
        change(forms);
        if (forms.chunk > 0 && ranges::chunk.holds(forms.chunk) && isNew(forms)) attempt(forms, firstSteps);
    }
    return tuning;
}

double timed(const vk::Device& device, VkCommandBuffer commands,
             const std::function<void(VkCommandBuffer)>& record, const std::function<void()>& submitAndWait) {
    using Clock = std::chrono::steady_clock;
    vk::Timestamps timestamps(device, kindOf(device) == DeviceKind::gpu ? 1 : 0);
    vk::Commands recorder(device, commands);
    timestamps.reset(recorder);
    timestamps.begin(recorder, 0);
    record(commands);
    timestamps.end(recorder, 0);
    const Clock::time_point start = Clock::now();
    submitAndWait();
    const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
    const std::vector<double> ofDevice = timestamps.milliseconds();
    return ofDevice.empty() ? taken.count() : ofDevice.front();
}

} // namespace sinew::sim
