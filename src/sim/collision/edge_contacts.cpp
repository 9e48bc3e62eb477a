// The host side of contacts between edges: who takes part, and the order of the passes.
#include "sim/collision/edge_contacts.hpp"

#include "kernels.hpp"
#include "sim/ranges.hpp"
#include "sim/sleep.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::edge_contacts {

namespace {

namespace k = kernels;
using edge_lists::Edge;

// For every slot the first of its entries, one more for the end; an entry is 2 x edge + end.
std::vector<std::uint32_t> cornersOf(std::span<const Edge> edges, const StateLayout& layout,
                                     const std::vector<float>& inverseMass) {
    std::vector<std::vector<std::uint32_t>> entries(layout.count);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
        for (std::uint32_t end = 0; end < 2; ++end)
            if (inverseMass[edges[e].ends[end]] > 0)
                entries[layout.slot[edges[e].ends[end]]].push_back(2 * e + end);
    std::vector<std::uint32_t> result(layout.count + 1);
    for (std::size_t i = 0; i <= layout.count; ++i) {
        result[i] = static_cast<std::uint32_t>(result.size());
        if (i < layout.count) result.insert(result.end(), entries[i].begin(), entries[i].end());
    }
    return result;
}

// As of contacts with faces: a radius, of coarse ones an eighth of their length.
float marginLength(std::span<const Edge> edges) {
    std::vector<float> lengths;
    for (const Edge& edge : edges) lengths.push_back(std::max(edge.thickness, edge.radius / 4));
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

edge_lists::Lists addLists(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                           const StateLayout& layout, std::vector<Edge> edges) {
    const std::vector<std::uint32_t> exclusions = excludedEdges(scene, edges);
    const float margin = settings.contactMargin * marginLength(edges);
    for (Edge& edge : edges)
        for (std::uint32_t& end : edge.ends) end = layout.slot[end];
    return edge_lists::add(program, {.edges = edges,
                                     .exclusions = exclusions,
                                     .margin = margin,
                                     .capacity = settings.contactRoom,
                                     .limit = ranges::mostContactRoom,
                                     .usesTexels = settings.forms.usesTexels});
}

// The forms of gather_faces for edges: with contacts between particles after it, or as the end of a substep.
const vk::ShaderCode& gatherForm(const Contacts& contacts) {
    if (!contacts.endsSubstep) return k::gatherEdges;
    return contacts.planes.count > 0 ? k::gatherEdgesPlanes : k::gatherEdgesEnd;
}

// Of kernels over particles instead of edges.
layout::FacePush pushOfParticles(const Contacts& contacts, const ParticleBuffers& particles) {
    layout::FacePush push = contacts.push;
    push.count = static_cast<std::uint32_t>(particles.layout.count);
    return push;
}

void addShares(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& particles) {
    const layout::FacePush push = pushOfParticles(contacts, particles);
    program.dispatch(k::shareEdges, push.count,
                     {contacts.corners, contacts.sums, particles.velocities, contacts.shares}, push);
}

void addGather(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               const ParticleBuffers& next) {
    std::vector<BufferId> buffers{contacts.corners,    contacts.impulses, predicted.velocities,
                                  predicted.positions, next.positions,    next.velocities,
                                  predicted.step};
    if (contacts.planes.count > 0)
        buffers.insert(buffers.end(),
                       {contacts.planes.planes, contacts.planes.contactOffsets, contacts.before});
    const layout::FacePush push = pushOfParticles(contacts, predicted);
    ProgramBuilder::Constants constants = remainderConstants(next.layout);
    if (contacts.planes.count > 0) constants.merge(contacts.planes.constants());
    program.dispatch(gatherForm(contacts), push.count, buffers, push, constants);
}

// Where corners stand this near to each other, the points of one sheet keep the edges of another out, and
// contacts between edges would only cost: of a fold they list hundreds.
bool isSparse(const Scene& scene, const Edge& edge) {
    constexpr float dense = 1.0f / 6; // half of the thickness of a sheet over length
    const Vec3 &a = scene.particles[edge.ends[0]].position, &b = scene.particles[edge.ends[1]].position;
    return edge.thickness < dense * std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

} // namespace

bool areIn(const Scene& scene) {
    if (!face_contacts::areIn(scene)) return false;
    const std::vector<Edge> edges = edgesOf(scene);
    const auto needsThem = [&](const Edge& edge) { return edge.moves && isSparse(scene, edge); };
    if (std::ranges::none_of(edges, needsThem)) return false;
    std::vector<std::size_t> degrees(scene.particles.size());
    for (const Edge& edge : edges)
        for (const std::uint32_t end : edge.ends) ++degrees[end];
    return std::ranges::any_of(edges, [&](const Edge& edge) {
        return edge.moves && degrees[edge.ends[0]] + degrees[edge.ends[1]] - 1 < edges.size();
    });
}

Contacts add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
             const ParticleBuffers& particles, const face_contacts::Contacts& faces, bool endsSubstep) {
    const StateLayout& layout = particles.layout;
    const std::vector<Edge> edges = edgesOf(scene);
    Contacts contacts{.lists = addLists(program, scene, settings, layout, edges),
                      .endsSubstep = endsSubstep,
                      .surfaces = faces.surfaces,
                      .before = faces.before,
                      .moved = particles};
    const layout::FaceFindPush& find = contacts.lists.push;
    contacts.push = {.count = find.points,
                     .row = find.row,
                     .faceRow = find.faceRow,
                     .surfaces = contacts.surfaces.count,
                     .recoverySpeed = scene.contacts.recoverySpeed,
                     .moving = 0,
                     .sheets = 0};
    ContactBuffers& shown = program.program().contacts;
    shown.edges = contacts.lists.edges;
    shown.edgePairs = contacts.lists.contacts;
    shown.edgeCounts = contacts.lists.counts;
    shown.edgeRow = contacts.push.row;
    shown.edgeCount = contacts.push.count;
    const std::size_t elements = std::size_t{find.row} * find.capacity, count = find.points;
    contacts.memory = side_memory::add(program, "edges", contacts.lists.contacts, contacts.lists.counts,
                                       contacts.lists.grid, contacts.push, elements);
    contacts.corners = program.upload("edges.corners", cornersOf(edges, layout, inverseMasses(scene)));
    contacts.directions = program.scratch<layout::vec4>("edges.directions", elements);
    contacts.weights = program.scratch<layout::vec4>("edges.weights", elements);
    contacts.sums = program.scratch<float>("edges.sums", 2 * count);
    contacts.impulses = program.scratch<layout::vec4>("edges.impulses", 2 * count);
    if (contacts.surfaces.hasRestitution)
        contacts.bounces = program.scratch<layout::vec4>("edges.bounces", elements);
    contacts.shares = program.scratch<float>("edges.shares", layout.count);
    if (endsSubstep) {
        contacts.planes = planes::addColliders(program, scene, layout);
    } else {
        contacts.moved.positions = program.scratch<layout::vec4>("edges.positions", positionCount(layout));
        contacts.moved.velocities = program.scratch<layout::vec4>("edges.velocities", layout.count);
    }
    return contacts;
}

void joinIslands(const Contacts& contacts, sleep::Sleep& sleep) {
    const edge_lists::Lists& lists = contacts.lists;
    sleep.edges = {lists.edges,         lists.contacts,   lists.counts,
                   contacts.directions, contacts.corners, contacts.push.row};
}

ParticleBuffers addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
                          const ParticleBuffers& next) {
    const edge_lists::Lists& lists = contacts.lists;
    const ParticleBuffers moved = contacts.endsSubstep ? next : contacts.moved;
    edge_lists::addWatch(program, lists, predicted);
    side_memory::addKeeping(program, contacts.memory);
    edge_lists::addLists(program, lists, predicted);
    side_memory::addReturning(program, contacts.memory);
    program.dispatch(k::touchEdges, contacts.push.count,
                     {predicted.velocities, lists.edges, lists.contacts, lists.counts, predicted.positions,
                      contacts.memory.memory, contacts.directions, contacts.weights, contacts.sums,
                      predicted.step},
                     contacts.push);
    sleep::addEdgeTouches(program, predicted);
    addShares(program, contacts, predicted);
    program.dispatch(k::pressEdges, contacts.push.count,
                     {predicted.velocities, lists.edges, lists.contacts, lists.counts, contacts.directions,
                      contacts.weights, contacts.shares, contacts.memory.memory, contacts.impulses,
                      contacts.before, predicted.step, contacts.surfaces.ofParticles,
                      contacts.surfaces.pairs},
                     contacts.push);
    addGather(program, contacts, predicted, moved);
    return moved;
}

void addBounces(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state) {
    if (!contacts.surfaces.hasRestitution) return;
    const edge_lists::Lists& lists = contacts.lists;
    const surfaces::Surfaces& surfaces = contacts.surfaces;
    program.dispatch(k::bounceEdges, contacts.push.count,
                     {contacts.before, lists.edges, lists.contacts, lists.counts, contacts.directions,
                      contacts.weights, surfaces.ofParticles, surfaces.pairs, state.step, contacts.bounces,
                      contacts.sums},
                     contacts.push);
    addShares(program, contacts, state);
    program.dispatch(k::reboundEdges, contacts.push.count,
                     {state.velocities, lists.edges, lists.contacts, lists.counts, contacts.bounces,
                      contacts.weights, contacts.shares, contacts.impulses},
                     contacts.push);
    const layout::FacePush push = pushOfParticles(contacts, state);
    program.dispatch(k::gatherEdgesRebound, push.count,
                     {contacts.corners, contacts.impulses, state.velocities, state.positions, state.step},
                     push);
}

void addPublishing(ProgramBuilder& program, const Contacts& contacts) {
    side_memory::addPublishing(program, contacts.memory);
}

} // namespace sinew::sim::collision::edge_contacts
