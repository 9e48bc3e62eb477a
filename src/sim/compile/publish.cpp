// Publishing kernels differ in how a particle finds its slot: in order, by rule, or from a table of 4 bytes
// each.
#include "sim/compile/publish.hpp"

#include "common/layout.h"
#include "kernels.hpp"

#include <cstring>

namespace sinew::sim {

namespace {

namespace k = kernels;

// Adds the pass that saves a buffer or restores it; returns the saved copy, which starts with the initial
// contents.
BufferId addMemory(ProgramBuilder& program, BufferId memory) {
    const BufferSpec spec = program.program().buffers[memory.index]; // copied: adding a buffer moves the list
    const auto count = static_cast<std::uint32_t>(spec.count);
    std::vector<layout::vec4> initial(spec.initial.size() / sizeof(layout::vec4));
    if (!initial.empty()) std::memcpy(initial.data(), spec.initial.data(), spec.initial.size());
    const std::string label = spec.label + ".saved";
    const BufferId saved =
        initial.empty() ? program.scratch<layout::vec4>(label, count) : program.upload(label, initial);
    program.dispatch(k::publishMemory, count, {memory, saved, program.program().status},
                     layout::CountPush{count});
    return saved;
}

// Runs after the check, and before publishing, which uses the values that this restores.
void addKept(ProgramBuilder& program) {
    for (const BufferId buffer : program.keptForRepeat()) {
        const BufferId saved = addMemory(program, buffer);
        program.addToState(buffer, saved);
        program.addToState(saved, saved);
    }
}

// The kernels for one way of finding a slot.
struct Kernels {
    const vk::ShaderCode &measure, &publish, &publishPositions, &take;
};

// Initialises the saved copies from the adopted state.
template <typename Push>
void addInitialising(ProgramBuilder& program, const ParticleBuffers& particles, const vk::ShaderCode& take,
                     std::span<const BufferId> slots, const Push& push) {
    const StepProgram& built = program.program();
    std::vector<BufferId> buffers{particles.positions, particles.velocities, built.positions,
                                  built.velocities};
    buffers.insert(buffers.end(), slots.begin(), slots.end());
    program.beginInitialising();
    program.dispatch(take, particles.count, buffers, push, remainderConstants(particles.layout));
    for (const StateBuffer& stateBuffer : std::vector(built.stateBuffers))
        for (const BufferId state : {particles.positions, particles.velocities})
            if (stateBuffer.to == state && stateBuffer.from != state) program.copy(state, stateBuffer.from);
    program.endInitialising();
}

template <typename Push>
void addKernels(ProgramBuilder& program, const ParticleBuffers& particles, const Kernels& kernels,
                std::span<const BufferId> slots, const Push& push) {
    const StepProgram& built = program.program();
    std::vector<BufferId> buffers{particles.positions, particles.velocities, built.status, particles.step};
    const bool hasVelocities = built.velocities != BufferId{};
    std::vector<BufferId> published = buffers;
    published.push_back(built.positions);
    if (hasVelocities) published.push_back(built.velocities);
    buffers.insert(buffers.end(), slots.begin(), slots.end());
    published.insert(published.end(), slots.begin(), slots.end());
    program.dispatch(kernels.measure, particles.count, buffers, push);
    for (const auto& addChecked : program.checked()) addChecked();
    addKept(program);
    program.dispatch(hasVelocities ? kernels.publish : kernels.publishPositions, particles.count, published,
                     push, remainderConstants(particles.layout));
    if (hasVelocities) addInitialising(program, particles, kernels.take, slots, push);
}

void addState(ProgramBuilder& program, const ParticleBuffers& particles) {
    const StateLayout& layout = particles.layout;
    if (layout.isInOrder) {
        addKernels(program, particles,
                   {k::measureState, k::publishState, k::publishPositions, k::initialiseState}, {},
                   layout::CountPush{particles.count});
    } else if (layout.boxes) {
        const EqualBoxes& boxes = *layout.boxes;
        const layout::BoxesPush push{particles.count, boxes.particles, boxes.nodesX,      boxes.nodesY,
                                     boxes.origin,    boxes.rowStride, boxes.sliceStride, boxes.boxStride};
        addKernels(
            program, particles,
            {k::measureStateBoxes, k::publishStateBoxes, k::publishPositionsBoxes, k::initialiseStateBoxes},
            {}, push);
    } else {
        const BufferId slots = program.upload("state.slots", layout.slot);
        addKernels(
            program, particles,
            {k::measureStateSlots, k::publishStateSlots, k::publishPositionsSlots, k::initialiseStateSlots},
            std::span(&slots, 1), layout::CountPush{particles.count});
    }
}

} // namespace

void addPublishing(ProgramBuilder& program, const ParticleBuffers& particles) {
    addState(program, particles);
    if (program.keptForRepeat().empty())
        for (const BufferId buffer : {particles.positions, particles.velocities})
            program.addToState(buffer, buffer);
    for (const BufferId memory : program.restoredOnUndo()) {
        const BufferId saved = addMemory(program, memory);
        program.addToState(memory, saved);
        program.addToState(saved, saved);
    }
    for (const auto& addEnding : program.endings()) addEnding();
}

} // namespace sinew::sim
