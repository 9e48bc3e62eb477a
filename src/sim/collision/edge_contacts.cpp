// The host side of contacts between edges: who takes part, and the order of the passes.
#include "sim/collision/edge_contacts.hpp"

#include "kernels.hpp"
#include "rest_slack.h"
#include "sim/forces.hpp"
#include "sim/sleep.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::edge_contacts {

namespace {

namespace k = kernels;
using edge_lists::Edge;

// For every slot the first of its entries, one more for the end; an entry is 2 x edge + end. Where forces are
// kept, ends that never move feel them too.
std::vector<std::uint32_t> cornersOf(std::span<const Edge> edges, const StateLayout& layout,
                                     const std::vector<float>& inverseMass, bool keepsForces) {
    std::vector<std::vector<std::uint32_t>> entries(layout.count);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
        for (std::uint32_t end = 0; end < 2; ++end)
            if (keepsForces || inverseMass[edges[e].ends[end]] > 0)
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
                           const StateLayout& layout, std::vector<Edge> edges, bool keepsRest) {
    const std::vector<std::uint32_t> exclusions = excludedEdges(scene, edges);
    const float margin = settings.contactMargin * marginLength(edges);
    const float thickest = std::ranges::max(edges, {}, &Edge::thickness).thickness;
    for (Edge& edge : edges)
        for (std::uint32_t& end : edge.ends) end = layout.slot[end];
    return edge_lists::add(program, {.edges = edges,
                                     .exclusions = exclusions,
                                     .margin = margin,
                                     .beyond = keepsRest ? 3 * REST_SLACK * thickest : 0,
                                     .capacity = settings.contactRoom,
                                     .usesTexels = settings.forms.usesTexels,
                                     .particles = layout.count});
}

// A pass over the edges of groups in which one may touch another.
void addOverEdges(ProgramBuilder& program, const Contacts& contacts, const vk::ShaderCode& code,
                  std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants = {}) {
    const edge_lists::Lists& lists = contacts.lists;
    buffers.push_back(lists.touching);
    program.dispatchIndirect(code, lists.grid.touching, buffers, contacts.push, constants);
}

// Of kernels over particles instead of edges.
layout::FacePush pushOfParticles(const Contacts& contacts, const ParticleBuffers& particles) {
    layout::FacePush push = contacts.push;
    push.count = static_cast<std::uint32_t>(particles.layout.count);
    return push;
}

// A pass over the particles of groups in which one is an end of such an edge.
void addOverEnds(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& particles,
                 const vk::ShaderCode& code, std::vector<BufferId> buffers,
                 const ProgramBuilder::Constants& constants = {}) {
    const edge_lists::Lists& lists = contacts.lists;
    buffers.push_back(lists.touchingParticles);
    program.dispatchIndirect(code, lists.grid.touchingParticles, buffers,
                             pushOfParticles(contacts, particles), constants);
}

// One that gives impulses to them: in the form that keeps these where the step does.
void addImpulses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& particles,
                 const forces::Forms& forms, std::vector<BufferId> buffers,
                 ProgramBuilder::Constants constants = {}) {
    const vk::ShaderCode& code =
        forces::formFor(particles, forms, &forces::Forces::ofContacts, buffers, constants);
    addOverEnds(program, contacts, particles, code, std::move(buffers), constants);
}

