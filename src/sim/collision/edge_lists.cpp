// The host side of lists of edges: sizes, and the order of the passes.
#include "sim/collision/edge_lists.hpp"

#include "collision/face_points.h"
#include "kernels.hpp"
#include "sim/collision/row_contacts.hpp"
#include "sim/sleep/sleep.hpp"

#include <algorithm>

namespace sinew::sim::collision::edge_lists {

namespace {

namespace k = kernels;

// Edges are searched for in cells if their bounding sphere, including their motion in a substep, is at most
// so many times as large as that of most others.
constexpr float widestInCells = 2;

// By edge, whole work groups.
struct Tables {
    std::vector<layout::ContactEdge> edges;
    std::vector<float> radii, points, thickness;
};

Tables tablesOf(const Request& request) {
    const std::size_t count = paddedCount(request.edges.size());
    Tables tables{std::vector<layout::ContactEdge>(count, {0, 0, 0, -1}), std::vector<float>(count, -1),
                  std::vector<float>(count, -1), std::vector<float>(count, 0)};
    for (std::size_t e = 0; e < request.edges.size(); ++e) {
        const Edge& edge = request.edges[e];
        tables.edges[e] = {edge.ends[0], edge.ends[1], edge.moves ? 1u : 0u, edge.radius};
        tables.radii[e] = edge.radius;
        tables.points[e] = 0;
        tables.thickness[e] = edge.thickness;
    }
    return tables;
}

// By slot: below 0 = not an end of an edge.
std::vector<float> watchedOf(const Request& request) {
    std::vector<float> watched(request.particles, -1);
    for (const Edge& edge : request.edges)
        for (const std::uint32_t end : edge.ends) watched[end] = 0;
    return watched;
}

// Distance up to which lists must be complete.
float reachOf(const Request& request) {
    return 2 * std::ranges::max(request.edges, {}, &Edge::thickness).thickness + request.beyond;
}

} // namespace

Lists add(ProgramBuilder& program, const Request& request) {
    Tables tables = tablesOf(request);
    const std::size_t count = tables.edges.size();
    const float largest = hash_grid::largestInGrid(tables.radii);
    const std::vector<float> watched = watchedOf(request);
    const auto ends = static_cast<std::size_t>(std::ranges::count(watched, 0.0f));
    Lists lists{.grid = hash_grid::add(
                    program, {.radii = tables.points,
                              .margin = request.margin,
                              .edge = 2 * largest + request.margin,
                              .linked = static_cast<std::uint32_t>(count),
                              .others = static_cast<std::uint32_t>(paddedCount(std::max(count, ends))),
                              .bodies = request.bodies,
                              .particles = request.particles,
                              .watched = watched,
                              .reach = reachOf(request),
                              .hasHeadings = true,
                              .substeps = request.substeps,
                              .name = "edges.grid",
                              .radiiName = "edges.grid.radii"})};
    const layout::GridPush& grid = lists.grid.push;
    lists.push = {.points = grid.count,
                  .searched = 0,
                  .cells = grid.cells,
                  .most = widestInCells * largest,
                  .margin = request.margin + request.beyond,
                  .moving = grid.count,
                  .large = 0};
    lists.pooled = pooled_lists::add(
        program,
        {.name = "edges", .owners = count, .each = request.capacity, .others = count, .hasMemory = true});
    lists.push.room = lists.pooled.room;
    lists.edges = program.upload("edges", tables.edges);
    lists.radii = program.upload("edges.radii", tables.radii);
    lists.thickness = program.upload("edges.thickness", tables.thickness);
    lists.middles = program.scratch<layout::vec4>("edges.middles", count);
    lists.speeds = program.scratch<layout::vec4>("edges.speeds", count);
    lists.excluded = program.upload("edges.excluded", request.exclusions);
    lists.points = program.scratch<std::uint32_t>("edges.points", FACE_POINTS_FIRST + count);
    const std::size_t groups = request.particles / GROUP_ITEMS;
    lists.touching = program.scratch<std::uint32_t>("edges.groups", groups);
    lists.marks = program.scratch<std::uint32_t>("edges.groups.listed", groups);
    lists.grid.entries = pooled_lists::entriesInUse(lists.pooled, lists.grid);
    return lists;
}

void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    hash_grid::addFit(
        program, lists.grid,
        {particles.positions, particles.velocities, particles.step, sleep::weightsOf(particles)});
}

void addListCheck(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    const hash_grid::Grid& grid = lists.grid;
    const hash_grid::Moved moved{particles.positions, particles.velocities, particles.step};
    hash_grid::addListCheckOfMembers(program, grid, moved);
    program.dispatchIndirect(
        k::computeEdgeBounds, grid.others,
        {particles.positions, particles.velocities, lists.edges, lists.thickness, lists.middles, lists.speeds,
         grid.detected, grid.frames.ofSlots, grid.watched, grid.frames.members, particles.step, grid.headings,
         grid.frames.frames, lists.points},
        layout::ComputeEdgeBoundsPush{grid.push.others, grid.push.count, grid.frames.memberCount,
                                      grid.push.ahead, grid.push.pace, 0.5f * grid.push.margin});
    hash_grid::addCells(program, grid, lists.middles, moved);
}

void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    const hash_grid::Grid& grid = lists.grid;
    std::vector<BufferId> buffers{lists.speeds, lists.radii, lists.points, unbound, particles.step};
    const std::vector<BufferId> keeping = pooled_lists::keepingBuffers(lists.pooled);
    buffers.insert(buffers.end(), keeping.begin(), keeping.end());
    buffers.insert(buffers.end(), {grid.bounds, lists.pooled.links->ranges});
    constexpr std::uint32_t limitsMotionId = 3; // constant_id in list_large_points.comp
    program.dispatchIndirect(k::listLargePoints, grid.particles, buffers, lists.push, {{limitsMotionId, 1}});
    program.dispatchIndirect(k::findEdges, grid.particles,
                             {particles.positions, lists.edges, lists.speeds, lists.thickness, grid.sorted,
                              grid.starts, lists.excluded, grid.bounds, lists.points, grid.headings,
                              lists.middles, lists.pooled.chains, lists.pooled.pairs,
                              program.program().status, lists.pooled.links->chains, particles.step,
                              particles.velocities},
                             lists.push);
    pooled_lists::addPlan(program, grid, lists.points, lists.push, row_contacts::edges.constants());
    buffers = pooled_lists::sortingBuffers(program, lists.pooled, grid, lists.thickness);
    buffers.push_back(lists.pooled.links->owners);
    program.dispatchIndirect(k::sortEdges, grid.owners, buffers, lists.push);
    const pooled_lists::Links& links = *lists.pooled.links;
    program.dispatchIndirect(k::indexRowsByOwner, grid.linked,
                             {lists.pooled.pairs, links.chains, lists.pooled.contacts, lists.pooled.ranges,
                              links.elements, links.ranges, grid.bounds, lists.edges,
                              program.program().status, grid.touching.arguments, lists.marks, lists.touching},
                             lists.push, row_contacts::edges.constants());
}

} // namespace sinew::sim::collision::edge_lists
