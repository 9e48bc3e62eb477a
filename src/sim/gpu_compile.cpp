// Compiles twice where the first program asks for too much.
#include "sim/gpu_compile.hpp"

#include <algorithm>

namespace sinew::sim {

namespace {

std::uint64_t mostTexels(const StepProgram& program) {
    std::uint64_t most = 0;
    for (const Pass& pass : program.step)
        for (std::size_t b = 0; pass.kind == PassKind::dispatch && b < boundUses(pass).size(); ++b)
            if (program.kernels[pass.kernel].interface.bindings[b].kind == vk::BlockKind::texels)
                most = std::max(most, program.buffers[pass.uses[b].buffer.index].count);
    return most;
}

} // namespace

StepProgram compileFor(const vk::Device& device, const Scene& scene, Settings settings) {
    std::uint32_t& residentBytes = settings.forms.residentBytes;
    residentBytes = std::min(residentBytes, device.limits().maxSharedMemory);
    StepProgram program = compile(scene, settings);
    if (mostTexels(program) <= device.limits().maxTexels) return program;
    settings.forms.usesTexels = false;
    return compile(scene, settings);
}

} // namespace sinew::sim
