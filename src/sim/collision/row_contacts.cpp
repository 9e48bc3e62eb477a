// The host side of contacts with faces and between edges: their buffers, and the order of the passes.
#include "sim/collision/row_contacts.hpp"

#include "kernels.hpp"

namespace sinew::sim::collision::row_contacts {

namespace {

namespace k = kernels;

void addOver(ProgramBuilder& program, const Rows& rows, const Groups& groups, const vk::ShaderCode& code,
             std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants = {}) {
    buffers.push_back(groups.listed);
    program.dispatchIndirect(code, groups.items, buffers, rows.push, constants);
}

void addOverRows(ProgramBuilder& program, const Rows& rows, const vk::ShaderCode& code,
                 std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants = {}) {
    buffers.push_back(rows.bounds);
    program.dispatchIndirect(code, rows.elements, buffers, rows.push, constants);
}

// Appends the pass that divides particles among the rows whose last word of `directions` is not 0.
void addShares(ProgramBuilder& program, const Rows& rows, BufferId directions,
               const ParticleBuffers& particles) {
    addOver(program, rows, rows.particles, rows.kind->share.form(rows.usesTexels),
            {rows.lists.ranges, directions, rows.weights, rows.corners, rows.lists.links->elements,
             rows.lists.links->ranges, rows.cornerEnds, particles.velocities, rows.shares});
}

// Appends the pass that applies impulses to particles, in the form that keeps forces if the step does.
void addImpulses(ProgramBuilder& program, const Rows& rows, BufferId directions, const forces::Forms& forms,
                 const ParticleBuffers& particles, ProgramBuilder::Constants constants = {}) {
    std::vector<BufferId> buffers{rows.lists.ranges,
                                  directions,
                                  rows.weights,
                                  rows.corners,
                                  rows.lists.links->elements,
                                  rows.lists.links->ranges,
                                  rows.cornerEnds,
                                  rows.impulses,
                                  particles.velocities,
                                  particles.positions,
                                  particles.step};
    const vk::ShaderCode& code = forces::formFor(particles, forms, rows.kind->forces, buffers, constants);
    if (particles.forces) buffers.insert(buffers.end(), rows.forceRows.begin(), rows.forceRows.end());
    addOver(program, rows, rows.particles, code, std::move(buffers), constants);
}

sleep::SeenRows seenOf(const Rows& rows) {
    sleep::SeenRows seen{rows.kind->wake,
                         rows.kind->join,
                         {rows.lists.contacts, rows.lists.ranges, rows.directions, rows.shapes}};
    if (rows.kind == &edges) seen.buffers.push_back(rows.corners);
    return seen;
}

} // namespace

constinit const Kind faces{.name = "faces",
                           .touch = {&k::findFaceContacts, &k::findFaceContactsLoads},
                           .touchesLists = true,
                           .share = {&k::shareFaces, &k::shareFacesLoads},
                           .press = {&k::pressFaces, &k::pressFacesLoads},
                           .bounce = &k::bounceFaces,
                           .rebound = &k::reboundFaces,
                           .gather = {&k::gatherFaces, &k::gatherFacesForces},
                           .gatherLoads = {&k::gatherFacesLoads, &k::gatherFacesForces},
                           .gatherRebound = {&k::gatherFacesRebound, &k::gatherFacesReboundForces},
                           .forces = &forces::Forces::ofStops,
                           .wake = &k::wakeFaces,
                           .join = &k::joinFaces};

constinit const Kind edges{.name = "edges",
                           .touch = {&k::findEdgeContacts, &k::findEdgeContactsLoads},
                           .share = {&k::shareEdges, &k::shareEdgesLoads},
                           .press = {&k::pressEdges, &k::pressEdgesLoads},
                           .bounce = &k::bounceEdges,
                           .rebound = &k::reboundEdges,
                           .gather = {&k::gatherEdges, &k::gatherEdgesForces},
                           .gatherLoads = {&k::gatherEdgesLoads, &k::gatherEdgesForces},
                           .gatherRebound = {&k::gatherEdgesRebound, &k::gatherEdgesReboundForces},
                           .forces = &forces::Forces::ofContacts,
                           .wake = &k::wakeEdges,
                           .join = &k::joinEdges};

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
    if (rows.surfaces.hasRestitution)
        rows.bounces = program.scratch<layout::vec4>(name + ".bounces", elements);
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
    const vk::ShaderCode& touch = rows.kind->touch.form(rows.usesTexels);
    if (rows.kind->touchesLists)
        addOver(program, rows, rows.particles, touch, std::move(buffers), constants);
    else
        addOverRows(program, rows, touch, std::move(buffers), constants);
    sleep::addRowTouches(program, predicted, seenOf(rows));
    addShares(program, rows, rows.directions, predicted);
    addOverRows(program, rows, rows.kind->press.form(rows.usesTexels),
                {predicted.velocities, rows.shapes, lists.contacts, lists.links->owners, rows.directions,
                 rows.weights, rows.shares, lists.memory->memory, rows.impulses, rows.before, predicted.step,
                 rows.surfaces.ofParticles, rows.surfaces.pairs});
    addImpulses(program, rows, rows.directions, rows.usesTexels ? rows.kind->gather : rows.kind->gatherLoads,
                predicted, remainderConstants(predicted.layout));
}

void addBounces(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& state) {
    if (!rows.surfaces.hasRestitution) return;
    const pooled_lists::Lists& lists = rows.lists;
    addOverRows(program, rows, *rows.kind->bounce,
                {rows.before, rows.shapes, lists.contacts, lists.links->owners, rows.directions, rows.weights,
                 rows.surfaces.ofParticles, rows.surfaces.pairs, state.step, rows.bounces});
    addShares(program, rows, rows.bounces, state);
    addOverRows(program, rows, *rows.kind->rebound,
                {state.velocities, rows.shapes, lists.contacts, lists.links->owners, rows.bounces,
                 rows.weights, rows.shares, rows.impulses});
    addImpulses(program, rows, rows.bounces, rows.kind->gatherRebound, state);
}

void addPublishing(ProgramBuilder& program, const Rows& rows, const hash_grid::Grid& grid) {
    pooled_lists::addPublishing(program, rows.lists, grid);
    // Lists stay while everything sleeps, when no pass plans the number of groups.
    if (rows.sleeps) program.fill(grid.touching.arguments, 0);
}

} // namespace sinew::sim::collision::row_contacts
