// The host side of contacts with faces and between edges: their buffers, and the order of the passes.
#include "sim/collision/row_contacts.hpp"

#include "collision/touched.h"
#include "kernels.hpp"
#include "sim/events/events.hpp"

namespace sinew::sim::collision::row_contacts {

namespace {

namespace k = kernels;

// Rows among which particles are divided: those that touch, or those of them that rebound.
enum class Dividing : bool { touches, rebounds };

// Appends the pass that divides particles.
void addShares(ProgramBuilder& program, const Rows& rows, Dividing dividing,
               const ParticleBuffers& particles) {
    constexpr std::uint32_t ofReboundsId = 1; // constant_id in sum_row_weights.comp
    const bool ofRebounds = dividing == Dividing::rebounds;
    ProgramBuilder::Constants constants = rows.kind->constants();
    constants[ofReboundsId] = ofRebounds;
    addOverTouched(program, rows, TOUCHED_PARTICLES, k::sumRowWeights,
                   {rows.lists.ranges, rows.directions, rows.weights, rows.corners,
                    rows.lists.links->elements, rows.lists.links->ranges, rows.cornerEnds,
                    particles.velocities, rows.shares, boundIf(ofRebounds, rows.impulses)},
                   std::move(constants));
}

// Appends the pass that applies impulses to particles.
void addImpulses(ProgramBuilder& program, const Rows& rows, const vk::ShaderCode& code,
                 const ParticleBuffers& particles, ProgramBuilder::Constants constants = {}) {
    std::vector<BufferId> buffers{
        rows.lists.ranges,          rows.directions,          rows.weights,    rows.corners,
        rows.lists.links->elements, rows.lists.links->ranges, rows.cornerEnds, rows.impulses,
        particles.velocities,       particles.positions,      particles.step};
    forces::bindTo(particles, rows.kind->forces, buffers, constants);
    const bool hasStops = particles.forces != nullptr && !rows.kind->areEdges;
    for (const BufferId buffer : rows.forceRows) buffers.push_back(hasStops ? buffer : unbound);
    constants.merge(rows.kind->constants());
    addOverTouched(program, rows, TOUCHED_PARTICLES, code, std::move(buffers), std::move(constants));
}

sleep::SeenRows seenOf(const Rows& rows) {
    return {{rows.lists.contacts, rows.lists.ranges, rows.directions, rows.shapes,
             boundIf(rows.kind->areEdges, rows.corners)},
            rows.kind->constants()};
}

} // namespace

constinit const Kind faces{.name = "faces",
                           .touch = &k::findFaceContacts,
                           .searched = TOUCHED_POINTS,
                           .forces = &forces::Forces::ofStops};

constinit const Kind edges{.name = "edges",
                           .areEdges = true,
                           .touch = &k::findEdgeContacts,
                           .searched = TOUCHED_ROWS,
                           .forces = &forces::Forces::ofContacts};

void addOverParticles(ProgramBuilder& program, const Rows& rows, const vk::ShaderCode& code,
                      std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants) {
    buffers.push_back(rows.particles.listed);
    program.dispatchIndirect(code, rows.particles.items, buffers, rows.push, constants);
}

void addOverRows(ProgramBuilder& program, const Rows& rows, const vk::ShaderCode& code,
                 std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants) {
    buffers.push_back(rows.bounds);
    program.dispatchIndirect(code, rows.elements, buffers, rows.push, constants);
}

void addOverTouched(ProgramBuilder& program, const Rows& rows, std::uint32_t list, const vk::ShaderCode& code,
                    std::vector<BufferId> buffers, ProgramBuilder::Constants constants) {
    buffers.push_back(rows.touched.lists);
    constants.merge(rows.touched.constants());
    const bool arePoints = list == TOUCHED_POINTS;
    const IndirectItems items{arePoints ? rows.touched.points : rows.touched.arguments, arePoints ? 0 : list,
                              list == TOUCHED_ROWS ? rows.elements.most : rows.touched.slots};
    program.dispatchIndirect(code, items, buffers, rows.push, constants);
}

hash_grid::Touched addTouched(ProgramBuilder& program, const std::string& name, std::uint32_t slots,
                              std::uint32_t room) {
    const std::uint64_t words = TOUCHED_MARKS + std::uint64_t{slots} * 3 + room;
    return {.points = program.scratch<layout::DispatchArguments>(name + ".touched.points", 1),
            .arguments = program.scratch<layout::DispatchArguments>(name + ".touched.arguments", 2),
            .lists = program.scratchOfStep<std::uint32_t>(name + ".touched", words),
            .slots = slots};
}

Corners cornersOf(std::span<const std::vector<std::uint32_t>> first,
                  std::span<const std::vector<std::uint32_t>> later) {
    Corners corners{.entries = std::vector<std::uint32_t>(first.size() + 1), .ends = {}};
    std::vector<std::uint32_t>& entries = corners.entries;
    for (std::size_t i = 0; i < first.size(); ++i) {
        entries[i] = static_cast<std::uint32_t>(entries.size());
        entries.insert(entries.end(), first[i].begin(), first[i].end());
        corners.ends.push_back(static_cast<std::uint32_t>(entries.size()));
        if (!later.empty()) entries.insert(entries.end(), later[i].begin(), later[i].end());
    }
    entries[first.size()] = static_cast<std::uint32_t>(entries.size());
    return corners;
}

void add(ProgramBuilder& program, Rows& rows, const Corners& corners, const ParticleBuffers& particles) {
    const std::string name = rows.kind->name;
    const std::size_t elements = rows.lists.room;
    rows.sleeps = particles.sleep != nullptr;
    rows.corners = program.upload(name + ".corners", corners.entries);
    rows.cornerEnds = program.upload(name + ".corners.ends", corners.ends);
    rows.directions = program.scratch<layout::vec4>(name + ".directions", elements);
    rows.weights = program.scratch<layout::vec4>(name + ".weights", elements);
    rows.impulses = program.scratch<layout::vec4>(name + ".impulses", elements);
    rows.shares = program.scratch<float>(name + ".shares", particles.layout.count);
}

ProgramBuilder::Constants restConstants(bool keepsRest, bool isFirst) {
    constexpr std::uint32_t keepsRestId = 1, isFirstId = 2; // constant_ids in keeps_rest.glsl
    if (!keepsRest) return {{keepsRestId, false}};
    return {{keepsRestId, true}, {isFirstId, isFirst}};
}

void joinIslands(const Rows& rows, sleep::Sleep& sleep) {
    sleep.rows.push_back(seenOf(rows));
}

void addPasses(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& predicted,
               const ProgramBuilder::Constants& constants) {
    const pooled_lists::Lists& lists = rows.lists;
    std::vector<BufferId> buffers{
        predicted.positions,  predicted.velocities, rows.shapes,  lists.contacts, lists.ranges,
        lists.memory->memory, rows.directions,      rows.weights, predicted.step, rows.marks};
    buffers.insert(buffers.end(), rows.touching.begin(), rows.touching.end());
    addOverTouched(program, rows, rows.kind->searched, *rows.kind->touch, std::move(buffers), constants);
    sleep::addRowTouches(program, predicted, seenOf(rows));
    events::addRows(program, predicted, seenOf(rows));
    addShares(program, rows, Dividing::touches, predicted);
    addOverTouched(program, rows, TOUCHED_ROWS, k::computeRowImpulses,
                   {predicted.velocities, rows.shapes, lists.contacts, lists.links->owners, rows.directions,
                    rows.weights, rows.shares, lists.memory->memory, rows.impulses, rows.before,
                    predicted.step, rows.surfaces.ofParticles, rows.surfaces.pairs},
                   rows.kind->constants());
    addImpulses(program, rows, k::applyRowImpulses, predicted, remainderConstants(predicted.layout));
}

void addBounces(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& state) {
    if (!rows.surfaces.hasRestitution) return;
    const pooled_lists::Lists& lists = rows.lists;
    addOverTouched(program, rows, TOUCHED_ROWS, k::findRowRebounds,
                   {rows.before, rows.shapes, lists.contacts, lists.links->owners, rows.directions,
                    rows.weights, rows.surfaces.ofParticles, rows.surfaces.pairs, state.step, rows.impulses},
                   rows.kind->constants());
    addShares(program, rows, Dividing::rebounds, state);
    addOverTouched(program, rows, TOUCHED_ROWS, k::solveRowRebounds,
                   {state.velocities, rows.shapes, lists.contacts, lists.links->owners, rows.directions,
                    rows.weights, rows.shares, rows.impulses},
                   rows.kind->constants());
    addImpulses(program, rows, k::applyRowRebounds, state);
}

void addPublishing(ProgramBuilder& program, const Rows& rows, const hash_grid::Grid& grid) {
    pooled_lists::addPublishing(program, rows.lists, grid);
    // Lists stay while everything sleeps, when no pass plans the number of groups.
    if (!rows.sleeps) return;
    program.fill(grid.touching.arguments, 0);
    program.fill(rows.touched.points, 0);
    program.fill(rows.touched.arguments, 0);
}

} // namespace sinew::sim::collision::row_contacts
