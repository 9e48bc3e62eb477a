// Buffers of recoils, and their passes.
#include "sim/collision/recoils.hpp"

#include "collision/touched.h"
#include "kernels.hpp"
#include "sim/forces/forces.hpp"

#include <array>
#include <bit>
#include <vector>

namespace sinew::sim::collision::recoils {

namespace {

namespace k = kernels;

constexpr std::uint32_t hasRecoveryId = 4; // constant_id in take_recoils_back.comp
constexpr std::uint32_t leastReachId = 24; // constant_id in recoil_speed.glsl

} // namespace

Recoils add(ProgramBuilder& program, const SceneModel& model, float leastReach) {
    const auto slots = static_cast<std::uint32_t>(model.layout.count);
    const std::uint32_t sections = model.settings.keepsForces ? 4 : 3;
    return {.leastReach = leastReach,
            .received =
                program.scratchOfStep<layout::vec4>("recoils.received", 1 + std::uint64_t{sections} * slots),
            .contacts = program.scratchOfStep<layout::Recoil>("recoils.contacts",
                                                              std::uint64_t{RECOIL_CONTACTS} * slots),
            .members = program.scratchOfStep<std::uint32_t>("recoils.members", 2 * std::uint64_t{slots}),
            .degrees = program.scratchOfStep<std::uint32_t>("recoils.degrees", slots),
            .near = program.scratchOfStep<std::array<std::uint32_t, 2>>("recoils.near", slots),
            .arguments = program.scratchOfStep<layout::DispatchArguments>("recoils.arguments",
                                                                          model.settings.substeps)};
}

ProgramBuilder::Constants constants(const Recoils& recoils, const ParticleBuffers& particles) {
    ProgramBuilder::Constants constants = receivedConstants(particles);
    constants[leastReachId] = std::bit_cast<std::uint32_t>(recoils.leastReach);
    return constants;
}

void addRows(ProgramBuilder& program, const Recoils& recoils, const row_contacts::Rows& rows, BufferId places,
             const ParticleBuffers& predicted, bool isFirst) {
    if (!recoils.exist()) return;
    if (isFirst) program.fill(recoils.received, 0);
    ProgramBuilder::Constants receiving = receivedConstants(predicted);
    std::vector<BufferId> buffers{
        rows.lists.ranges, rows.directions,      rows.weights,        rows.impulses,  rows.lists.contacts,
        rows.shapes,       predicted.velocities, predicted.positions, predicted.step, recoils.received};
    forces::bindTo(predicted, rows.kind->forces, buffers, receiving);
    const bool keepsForces = predicted.forces != nullptr;
    buffers.insert(buffers.end(), {boundIf(keepsForces, rows.forceRows[0]), boundIf(keepsForces, places)});
    row_contacts::addOverTouched(program, rows, TOUCHED_PARTICLES, k::receiveRows, std::move(buffers),
                                 std::move(receiving));
}

void addPasses(ProgramBuilder& program, const Recoils& recoils, const Found& found,
               const ParticleBuffers& state, std::uint32_t substep) {
    if (!recoils.exist()) return;
    if (substep == 0) program.fill(recoils.arguments, 0);
    const layout::RecoilPush push{found.lists.push.count, substep};
    const pooled_lists::Lists& lists = found.lists.pooled;
    program.dispatchIndirect(k::findRecoils, {recoils.received, 0, push.count},
                             {found.touching, lists.contacts, state.velocities, lists.ranges, state.step,
                              recoils.members, recoils.degrees, recoils.arguments, recoils.near,
                              recoils.received},
                             push, constants(recoils, state));
    ProgramBuilder::Constants taking = remainderConstants(state.layout);
    taking.merge(receivedConstants(state));
    taking[hasRecoveryId] = found.hasRecovery;
    std::vector<BufferId> buffers{
        found.touching,    state.positions,  state.velocities,
        found.even,        found.odd,        state.step,
        recoils.contacts,  recoils.members,  recoils.degrees,
        recoils.arguments, recoils.received, lists.contacts,
        lists.ranges,      recoils.near,     found.hasRecovery ? lists.memory->memory : unbound,
        found.linked};
    forces::bindTo(state, &forces::Forces::ofContacts, buffers, taking);
    program.dispatchIndirect(k::takeRecoilsBack, {recoils.arguments, substep, 1}, buffers, push, taking);
}

} // namespace sinew::sim::collision::recoils
