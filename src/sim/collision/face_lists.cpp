// The host side of lists of points and faces: large faces, and the order of the passes.
#include "sim/collision/face_lists.hpp"

#include "collision/face_points.h"
#include "kernels.hpp"
#include "sim/collision/row_contacts.hpp"
#include "sim/sleep/sleep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace sinew::sim::collision::face_lists {

namespace {

namespace k = kernels;
using sheet_patches::FacePair;

// constant_ids in face_search.glsl, list_large_points.comp and find_faces.comp
constexpr std::uint32_t hasLinksId = 1, hasHeadingsId = 2, limitsMotionId = 3, hasWideId = 3;

// In the grid all points have radius 0: the size of cells follows from the faces.
std::vector<float> pointsOf(std::span<const float> radii) {
    std::vector<float> points;
    for (const float radius : radii) points.push_back(radius < 0 ? -1.0f : 0.0f);
    return points;
}

constexpr std::uint32_t none = ~0u;

// Cells of the grid in sizes of most faces: with smaller ones a search reads more cells than points.
constexpr float cellOfFaces = 1.5f;

std::vector<std::uint32_t> largeFaces(std::span<const float> extents, float edge) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < extents.size(); ++f)
        if (extents[f] > edge) faces.push_back(f);
    return faces;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>; // the lower corner first

std::array<Edge, 3> edgesOf(const layout::ContactFace& face) {
    return {std::minmax(face.a, face.b), std::minmax(face.b, face.c), std::minmax(face.c, face.a)};
}

// Whether a face belongs to a body that deforms: others have corners that no contact moves.
bool deforms(const Request& request, const layout::ContactFace& face) {
    return request.inverseMasses[face.a] > 0 || request.inverseMasses[face.b] > 0 ||
           request.inverseMasses[face.c] > 0;
}

bool deform(const Request& request) {
    return std::ranges::any_of(request.faces, [&](const auto& face) { return deforms(request, face); });
}

// All other faces, those that deform in pairs that share an edge where possible; a face alone is paired with
// none. Faces of colliders are mostly too large for their neighbours' points to be theirs.
std::vector<FacePair> pairedFaces(const Request& request, float edge) {
    std::map<Edge, std::vector<std::uint32_t>> around;
    std::vector<bool> isLeft(request.faces.size());
    for (std::uint32_t f = 0; f < request.faces.size(); ++f) {
        isLeft[f] = !(request.extents[f] > edge);
        if (isLeft[f] && deforms(request, request.faces[f]))
            for (const Edge& one : edgesOf(request.faces[f])) around[one].push_back(f);
    }
    std::vector<FacePair> pairs;
    for (std::uint32_t f = 0; f < request.faces.size(); ++f) {
        if (!isLeft[f]) continue;
        isLeft[f] = false;
        std::uint32_t partner = none;
        for (const Edge& one : edgesOf(request.faces[f]))
            for (const std::uint32_t g : around[one])
                if (isLeft[g]) partner = std::min(partner, g);
        if (partner != none) isLeft[partner] = false;
        pairs.push_back({f, partner});
    }
    return pairs;
}

float thickestOf(std::span<const sheet_patches::Sheet> sheets) {
    float thickest = 0;
    for (const sheet_patches::Sheet& sheet : sheets) thickest = std::max(thickest, sheet.thickness);
    return thickest;
}

std::vector<std::uint32_t> padded(std::span<const FacePair> pairs) {
    std::vector<std::uint32_t> words;
    for (const FacePair& pair : pairs) words.insert(words.end(), {pair[0], pair[1]});
    words.resize(2 * paddedCount(std::max<std::size_t>(pairs.size(), 1)), none);
    return words;
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
    const std::vector<std::uint32_t> large = largeFaces(request.extents, edge);
    std::vector<FacePair> inPairs = pairedFaces(request, edge);
    const std::vector<layout::SheetPatch> patches =
        sheet_patches::sortIntoPatches(inPairs, request.sheets, request.faces);
    const std::vector<std::uint32_t> pairs = padded(inPairs);
    const auto loose = patches.empty() ? static_cast<std::uint32_t>(inPairs.size()) : patches.front().pairs;
    Lists lists{.grid = hash_grid::add(program, {.radii = points,
                                                 .margin = request.margin,
                                                 .edge = cellOfFaces * edge,
                                                 .searching = static_cast<std::uint32_t>(pairs.size() / 2),
                                                 .linked = request.moving + 1,
                                                 .bodies = request.bodies,
                                                 .watched = watched,
                                                 .reach = reachOf(request),
                                                 .hasHeadings = deform(request),
                                                 .substeps = request.substeps,
                                                 .name = "faces.grid",
                                                 .radiiName = "faces.grid.radii"})};
    const layout::GridPush grid = lists.grid.push;
    lists.push = {.points = grid.count,
                  .searched = static_cast<std::uint32_t>(pairs.size() / 2),
                  .cells = grid.cells,
                  .most = edge,
                  .margin = request.margin + request.beyond,
                  .moving = request.moving,
                  .large = static_cast<std::uint32_t>(large.size()),
                  .loose = loose};
    lists.patches = sheet_patches::add(program, patches, thickestOf(request.sheets), request.sharesPatches);
    lists.grid.push.loose = loose;
    lists.grid.push.patches = lists.patches.count;
    lists.grid.patches = {lists.grid.arguments, GRID_PATCHES, lists.patches.count, true};
    lists.pooled = pooled_lists::add(program, {.name = "faces",
                                               .owners = count,
                                               .each = request.capacity,
                                               .others = request.moving + 1,
                                               .hasMemory = true});
    lists.push.room = lists.pooled.room;
    lists.grid.entries = pooled_lists::entriesInUse(lists.pooled, lists.grid);
    lists.radii = program.upload("faces.radii", request.radii);
    program.program().grids.back().touching = lists.radii;
    lists.inverseMasses = program.upload("faces.inverse_masses", request.inverseMasses);
    lists.faces = program.upload("faces", request.faces);
    lists.excluded = program.upload("faces.excluded", request.exclusions);
    lists.points =
        program.scratch<std::uint32_t>("faces.points", FACE_POINTS_FIRST + count + pairs.size() / 2 + faces);
    lists.liveLinks = request.liveLinks;
    lists.searched = program.upload("faces.searched", pairs);
    lists.large = program.upload("faces.large", large);
    lists.touching = program.scratch<std::uint32_t>("faces.groups", count / GROUP_ITEMS);
    lists.marks = program.scratch<std::uint32_t>("faces.groups.listed", count / GROUP_ITEMS);
    return lists;
}

