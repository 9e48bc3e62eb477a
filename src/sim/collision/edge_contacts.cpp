// The host side of contacts between edges: the participants, and the order of the passes.
#include "sim/collision/edge_contacts.hpp"

#include "common/rest_slack.h"
#include "kernels.hpp"
#include "sim/collision/debris_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::edge_contacts {

namespace {

namespace k = kernels;

using edge_lists::Edge;

// Ends of edges by slot. Static ends count only in scenes that keep forces.
row_contacts::Corners cornersOf(std::span<const Edge> edges, const StateLayout& layout,
                                const std::vector<float>& inverseMass, bool keepsForces) {
    std::vector<std::vector<std::uint32_t>> entries(layout.count);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
        for (std::uint32_t end = 0; end < 2; ++end)
            if (keepsForces || inverseMass[edges[e].ends[end]] > 0)
                entries[layout.slot[edges[e].ends[end]]].push_back(4 * e + end);
    return row_contacts::cornersOf(entries);
}

// Length unit of the margin, as in contacts with faces: the radius, or an eighth of the length of coarse
// edges.
float marginLength(std::span<const Edge> edges) {
    std::vector<float> lengths;
    for (const Edge& edge : edges) lengths.push_back(std::max(edge.thickness, edge.radius / 4));
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

edge_lists::Lists addLists(ProgramBuilder& program, const SceneModel& model, std::vector<Edge> edges,
                           bool keepsRest) {
    const StateLayout& layout = model.layout;
    const std::vector<std::uint32_t> exclusions = excludedEdges(model.scene, model.linkedBodies(), edges);
    const float margin = model.settings.contactMargin * marginLength(edges);
    const float thickest = std::ranges::max(edges, {}, &Edge::thickness).thickness;
    for (Edge& edge : edges)
        for (std::uint32_t& end : edge.ends) end = layout.slot[end];
    const body_frames::Bodies bodies = body_frames::bodiesOf(model);
    edge_lists::Lists lists = edge_lists::add(program, {.edges = edges,
                                                        .exclusions = exclusions,
                                                        .margin = margin,
                                                        .beyond = keepsRest ? 3 * REST_SLACK * thickest : 0,
                                                        .capacity = model.settings.contactRoom,
                                                        .particles = layout.count,
                                                        .bodies = &bodies,
                                                        .substeps = model.settings.substeps});
    collision::letDebrisLeave(program, lists.grid.watched, lists.grid);
    return lists;
}

// Whether the corners of an edge are too far apart for points alone. In denser sheets the points of one sheet
// keep the edges of another out, and contacts between edges would only add cost: a fold lists hundreds.
bool isSparse(const Scene& scene, const Edge& edge) {
    constexpr float dense = 1.0f / 6; // half of the thickness of a sheet over length
    const Vec3 &a = scene.particles[edge.ends[0]].position, &b = scene.particles[edge.ends[1]].position;
    return edge.thickness < dense * std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}

// constant_ids in find_edge_rows.comp and find_edge_contacts.comp
constexpr std::uint32_t keepsRestId = 1, hasZonesId = 5;

// Appends the pass that lists pairs which may touch.
void addRows(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted) {
    const row_contacts::Rows& rows = contacts.rows;
    ProgramBuilder::Constants constants = rows.touched.constants();
    constants[keepsRestId] = rows.keepsRest;
    constants[hasZonesId] = contacts.meeting != unbound;
    row_contacts::addOverRows(program, rows, k::findEdgeRows,
                              {predicted.positions, predicted.velocities, rows.shapes, rows.lists.contacts,
                               rows.lists.links->owners, rows.lists.memory->memory, rows.directions,
                               predicted.step, contacts.finding, contacts.meeting, rows.touched.arguments,
                               rows.touched.lists},
                              constants);
}

} // namespace

std::vector<Edge> edgesThatMeet(const SceneModel& model) {
    if (!model.facesTouch()) return {};
    const Scene& scene = model.scene;
    std::vector<Edge> edges = edgesOf(scene, model.inverseMass);
    const auto needsThem = [&](const Edge& edge) { return edge.moves && isSparse(scene, edge); };
    if (std::ranges::none_of(edges, needsThem)) return {};
    std::vector<std::size_t> degrees(scene.particles.size());
    for (const Edge& edge : edges)
        for (const std::uint32_t end : edge.ends) ++degrees[end];
    const auto hasPartner = [&](const Edge& edge) {
        return edge.moves && degrees[edge.ends[0]] + degrees[edge.ends[1]] - 1 < edges.size();
    };
    return std::ranges::any_of(edges, hasPartner) ? std::move(edges) : std::vector<Edge>{};
}

Contacts add(ProgramBuilder& program, const SceneModel& model, const std::vector<Edge>& edges,
             const ParticleBuffers& particles, const face_contacts::Contacts& faces) {
    Contacts contacts{.lists = addLists(program, model, edges, faces.rows.keepsRest),
                      .rows = {},
                      .constants = faces.separations.constants()};
    contacts.lists.grid.touched = row_contacts::addTouched(
        program, "edges", static_cast<std::uint32_t>(model.layout.count), contacts.lists.pooled.room);
    const edge_lists::Lists& lists = contacts.lists;
    contacts.rows = {.kind = &row_contacts::edges,
                     .push = {.count = lists.push.points,
                              .surfaces = faces.rows.surfaces.count,
                              .recoverySpeed = model.scene.contacts.recoverySpeed,
                              .moving = 0,
                              .sheets = 0,
                              .quick = faces.rows.push.quick},
                     .lists = lists.pooled,
                     .shapes = lists.edges,
                     .elements = lists.grid.entries,
                     .bounds = lists.grid.bounds,
                     .particles = {lists.grid.touchingParticles, lists.touching},
                     .touched = lists.grid.touched,
                     .surfaces = faces.rows.surfaces,
                     .marks = faces.rows.marks,
                     .keepsRest = faces.rows.keepsRest};
    row_contacts::add(program, contacts.rows,
                      cornersOf(edges, model.layout, model.inverseMass, model.settings.keepsForces),
                      particles);
    const bool mayPass = faces.zones.areBetweenSheets;
    contacts.constants[hasZonesId] = mayPass;
    if (mayPass) {
        contacts.finding = faces.zones.finding;
        contacts.meeting = program.scratch<std::uint32_t>("zones.meeting_edges", lists.pooled.room);
        contacts.looked = program.scratch<layout::vec4>("zones.looked", positionCount(model.layout));
    }
    contacts.rows.touching = {lists.pooled.links->owners, lists.pooled.links->elements,
                              lists.pooled.links->ranges, faces.separations.sheets,
                              contacts.finding,           contacts.meeting};
    ContactBuffers& shown = program.program().contacts;
    shown.edges = lists.edges;
    shown.edgePairs = lists.pooled.contacts;
    shown.edgeLists = lists.pooled.ranges;
    shown.edgeCount = contacts.rows.push.count;
    return contacts;
}

std::optional<impact_zones::FoundEdges> Contacts::passing() const {
    if (meeting == unbound) return {};
    return impact_zones::FoundEdges{.edges = lists.edges,
                                    .contacts = rows.lists.contacts,
                                    .owners = rows.lists.links->owners,
                                    .thickness = lists.thickness,
                                    .looked = looked,
                                    .bounds = rows.bounds,
                                    .meeting = meeting,
                                    .most = rows.elements.most};
}

void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst) {
    if (isFirst) edge_lists::addFit(program, contacts.lists, predicted);
    edge_lists::addListCheck(program, contacts.lists, predicted);
    edge_lists::addLists(program, contacts.lists, predicted);
    ProgramBuilder::Constants constants = row_contacts::restConstants(contacts.rows.keepsRest, isFirst);
    constants.merge(ProgramBuilder::Constants(contacts.constants));
    if (contacts.looked != unbound) program.copy(predicted.positions, contacts.looked);
    addRows(program, contacts, predicted);
    row_contacts::addPasses(program, contacts.rows, predicted, constants);
}

} // namespace sinew::sim::collision::edge_contacts
