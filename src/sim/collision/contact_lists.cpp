// The host side of contact lists: large particles, and the order of the passes.
#include "sim/collision/contact_lists.hpp"

#include "common/rest_slack.h"
#include "common/share_band.h"
#include "kernels.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace sinew::sim::collision::contact_lists {

namespace {

constexpr std::uint32_t hasOneRadiusId = 1, hasExclusionsId = 2; // constant_id in find_contacts.comp

// Each of two particles may use half of the margin; slightly less, because of rounding.
constexpr float slackShare = 0.49f;

std::vector<std::uint32_t> slotsAbove(std::span<const float> radii, float most) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < radii.size(); ++i)
        if (radii[i] > most) slots.push_back(i);
    return slots;
}

// Largest motion in a substep for which two particles cannot pass through each other (meetingOf in
// contacts.glsl: reach / 4 together), and are in each other's lists after it.
float quietWay(const Request& request) {
    float least = std::numeric_limits<float>::max();
    for (const float radius : request.radii)
        if (radius >= 0) least = std::min(least, radius);
    return std::min(0.25f * least, slackShare * request.margin);
}

float largestOf(std::span<const float> radii) {
    return radii.empty() ? 0.0f : std::max(0.0f, *std::ranges::max_element(radii));
}

bool hasOneRadius(std::span<const float> radii) {
    float only = -1;
    for (const float radius : radii) {
        if (radius < 0) continue;
        if (only >= 0 && radius != only) return false;
        only = radius;
    }
    return true;
}

namespace k = kernels;

void addSorting(ProgramBuilder& program, const Lists& lists) {
    const hash_grid::Grid& grid = lists.grid;
    std::vector<BufferId> buffers = pooled_lists::sortingBuffers(program, lists.pooled, grid, grid.radii);
    const bool hasMemory = lists.pooled.memory.has_value(), listsOwners = lists.touching != BufferId{};
    buffers.insert(buffers.end(),
                   {boundIf(hasMemory, lists.hits), boundIf(listsOwners, grid.touching.arguments),
                    boundIf(listsOwners, lists.touching)});
    constexpr std::uint32_t hasMemoryId = 1, listsOwnersId = 2; // constant_ids in sort_lists.comp
    hash_grid::addOverParticles(program, grid, k::sortLists, buffers, lists.push,
                                {{hasMemoryId, hasMemory}, {listsOwnersId, listsOwners}});
}

} // namespace

Lists add(ProgramBuilder& program, const Request& request) {
    const std::size_t count = request.radii.size();
    const float margin = request.margin + (request.isKept ? 3 * REST_SLACK * largestOf(request.radii) : 0);
    constexpr float wide = 2 * (1 + SHARE_BAND); // pairs count in shares up to this many mean radii
    const float most = hash_grid::largestInGrid(request.radii);
    const float quietMost = hash_grid::largestUpTo(request.radii, most);
    Lists lists{.grid = hash_grid::add(program, {.radii = request.radii,
                                                 .slots = program.slots(),
                                                 .margin = request.margin,
                                                 .edge = wide * most + margin,
                                                 .quietEdge = wide * quietMost + margin,
                                                 .quiet = quietWay(request),
                                                 .bodies = request.bodies,
                                                 .reach = wide * largestOf(request.radii),
                                                 .hasWays = request.hasWays,
                                                 .substeps = request.substeps}),
                .quietMost = quietMost,
                .hasOneRadius = hasOneRadius(request.radii)};
    const std::vector<std::uint32_t> large = slotsAbove(request.radii, lists.grid.push.most);
    lists.push = {.count = lists.grid.push.count,
                  .cells = lists.grid.push.cells,
                  .most = lists.grid.push.most,
                  .margin = margin,
                  .large = static_cast<std::uint32_t>(large.size()),
                  .quiet = lists.grid.push.quiet};
    lists.pooled = pooled_lists::add(program, {.name = "pairs",
                                               .owners = count,
                                               .each = request.capacity,
                                               .hasMemory = request.hasMemory,
                                               .initial = request.initial});
    lists.push.room = lists.pooled.room;
    lists.hits =
        program.scratch<std::array<std::uint32_t, 2>>("pairs.hits", count + lists.push.room / 32 + 1);
    lists.large = program.upload("contacts.large", large);
    if (request.listsOwners) lists.touching = program.scratch<std::uint32_t>("contacts.owners", count);
    if (!request.exclusions.empty()) lists.excluded = program.upload("contacts.excluded", request.exclusions);
    return lists;
}

void addBuild(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved, bool isLast) {
    hash_grid::addBuild(program, lists.grid, moved, isLast);
}

void addUpdate(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved) {
    hash_grid::addListCheck(program, lists.grid, moved);
    addBuild(program, lists, moved);
    addLists(program, lists, moved);
}

void addLists(ProgramBuilder& program, const Lists& lists, const hash_grid::Moved& moved) {
    const hash_grid::Grid& grid = lists.grid;
    const pooled_lists::Lists& pooled = lists.pooled;
    if (pooled.memory)
        hash_grid::addOverParticles(program, grid, k::saveContactMemory, pooled_lists::keepingBuffers(pooled),
                                    layout::CountPush{grid.push.count});
    std::vector<BufferId> buffers{grid.sorted, grid.starts,   moved.positions, grid.radii,
                                  grid.bounds, pooled.chains, pooled.pairs,    lists.large};
    const bool hasExclusions = lists.excluded != BufferId{};
    buffers.insert(buffers.end(), {boundIf(hasExclusions, lists.excluded), moved.velocities, grid.fast,
                                   moved.step, grid.ways});
    ProgramBuilder::Constants constants = grid.wayConstants();
    constants.insert({{hasOneRadiusId, lists.hasOneRadius}, {hasExclusionsId, hasExclusions}});
    layout::FindPush quiet = lists.push;
    quiet.most = lists.quietMost;
    program.dispatchIndirect(k::findContacts, grid.unswept, buffers, quiet, constants);
    program.dispatchIndirect(k::findContactsSwept, grid.swept, buffers, lists.push, constants);
    addSorting(program, lists);
}

} // namespace sinew::sim::collision::contact_lists