void addFit(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    hash_grid::addFit(
        program, lists.grid,
        {particles.positions, particles.velocities, particles.step, sleep::weightsOf(particles)});
}

void addListCheck(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    const hash_grid::Moved moved{particles.positions, particles.velocities, particles.step};
    sheet_patches::addCheck(program, lists.patches, lists.grid, moved);
    hash_grid::addListCheckOfMembers(program, lists.grid, moved);
    hash_grid::addCells(program, lists.grid, particles.positions, moved, lists.points);
}

void addLists(ProgramBuilder& program, const Lists& lists, const ParticleBuffers& particles) {
    const hash_grid::Grid& grid = lists.grid;
    std::vector<BufferId> parting{particles.velocities, lists.radii, lists.points, grid.headings,
                                  particles.step};
    const std::vector<BufferId> keeping = pooled_lists::keepingBuffers(lists.pooled);
    parting.insert(parting.end(), keeping.begin(), keeping.end());
    parting.insert(parting.end(), {grid.bounds, lists.pooled.links->ranges});
    program.dispatchIndirect(k::listLargePoints, grid.particles, parting, lists.push,
                             {{hasHeadingsId, grid.push.ahead > 0}, {limitsMotionId, grid.push.ahead > 0}});
    sheet_patches::addSearch(program, lists.patches, lists.grid,
                             {particles.positions, particles.velocities, particles.step},
                             {lists.radii, lists.points, lists.push});
    std::vector<BufferId> buffers = searchBuffers(lists, particles);
    const bool hasLinks = lists.liveLinks != BufferId{};
    const bool hasHeadings = grid.push.ahead > 0;
    const ProgramBuilder::Constants constants{{hasLinksId, hasLinks}, {hasHeadingsId, hasHeadings}};
    buffers.insert(buffers.end(), {grid.sorted, grid.starts, lists.points, grid.headings, lists.searched,
                                   lists.inverseMasses});
    buffers.push_back(boundIf(hasLinks, lists.liveLinks));
    const bool hasWide = lists.push.large > 0 || lists.push.points > FACE_MOST_POINTS;
    ProgramBuilder::Constants searching = constants;
    searching[hasWideId] = hasWide;
    program.dispatchIndirect(k::findFaces, grid.searching, buffers, lists.push, searching);
    if (hasWide) {
        buffers = searchBuffers(lists, particles);
        buffers.insert(buffers.end(), {lists.large, lists.points, grid.headings, program.program().status,
                                       lists.inverseMasses});
        buffers.push_back(boundIf(hasLinks, lists.liveLinks));
        program.dispatchIndirect(k::findWideFaces, grid.particles, buffers, lists.push, constants);
    }
    pooled_lists::addPlan(program, grid, lists.points, lists.push, row_contacts::faces.constants());
    buffers = pooled_lists::sortingBuffers(program, lists.pooled, grid, lists.radii);
    buffers.insert(buffers.end(), {grid.touching.arguments, lists.marks, lists.touching, lists.faces,
                                   lists.pooled.links->owners});
    program.dispatchIndirect(k::sortFaces, grid.owners, buffers, lists.push);
    program.dispatchIndirect(k::indexRowsByOwner, grid.linked,
                             {lists.pooled.pairs, lists.pooled.links->chains, lists.pooled.contacts,
                              lists.pooled.ranges, lists.pooled.links->elements, lists.pooled.links->ranges,
                              grid.bounds, lists.faces, program.program().status, grid.touching.arguments,
                              lists.marks, lists.touching},
                             lists.push, row_contacts::faces.constants());
}

} // namespace sinew::sim::collision::face_lists
