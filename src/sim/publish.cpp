// Chooses the kernels by how a particle finds its slot: in order, by rule, or from a table of 4 bytes each.
#include "sim/publish.hpp"

#include "kernels.hpp"
#include "layout.h"

namespace sinew::sim::publish {

namespace {

namespace k = kernels;

// The kernels for one way to find a slot.
struct Kernels {
    const vk::ShaderCode &measure, &publish, &publishPositions;
};

template <typename Push>
void addPasses(ProgramBuilder& program, const ParticleBuffers& particles, const Kernels& kernels,
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
    program.dispatch(hasVelocities ? kernels.publish : kernels.publishPositions, particles.count, published,
                     push);
}

void addState(ProgramBuilder& program, const ParticleBuffers& particles) {
    const StateLayout& layout = particles.layout;
    if (layout.isInOrder) {
        addPasses(program, particles, {k::measureState, k::publishState, k::publishPositions}, {},
                  layout::CountPush{particles.count});
    } else if (layout.boxes) {
        const EqualBoxes& boxes = *layout.boxes;
        const layout::BoxesPush push{particles.count, boxes.particles, boxes.nodesX,      boxes.nodesY,
                                     boxes.origin,    boxes.rowStride, boxes.sliceStride, boxes.boxStride};
        addPasses(program, particles, {k::measureStateBoxes, k::publishStateBoxes, k::publishPositionsBoxes},
                  {}, push);
    } else {
        const BufferId slots = program.upload("state.slots", layout.slot);
        addPasses(program, particles, {k::measureStateSlots, k::publishStateSlots, k::publishPositionsSlots},
                  std::span(&slots, 1), layout::CountPush{particles.count});
    }
}

} // namespace

void addPasses(ProgramBuilder& program, const ParticleBuffers& particles) {
    addState(program, particles);
    for (const BufferId memory : program.remembered()) {
        const BufferSpec spec = program.program().buffers[memory.index]; // scratch moves the list
        const auto count = static_cast<std::uint32_t>(spec.count);
        const BufferId saved = program.scratch<layout::vec4>(spec.label + ".saved", count);
        program.dispatch(k::publishMemory, count, {memory, saved, program.program().status},
                         layout::CountPush{count});
    }
}

} // namespace sinew::sim::publish
