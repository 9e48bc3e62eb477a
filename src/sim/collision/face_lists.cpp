// The host side of lists of points and faces: large faces, and the order of the passes.
#include "sim/collision/face_lists.hpp"

#include "kernels.hpp"
#include "sim/collision/row_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::collision::face_lists {

namespace {

namespace k = kernels;

constexpr std::uint32_t hasLinksId = 1; // constant_id in face_search.glsl

// In the grid all points have radius 0: the size of cells follows from the faces.
std::vector<float> pointsOf(std::span<const float> radii) {
    std::vector<float> points;
    for (const float radius : radii) points.push_back(radius < 0 ? -1.0f : 0.0f);
    return points;
}

// Whole work groups; padding is ~0.
std::vector<std::uint32_t> facesWhere(std::span<const float> extents, float edge, bool isLarge) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < extents.size(); ++f)
        if ((extents[f] > edge) == isLarge) faces.push_back(f);
    if (!isLarge) faces.resize(paddedCount(extents.size()), ~0u);
    return faces;
}

std::vector<BufferId> searchBuffers(const Lists& lists, const ParticleBuffers& particles) {
    return {particles.positions, particles.velocities, lists.radii,
            lists.faces,         lists.pooled.chains,  lists.pooled.links->chains,
            lists.grid.bounds,   lists.pooled.pairs,   lists.excluded,
            particles.step};
}

// By slot: below 0 = neither a point nor a corner.
std::vector<float> watchedOf(const Request& request) {
    std::vector<float> watched(request.radii.begin(), request.radii.end());
    for (const layout::ContactFace& face : request.faces)
        for (const std::uint32_t corner : {face.a, face.b, face.c}) watched[corner] = 0;
    return watched;
}

// Distance up to which lists must be complete: beyond contact if some pair keeps its rest distance.
float reachOf(const Request& request) {
    float radius = 0, thickness = 0;
    for (const float one : request.radii) radius = std::max(radius, one);
    for (const layout::ContactFace& face : request.faces)
        thickness = std::max(thickness, std::abs(face.thickness));
    return radius + thickness + request.beyond;
}

} // namespace

Lists add(ProgramBuilder& program, const Request& request) {
    const std::size_t count = request.radii.size(), faces = request.faces.size();
    const float edge = std::max(hash_grid::largestInGrid(request.extents),
                                2 * hash_grid::largestInGrid(request.radii) + request.margin);
    const std::vector<float> points = pointsOf(request.radii);
    const std::vector<float> watched = watchedOf(request);
    const std::vector<std::uint32_t> large = facesWhere(request.extents, edge, true);
    Lists lists{.grid = hash_grid::add(program, {.radii = points,
                                                 .margin = request.margin,
                                                 .edge = edge,
                                                 .others = static_cast<std::uint32_t>(paddedCount(faces)),
                                                 .bodies = request.bodies,
                                                 .watched = watched,
                                                 .reach = reachOf(request),
                                                 .substeps = request.substeps,
                                                 .name = "faces.grid",
                                                 .radiiName = "faces.grid.radii"})};
    const layout::GridPush& grid = lists.grid.push;
    lists.push = {.points = grid.count,
                  .searched = grid.others,
                  .cells = grid.cells,
                  .most = edge,
                  .margin = request.margin + request.beyond,
                  .moving = request.moving,
                  .large = static_cast<std::uint32_t>(large.size())};
    lists.pooled = pooled_lists::add(program, {.name = "faces",
                                               .owners = count,
                                               .each = request.capacity,
                                               .others = request.moving + 1,
                                               .hasMemory = true});
    lists.push.room = lists.pooled.room;
    lists.grid.entries = pooled_lists::entriesInUse(lists.pooled, lists.grid);
    lists.radii = program.upload("faces.radii", request.radii);
    lists.inverseMasses = program.upload("faces.inverse_masses", request.inverseMasses);
    lists.faces = program.upload("faces", request.faces);
    lists.excluded = program.upload("faces.excluded", request.exclusions);
    lists.points = program.scratch<layout::FacePoints>("faces.points", 1);
    lists.apart = program.scratch<std::uint32_t>("faces.points.apart", count + faces);
    lists.liveLinks = request.liveLinks;
    lists.searched = program.upload("faces.searched", facesWhere(request.extents, edge, false));
    lists.large = program.upload("faces.large", large);
    lists.touching = program.scratch<std::uint32_t>("faces.groups", count / GROUP_ITEMS);
    lists.marks = program.scratch<std::uint32_t>("faces.groups.listed", count / GROUP_ITEMS);
    return lists;
}

void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    hash_grid::addFit(program, lists.grid, {particles.positions, particles.velocities, particles.step});
}

void addListCheck(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    hash_grid::addListCheckOfMembers(program, lists.grid,
                                     {particles.positions, particles.velocities, particles.step});
    hash_grid::addCells(program, lists.grid, particles.positions);
}

void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    const hash_grid::Grid& grid = lists.grid;
    std::vector<BufferId> parting{particles.velocities, lists.radii, lists.points, lists.apart,
                                  particles.step};
    const std::vector<BufferId> keeping = pooled_lists::keepingBuffers(lists.pooled);
    parting.insert(parting.end(), keeping.begin(), keeping.end());
    program.dispatchIndirect(k::listLargePoints, grid.particles, parting, lists.push);
    std::vector<BufferId> buffers = searchBuffers(lists, particles);
    const bool hasLinks = lists.liveLinks != BufferId{};
    const ProgramBuilder::Constants constants{{hasLinksId, hasLinks}};
    buffers.insert(buffers.end(), {grid.sorted, grid.starts, lists.points, lists.apart, lists.searched,
                                   lists.inverseMasses});
    buffers.push_back(boundIf(hasLinks, lists.liveLinks));
    program.dispatchIndirect(k::findFaces, grid.others, buffers, lists.push, constants);
    buffers = searchBuffers(lists, particles);
    buffers.insert(buffers.end(),
                   {lists.large, lists.apart, lists.points, program.program().status, lists.inverseMasses});
    buffers.push_back(boundIf(hasLinks, lists.liveLinks));
    program.dispatchIndirect(k::findWideFaces, grid.particles, buffers, lists.push, constants);
    buffers = pooled_lists::sortingBuffers(program, lists.pooled, grid, lists.radii);
    buffers.insert(buffers.end(), {grid.touching.arguments, lists.marks, lists.touching, lists.faces,
                                   lists.pooled.links->owners});
    program.dispatchIndirect(k::sortFaces, grid.particles, buffers, lists.push);
    program.dispatchIndirect(k::indexRowsByOwner, grid.others,
                             {lists.pooled.pairs, lists.pooled.links->chains, lists.pooled.contacts,
                              lists.pooled.ranges, lists.pooled.links->elements, lists.pooled.links->ranges,
                              lists.points, grid.bounds, lists.faces, program.program().status,
                              grid.touching.arguments, lists.marks, lists.touching},
                             lists.push, row_contacts::faces.constants());
}

} // namespace sinew::sim::collision::face_lists
