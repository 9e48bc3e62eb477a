// Compilation for a device: compiles again if the first program exceeds the device's limits.
#include "sim/device/gpu_compile.hpp"
#include "sim/compile/compile.hpp"

#include <algorithm>

namespace sinew::sim {

namespace {

std::uint64_t mostTexels(const StepProgram& program) {
    std::uint64_t most = 0;
    forEachPass(program, [&](const Pass& pass) {
        if (pass.kind != PassKind::dispatch) return;
        const std::vector<BufferId> buffers = boundBuffers(program, pass);
        for (std::size_t b = 0; b < buffers.size(); ++b) {
            if (program.kernels[pass.kernel].interface.bindings[b].kind != vk::BlockKind::texels) continue;
            if (buffers[b] == unbound) continue;
            const BufferSpec& spec = program.buffers[buffers[b].index];
            most = std::max(most, vk::KernelBinding::texelsIn(spec.bytes(), spec.stride));
        }
    });
    return most;
}

/// Makes one phase for each pass label of the step, in the order of first appearance.
void makePhasesOfPasses(StepProgram& program) {
    program.phases.clear();
    for (Pass& pass : program[List::step]) {
        const auto phase = std::ranges::find(program.phases, pass.label);
        pass.phase = static_cast<std::uint32_t>(phase - program.phases.begin());
        if (phase == program.phases.end()) program.phases.push_back(pass.label);
    }
}

std::uint32_t largestGroup(const StepProgram& program) {
    std::uint32_t largest = 0;
    for (const KernelUse& use : program.kernels) largest = std::max(largest, use.interface.groupSize[0]);
    return largest;
}

} // namespace

DeviceKind kindOf(const vk::Device& device) {
    return device.description().type == "software" ? DeviceKind::software : DeviceKind::gpu;
}

StepProgram compileFor(const vk::Device& device, const Scene& scene, Settings settings) {
    settings.forms = completed(settings.forms, kindOf(device));
    std::uint32_t& residentBytes = settings.forms.residentBytes;
    residentBytes = std::min(residentBytes, device.limits().maxSharedMemory);
    StepProgram program = compile(scene, settings);
    if (residentBytes > 0 && largestGroup(program) > device.limits().maxGroupInvocations) {
        residentBytes = 0;
        program = compile(scene, settings);
    }
    if (mostTexels(program) > device.limits().maxTexels) {
        settings.forms.usesTexels = false;
        program = compile(scene, settings);
    }
    if (settings.timesPasses) makePhasesOfPasses(program);
    return program;
}

} // namespace sinew::sim
