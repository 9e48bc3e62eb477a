// Compiles twice where the first program asks for too much.
#include "sim/gpu_compile.hpp"

#include <algorithm>

namespace sinew::sim {

namespace {

std::uint64_t mostTexels(const StepProgram& program) {
    std::uint64_t most = 0;
    for (const std::vector<Pass>* list :
         {&program.step, &program.skin, &program.wholeSkin, &program.mixedSkin})
        for (const Pass& pass : *list)
            for (std::size_t b = 0; pass.kind == PassKind::dispatch && b < boundUses(pass).size(); ++b) {
                const BufferSpec& spec = program.buffers[pass.uses[b].buffer.index];
                if (program.kernels[pass.kernel].interface.bindings[b].kind == vk::BlockKind::texels)
                    most = std::max(most, vk::KernelBinding::texelsIn(spec.bytes(), spec.stride));
            }
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
