// The host side of the hash grid: sizes and the order of its passes.
#include "sim/collision/hash_grid.hpp"

#include "kernels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

namespace sinew::sim::collision::hash_grid {

namespace {

constexpr std::uint32_t listsTouchedId = 5, hasRowsId = 6; // constant_id in plan_grid.comp
constexpr std::uint32_t hasHeadingsId = 1; // constant_id in count_cells.comp and check_surface_lists.comp

// Slots of the table: with twice as many as particles, rows rarely share slots unless the grid is dense.
// scan_sums needs whole groups of chunks.
std::uint32_t cellsFor(std::size_t particles) {
    constexpr std::uint32_t fewest = GRID_CHUNK * GROUP_ITEMS;
    return std::max(fewest, std::bit_ceil(static_cast<std::uint32_t>(2 * particles)));
}

// Push constants of kernels that depend on the substep.
layout::GridPush pushOf(const ProgramBuilder& program, const Grid& grid) {
    layout::GridPush push = grid.push;
    push.isLater = program.isAfterFirstSubstep() ? 1 : 0;
    return push;
}

void addPlan(ProgramBuilder& program, const Grid& grid, BufferId step, bool isLast = true) {
    layout::GridPush push = pushOf(program, grid);
    if (!isLast) push.bodies = 0; // frames advance once a substep
    program.dispatch(
        kernels::planGrid, GROUP_ITEMS,
        {grid.bounds, grid.arguments, grid.frames.frames, step, grid.touching.arguments,
         program.program().status, grid.touched.points, grid.touched.arguments, grid.touched.lists,
         grid.owners.arguments},
        push, {{listsTouchedId, grid.touched.slots > 0}, {hasRowsId, grid.owners.arguments != unbound}});
}

// Velocities change too much after that for lists to last longer.
constexpr float substepsAhead = 8;

// Two bodies are in lists of their own only while no particle can leave its body's box (fit_frames), which
// limits headings. Those of a body alone are limited to a third of a cell until the horizon, so that its
// points stay in the grid. Items other than particles (edges) have no leeway.
void addHeadings(ProgramBuilder& program, Grid& grid, const Request& request) {
    const std::size_t count = request.particles > 0 ? request.particles : request.radii.size();
    grid.headings = program.scratch<layout::vec4>(std::string(request.name) + ".headings", count);
    const bool isAlone = grid.frames.push.bodies == 1;
    grid.push.ahead = substepsAhead;
    grid.push.pace = std::max(0.5f * request.margin, isAlone ? grid.push.edge / (3 * substepsAhead) : 0.0f);
    if (request.particles == 0) grid.push.leeway = 3 * request.margin;
    layout::FramePush& frames = grid.frames.push;
    frames.ahead = grid.push.ahead;
    frames.pace = grid.push.pace;
    frames.leeway = grid.push.leeway;
}

} // namespace

float largestInGrid(std::span<const float> radii) {
    std::vector<float> sorted;
    for (const float radius : radii)
        if (radius >= 0) sorted.push_back(radius);
    if (sorted.empty()) return 0;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t last = sorted.size() - 1;
    const float most = 2 * sorted[sorted.size() / 2];
    return std::max(most, sorted[last - std::min(last, mostLarge)]);
}

float largestUpTo(std::span<const float> radii, float most) {
    float largest = 0;
    for (const float radius : radii)
        if (radius <= most) largest = std::max(largest, radius);
    return largest;
}

Grid add(ProgramBuilder& program, const Request& request) {
    const std::size_t count = request.radii.size();
    const std::uint32_t cells = cellsFor(count);
    const float most = largestInGrid(request.radii);
    const float edge = std::max(2 * most + request.margin, request.edge);
    // Initial positions so far away that the first check finds every particle strayed.
    std::vector<layout::vec4> nowhere(request.particles > 0 ? request.particles : count,
                                      {1e18f, 1e18f, 1e18f, 0});
    const std::span<const float> checked = request.watched.empty() ? request.radii : request.watched;
    for (std::size_t i = 0; request.particles == 0 && i < count; ++i)
        if (checked[i] < 0) nowhere[i].w = FRAME_NONE; // a build may not visit it
    const std::string name = request.name;
    Grid grid{
        .push = {.count = static_cast<std::uint32_t>(count),
                 .items = request.slots.items > 0 ? request.slots.items : static_cast<std::uint32_t>(count),
                 .cells = cells,
                 .edge = edge,
                 .quietEdge = request.quietEdge > 0 ? request.quietEdge : edge,
                 .most = most,
                 .others = request.others,
                 .quiet = std::max(request.quiet, 0.0f)},
        .radii = program.upload(request.radiiName, request.radii),
        .bounds = program.scratch<layout::GridBounds>(name + ".bounds", 1),
        .arguments = program.scratch<layout::DispatchArguments>(name + ".arguments", GRID_ARGUMENTS),
        .counts = program.scratch<std::uint32_t>(name + ".counts", cells),
        .sums = program.scratch<std::uint32_t>(name + ".sums", cells / GRID_CHUNK + 1),
        .starts = program.scratch<std::uint32_t>(name + ".starts", cells + 4),
        .places = program.scratch<std::array<std::uint32_t, 2>>(name + ".places", count),
        .sorted = program.scratch<layout::vec4>(name + ".sorted", count),
        .detected = program.upload(name + ".detected", nowhere),
        .slots = request.slots};
    grid.particles = {grid.arguments, GRID_PARTICLES, grid.push.items, true};
    grid.particleChunks = {grid.arguments, GRID_PARTICLE_CHUNKS, (grid.push.count - 1) / GRID_CHUNK + 1,
                           true};
    grid.cellChunks = {grid.arguments, GRID_CELL_CHUNKS, cells / GRID_CHUNK, true};
    grid.oneGroup = {grid.arguments, GRID_ONE_GROUP, GROUP_ITEMS, true};
    grid.others = {grid.arguments, GRID_OTHERS, request.others, true};
    const BufferId making =
        request.linked > 0 ? program.scratch<layout::DispatchArguments>(name + ".making", MAKING_ARGUMENTS)
                           : unbound;
    grid.searching = {making, MAKING_FACES, request.searching, true};
    grid.owners = {making, MAKING_OWNERS, grid.push.count, true};
    grid.linked = {making, MAKING_LINKS, std::max(grid.push.count, request.linked), true};
    grid.swept = {grid.arguments, GRID_SWEPT, grid.push.items, true};
    grid.unswept = {grid.arguments, GRID_UNSWEPT, grid.push.items, true};
    const BufferId touching = program.scratch<layout::DispatchArguments>(name + ".touching", 3);
    grid.touching = {touching, 0, grid.push.count};
    grid.touchingParticles = {touching, 1, static_cast<std::uint32_t>(std::max(count, request.particles))};
    grid.watched =
        request.watched.empty() ? grid.radii : program.upload(name + ".watched_radii", request.watched);
    grid.slowed = {grid.arguments, GRID_SLOWED, grid.push.count, true};
    const body_frames::Request frames{.radii = request.watched.empty() ? request.radii : request.watched,
                                      .reach = request.reach,
                                      .margin = request.margin,
                                      .substeps = request.substeps,
                                      .name = request.name};
    grid.frames = request.bodies ? body_frames::add(program, *request.bodies, frames)
                                 : body_frames::addStanding(program, frames);
    grid.counted = {grid.detected, grid.frames.ofSlots, grid.watched};
    if (request.particles > 0)
        grid.counted = {program.scratch<layout::vec4>(name + ".placed", count), grid.radii, grid.radii};
    grid.push.bodies = grid.frames.push.bodies;
    grid.push.reach = request.reach;
    grid.push.margin = request.margin;
    grid.headings = unbound;
    if (request.hasHeadings) addHeadings(program, grid, request);
    if (request.quiet >= 0)
        grid.fast = program.scratch<std::uint32_t>(name + ".fast", MOST_FAST + MOST_SWEEPERS);
    grid.ways = request.hasWays ? program.scratch<float>(name + ".ways", count) : unbound;
    program.program().grids.push_back({.name = name,
                                       .bounds = grid.bounds,
                                       .starts = grid.starts,
                                       .sorted = grid.sorted,
                                       .count = grid.push.count,
                                       .cells = cells,
                                       .detected = grid.detected,
                                       .radii = grid.radii,
                                       .touching = {},
                                       .watched = grid.watched});
    return grid;
}

void addListCheck(ProgramBuilder& program, const Grid& grid, const Moved& moved) {
    namespace k = kernels;
    program.dispatch(k::checkPairLists, grid.push.count,
                     {moved.positions, grid.detected, moved.velocities, grid.bounds, grid.radii, grid.fast,
                      moved.step, grid.frames.frames, grid.ways,
                      boundIf(grid.ways != unbound, grid.frames.ofSlots)},
                     grid.push, grid.checkConstants());
}

void addBuild(ProgramBuilder& program, const Grid& grid, const Moved& moved, bool isLast) {
    addPlan(program, grid, moved.step, isLast);
    program.dispatchIndirect(kernels::clampSpeeds, grid.slowed,
                             {moved.positions, moved.velocities, grid.radii, program.program().status,
                              moved.step, grid.ways, grid.bounds},
                             grid.push, grid.wayConstants());
    addCells(program, grid, moved.positions, moved);
}

void addFit(ProgramBuilder& program, const Grid& grid, const Moved& moved) {
    body_frames::addFit(program, grid.frames,
                        {moved.positions, moved.velocities, grid.detected, grid.headings, grid.watched,
                         grid.bounds, moved.step, moved.weights, moved.groups});
}

void addListCheckOfMembers(ProgramBuilder& program, const Grid& grid, const Moved& moved) {
    layout::GridPush push = pushOf(program, grid);
    push.count = grid.frames.memberCount;
    ProgramBuilder::Constants constants = grid.frames.constants();
    constants.insert({hasHeadingsId, grid.push.ahead > 0});
    program.dispatch(kernels::checkSurfaceLists, push.count,
                     {moved.positions, moved.velocities, grid.detected, grid.bounds, moved.step,
                      grid.frames.frames, grid.headings, grid.frames.members},
                     push, constants);
    addPlan(program, grid, moved.step);
}

void addCells(ProgramBuilder& program, const Grid& grid, BufferId positions, const Moved& moved,
              BufferId points) {
    namespace k = kernels;
    const bool hasHeadings = grid.push.ahead > 0 && positions == moved.positions;
    program.dispatchIndirect(k::measureBounds, grid.particleChunks, {positions, grid.radii, grid.bounds},
                             grid.push);
    addOverParticles(program, grid, k::countCells,
                     {positions, grid.radii, grid.bounds, grid.counts, grid.places, grid.counted[0],
                      grid.counted[1], grid.counted[2], boundIf(hasHeadings, grid.headings),
                      boundIf(hasHeadings, moved.velocities), boundIf(hasHeadings, grid.frames.frames),
                      moved.step, boundIf(hasHeadings, points)},
                     grid.push, {{hasHeadingsId, hasHeadings}});
    program.dispatchIndirect(k::sumCells, grid.cellChunks, {grid.counts, grid.sums}, grid.push);
    program.dispatchIndirect(k::scanSums, grid.oneGroup, {grid.sums}, grid.push);
    program.dispatchIndirect(k::startCells, grid.cellChunks, {grid.counts, grid.sums, grid.starts},
                             grid.push);
    addOverParticles(program, grid, k::fillCells, {positions, grid.places, grid.starts, grid.sorted},
                     grid.push);
}

} // namespace sinew::sim::collision::hash_grid
