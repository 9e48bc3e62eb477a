// Contacts leave predicted positions, and the last of their passes ends the substep.
#include "sim/solvers/touching.hpp"

#include "kernels.hpp"
#include "sim/collision/cut_contacts.hpp"
#include "sim/forces/forces.hpp"
#include "sim/sleep/sleep.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace sinew::sim::solvers {

namespace {

// Appends the end of a substep in which no particles touch each other.
void addFinish(ProgramBuilder& program, const Touching& touching, const ParticleBuffers& predicted,
               const ParticleBuffers& next) {
    std::vector<BufferId> buffers{predicted.positions, predicted.velocities, next.step, next.positions,
                                  next.velocities};
    ProgramBuilder::Constants constants = remainderConstants(next.layout);
    buffers.insert(buffers.end(), {touching.before, touching.planes.planes, touching.planes.contactOffsets});
    constants.merge(touching.planes.constants());
    forces::bindTo(next, &forces::Forces::ofPlanes, buffers, constants);
    buffers.push_back(touching.particles);
    program.dispatch(kernels::finishAfterSurfaces, touching.particleCount, buffers,
                     layout::CountPush{touching.particleCount}, constants);
}

void joinIslands(const Touching& touching, sleep::Sleep& sleep) {
    if (touching.faces) collision::row_contacts::joinIslands(touching.faces->rows, sleep);
    if (touching.edges) collision::row_contacts::joinIslands(touching.edges->rows, sleep);
    if (touching.pairs) collision::particle_contacts::joinIslands(*touching.pairs, sleep);
}

// Faces before edges: both look for the topology that the others have added.
std::vector<collision::CutFilter> filtersOf(ProgramBuilder& program, const Touching& touching) {
    std::vector<collision::CutFilter> filters;
    if (touching.faces) filters = collision::faceFilters(program, *touching.faces);
    if (!touching.edges) return filters;
    std::ranges::move(collision::edgeFilters(program, *touching.edges), std::back_inserter(filters));
    return filters;
}

Touching contactsOf(Build& build) {
    namespace edges = collision::edge_contacts;
    ProgramBuilder& program = build.program;
    const SceneModel& model = build.model;
    Touching touching;
    if (model.facesTouch()) touching.faces = collision::face_contacts::add(program, model, build.particles);
    if (const auto meeting = edges::edgesThatMeet(model); !meeting.empty())
        touching.edges = edges::add(program, model, meeting, build.particles, *touching.faces);
    if (model.particlesTouch()) {
        touching.pairs = collision::particle_contacts::add(program, model);
        touching.pairs->recoils.followsRows = touching.receivesRows();
        return touching;
    }
    const std::vector<std::uint32_t> slots = slotsInOrder(model.layout);
    touching.planes = rigid::planes::add(program, model.scene, model.layout);
    touching.particles = program.upload("state.particles", slots);
    touching.particleCount = static_cast<std::uint32_t>(slots.size());
    return touching;
}

} // namespace

void Touching::begin(BufferId velocities) {
    before = velocities;
    if (faces) faces->rows.before = velocities;
    if (edges) edges->rows.before = velocities;
    if (pairs) pairs->before = velocities;
}

void Touching::addPasses(ProgramBuilder& program, const ParticleBuffers& predicted,
                         const ParticleBuffers& next, bool isFirst) const {
    if (faces) collision::face_contacts::addPasses(program, *faces, predicted, isFirst);
    if (edges) collision::edge_contacts::addPasses(program, *edges, predicted, isFirst);
    if (receivesRows())
        collision::recoils::addRows(program, pairs->recoils, faces->rows, faces->linkedPositions, predicted,
                                    isFirst);
    if (pairs)
        collision::particle_contacts::addPasses(program, *pairs, predicted, next, isFirst);
    else
        addFinish(program, *this, predicted, next);
}

void Touching::addBounces(ProgramBuilder& program, const ParticleBuffers& met, ParticleBuffers& current) {
    if (faces) collision::row_contacts::addBounces(program, faces->rows, current);
    if (edges) collision::row_contacts::addBounces(program, edges->rows, current);
    if (!pairs || !pairs->surfaces.hasRestitution) return;
    collision::particle_contacts::addBounces(program, *pairs, met, current);
    std::swap(current.velocities, pairs->rebounding);
}

void Touching::addStops(ProgramBuilder& program, const ParticleBuffers& predicted,
                        const ParticleBuffers& state) const {
    if (!faces) return;
    using collision::face_contacts::StopKind;
    const auto addSeparations = [&](const collision::row_contacts::Rows& rows) {
        collision::separations::addPasses(program, faces->separations, rows, predicted, state);
    };
    addSeparations(faces->rows);
    if (edges) addSeparations(edges->rows);
    collision::face_contacts::addStops(program, *faces, state, StopKind::all);
    if (!faces->zones.exist()) return;
    collision::face_contacts::addZones(program, *faces, edges ? edges->passing() : std::nullopt, predicted,
                                       state);
    collision::face_contacts::addStops(program, *faces, state, StopKind::passing);
}

void Touching::addRecoils(ProgramBuilder& program, const ParticleBuffers& predicted,
                          const ParticleBuffers& state, std::uint32_t substep) const {
    if (!pairs) return;
    const BufferId linked = receivesRows() ? faces->linkedVelocities : predicted.velocities;
    collision::particle_contacts::addRecoils(program, *pairs, linked, predicted, state, substep);
}

Touching& addTouching(Build& build) {
    Touching& touching = build.keep(contactsOf(build));
    if (touching.pairs) build.particles.received = touching.pairs->recoils.received;
    if (build.particles.sleep) joinIslands(touching, *build.particles.sleep);
    touching.filters = filtersOf(build.program, touching);
    if (touching.pairs) collision::addToTopology(build.program, *touching.pairs);
    addCutFilters(build);
    return touching;
}

void addCutFilters(Build& build) {
    const Touching* touching = build.find<Touching>();
    if (!touching) return;
    collision::addFilters(build.program, touching->filters);
    if (touching->pairs) collision::addContactFilter(build.program, *touching->pairs);
}

void addContactMemory(Build& build) {
    const Touching* touching = build.find<Touching>();
    if (!touching) return;
    const auto& [faces, edges, pairs] = std::tie(touching->faces, touching->edges, touching->pairs);
    if (faces) collision::row_contacts::addPublishing(build.program, faces->rows, faces->lists.grid);
    if (edges) collision::row_contacts::addPublishing(build.program, edges->rows, edges->lists.grid);
    if (pairs) collision::particle_contacts::addPublishing(build.program, *pairs);
}

} // namespace sinew::sim::solvers
