// The end of a step: its check, the public state, and the saved copies. A particle finds its slot in order,
// by rule, or in a table of 4 bytes each.
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
        program.addToState(buffer, saved, {.of = Elements::slots});
        program.addToState(saved, saved, {.of = Elements::slots});
    }
}

constexpr std::uint32_t slotRuleId = 1,
                        publishesVelocitiesId = 2; // constant_ids in slots.glsl, publish_state.comp

// The way in which the kernels find the slot of a particle.
struct SlotRule {
    ProgramBuilder::Constants constants;
    BufferId table;
    layout::BoxesPush push;
};

SlotRule slotRuleOf(ProgramBuilder& program, const ParticleBuffers& particles) {
    constexpr std::uint32_t inOrder = 0, inBoxes = 1, inTable = 2; // see slots.glsl
    const StateLayout& layout = particles.layout;
    layout::BoxesPush push{.count = particles.count};
    if (layout.isInOrder) return {{{slotRuleId, inOrder}}, unbound, push};
    if (!layout.boxes) return {{{slotRuleId, inTable}}, program.upload("state.slots", layout.slot), push};
    const EqualBoxes& boxes = *layout.boxes;
    return {{{slotRuleId, inBoxes}},
            unbound,
            {particles.count, boxes.particles, boxes.nodesX, boxes.nodesY, boxes.origin, boxes.rowStride,
             boxes.sliceStride, boxes.boxStride}};
}

// Initialises the saved copies from the adopted state.
void addInitialising(ProgramBuilder& program, const ParticleBuffers& particles, const SlotRule& rule) {
    const StepProgram& built = program.program();
    ProgramBuilder::Constants constants = remainderConstants(particles.layout);
    constants.merge(ProgramBuilder::Constants(rule.constants));
    program.into(List::initialise, [&] {
        program.dispatch(
            k::initialiseState, particles.count,
            {particles.positions, particles.velocities, built.positions, built.velocities, rule.table},
            rule.push, constants);
        for (const StateBuffer& stateBuffer : built.stateBuffers)
            for (const BufferId state : {particles.positions, particles.velocities})
                if (stateBuffer.to == state && stateBuffer.from != state)
                    program.copy(state, stateBuffer.from);
    });
}

void addState(Build& build) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    const StepProgram& built = program.program();
    const SlotRule rule = slotRuleOf(program, particles);
    program.dispatch(k::measureState, particles.count,
                     {particles.positions, particles.velocities, built.status, particles.step, rule.table},
                     rule.push, rule.constants);
    build.add(&Feature::check);
    addKept(program);
    const bool hasVelocities = built.velocities != BufferId{};
    ProgramBuilder::Constants constants = remainderConstants(particles.layout);
    constants.merge(ProgramBuilder::Constants(rule.constants));
    constants[publishesVelocitiesId] = hasVelocities;
    program.dispatch(k::publishState, particles.count,
                     {particles.positions, particles.velocities, built.status, particles.step,
                      built.positions, boundIf(hasVelocities, built.velocities), rule.table},
                     rule.push, constants);
    if (hasVelocities) addInitialising(program, particles, rule);
}

} // namespace

void addPublishing(Build& build) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    addState(build);
    if (program.keptForRepeat().empty())
        for (const BufferId buffer : {particles.positions, particles.velocities})
            program.addToState(buffer, buffer, {.of = Elements::slots});
    for (const BufferId memory : program.restoredOnUndo()) {
        const BufferId saved = addMemory(program, memory);
        program.addToState(memory, saved);
        program.addToState(saved, saved);
    }
}

} // namespace sinew::sim