void addShares(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& particles) {
    addOverEnds(program, contacts, particles, k::shareEdges,
                {contacts.corners, contacts.lists.sums, particles.velocities, contacts.shares});
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
             const ParticleBuffers& particles, const face_contacts::Contacts& faces) {
    const StateLayout& layout = particles.layout;
    const std::vector<Edge> edges = edgesOf(scene);
    Contacts contacts{.lists = addLists(program, scene, settings, layout, edges, faces.keepsRest),
                      .sleeps = particles.sleep != nullptr,
                      .surfaces = faces.surfaces,
                      .marks = faces.marks,
                      .keepsRest = faces.keepsRest};
    const layout::FaceFindPush& find = contacts.lists.push;
    contacts.push = {.count = find.points,
                     .surfaces = contacts.surfaces.count,
                     .recoverySpeed = scene.contacts.recoverySpeed,
                     .moving = 0,
                     .sheets = 0};
    ContactBuffers& shown = program.program().contacts;
    shown.edges = contacts.lists.edges;
    shown.edgePairs = contacts.lists.pooled.contacts;
    shown.edgeLists = contacts.lists.pooled.ranges;
    shown.edgeCount = contacts.push.count;
    const std::size_t elements = contacts.lists.pooled.room;
    contacts.corners =
        program.upload("edges.corners", cornersOf(edges, layout, inverseMasses(scene), settings.keepsForces));
    contacts.directions = program.scratch<layout::vec4>("edges.directions", elements);
    contacts.weights = program.scratch<layout::vec4>("edges.weights", elements);
    if (contacts.surfaces.hasRestitution)
        contacts.bounces = program.scratch<layout::vec4>("edges.bounces", elements);
    contacts.shares = program.scratch<float>("edges.shares", layout.count);
    return contacts;
}

void joinIslands(const Contacts& contacts, sleep::Sleep& sleep) {
    const edge_lists::Lists& lists = contacts.lists;
    sleep.edges = {lists.edges, lists.pooled.contacts, lists.pooled.ranges, contacts.directions,
                   contacts.corners};
}

void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst) {
    const edge_lists::Lists& lists = contacts.lists;
    edge_lists::addWatch(program, lists, predicted);
    edge_lists::addLists(program, lists, predicted);
    addOverEdges(program, contacts, k::touchEdges,
                 {predicted.velocities, lists.edges, lists.pooled.contacts, lists.pooled.ranges,
                  predicted.positions, lists.pooled.memory->memory, contacts.directions, contacts.weights,
                  lists.sums, predicted.step, contacts.marks},
                 face_contacts::restConstants(contacts.keepsRest, isFirst));
    sleep::addEdgeTouches(program, predicted);
    addShares(program, contacts, predicted);
    addOverEdges(program, contacts, k::pressEdges,
                 {predicted.velocities, lists.edges, lists.pooled.contacts, lists.pooled.ranges,
                  contacts.directions, contacts.weights, contacts.shares, lists.pooled.memory->memory,
                  lists.impulses, contacts.before, predicted.step, contacts.surfaces.ofParticles,
                  contacts.surfaces.pairs});
    addImpulses(program, contacts, predicted, {&k::gatherEdges, &k::gatherEdgesForces},
                {contacts.corners, lists.impulses, predicted.velocities, predicted.positions, predicted.step},
                remainderConstants(predicted.layout));
}

void addBounces(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state) {
    if (!contacts.surfaces.hasRestitution) return;
    const edge_lists::Lists& lists = contacts.lists;
    const surfaces::Surfaces& surfaces = contacts.surfaces;
    addOverEdges(program, contacts, k::bounceEdges,
                 {contacts.before, lists.edges, lists.pooled.contacts, lists.pooled.ranges,
                  contacts.directions, contacts.weights, surfaces.ofParticles, surfaces.pairs, state.step,
                  contacts.bounces, lists.sums});
    addShares(program, contacts, state);
    addOverEdges(program, contacts, k::reboundEdges,
                 {state.velocities, lists.edges, lists.pooled.contacts, lists.pooled.ranges, contacts.bounces,
                  contacts.weights, contacts.shares, lists.impulses});
    addImpulses(program, contacts, state, {&k::gatherEdgesRebound, &k::gatherEdgesReboundForces},
                {contacts.corners, lists.impulses, state.velocities, state.positions, state.step});
}

void addPublishing(ProgramBuilder& program, const Contacts& contacts) {
    pooled_lists::addPublishing(program, contacts.lists.pooled, contacts.lists.grid);
    // Lists stay while all sleeps, and nothing plans how many groups run then.
    if (contacts.sleeps) program.fill(contacts.lists.grid.touching.arguments, 0);
}

} // namespace sinew::sim::collision::edge_contacts
