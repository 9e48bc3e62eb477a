// A step writes its public state and surfaces in place, since the next step reads them. The ring copies them
// at its end, into the buffers of a slot in turn.
#include "sim/simulation/output_ring.hpp"

#include "sim/program/program_values.hpp"

namespace sinew::sim {

namespace {

constexpr VkBufferUsageFlags drawn = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                                     VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;

} // namespace

OutputRing::OutputRing(const vk::Device& device, const StepProgram& program, const GpuExecutor& executor,
                       const Settings& settings)
    : program_(program), executor_(executor), slots_(settings.outputFrames) {
    if (slots_.empty()) return;
    const OutputUse use = outputUseOf(device, settings);
    const std::vector<bool> isWritten = areWritten(program);
    const auto keep = [&](BufferId buffer, By by) {
        if (buffer != BufferId{} && isWritten[buffer.index]) kept_.push_back({buffer, by});
    };
    keep(program.positions, By::step);
    keep(program.velocities, By::step);
    const CutSurfaceBuffers& cut = program.cutSurface;
    for (const BufferId buffer :
         {program.skinVertices, program.skinIndices, program.pieceDraws, cut.vertices, cut.rest, cut.indices,
          cut.draws, cut.state, cut.particles, program.textureCoordinates, cut.textureCoordinates})
        keep(buffer, By::skin);
    for (Slot& slot : slots_)
        for (const Kept& one : kept_) {
            const BufferSpec& spec = program.buffers[one.buffer.index];
            slot.copies.emplace_back(device,
                                     vk::BufferRequest{.name = spec.label + ".output",
                                                       .count = executor.view(one.buffer).size / spec.stride,
                                                       .stride = spec.stride,
                                                       .usage = drawn | use.usage,
                                                       .families = use.families});
        }
}

void OutputRing::record(vk::Commands& commands, const Slot& slot, By by) const noexcept {
    for (std::size_t k = 0; k < kept_.size(); ++k)
        if (kept_[k].by == by) commands.copy(executor_.view(kept_[k].buffer), slot.copies[k].view());
}

void OutputRing::recordStep(vk::Commands& commands, std::uint64_t frame) noexcept {
    if (slots_.empty()) return;
    Slot& slot = slots_[frame % slots_.size()];
    slot.frame = newest_ = frame;
    slot.hasSkin = false;
    record(commands, slot, By::step);
}

void OutputRing::recordSkin(vk::Commands& commands) noexcept {
    if (!newest_) return;
    Slot& slot = slots_[*newest_ % slots_.size()];
    slot.hasSkin = true;
    record(commands, slot, By::skin);
}

void OutputRing::forget() noexcept {
    for (Slot& slot : slots_) slot.frame.reset();
    newest_.reset();
}

Outputs OutputRing::outputs(std::uint64_t frame) const noexcept {
    if (slots_.empty()) return {};
    const Slot& slot = slots_[frame % slots_.size()];
    if (slot.frame != frame) return {};
    const auto of = [&](BufferId buffer) {
        for (std::size_t k = 0; k < kept_.size(); ++k)
            if (kept_[k].buffer == buffer) return slot.copies[k].view();
        return executor_.view(buffer);
    };
    Outputs outputs{
        .isKept = true, .positions = of(program_.positions), .velocities = of(program_.velocities)};
    if (!slot.hasSkin) return outputs;
    const CutSurfaceBuffers& cut = program_.cutSurface;
    outputs.skinVertices = of(program_.skinVertices);
    outputs.skinIndices = of(program_.skinIndices);
    outputs.pieceDraws = of(program_.pieceDraws);
    outputs.textureCoordinates = of(program_.textureCoordinates);
    outputs.cutSurface = {of(cut.vertices), of(cut.rest),      of(cut.indices),           of(cut.draws),
                          of(cut.state),    of(cut.particles), of(cut.textureCoordinates)};
    return outputs;
}

} // namespace sinew::sim
