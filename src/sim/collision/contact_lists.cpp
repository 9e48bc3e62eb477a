// The host side of contact lists: large particles, and the order of the passes.
#include "sim/collision/contact_lists.hpp"

#include "kernels.hpp"

#include <algorithm>

namespace sinew::sim::collision::contact_lists {

namespace {

constexpr std::uint32_t hasOneRadiusId = 1; // constant_id in find_contacts.comp

// Half of the margin is what two particles may come nearer by each; a little less for rounding.
constexpr float slackShare = 0.49f;

std::vector<std::uint32_t> slotsAbove(std::span<const float> radii, float most) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < radii.size(); ++i)
        if (radii[i] > most) slots.push_back(i);
    return slots;
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

const vk::ShaderCode& findingKernel(const Lists& lists) {
    const bool usesTexels = lists.grid.usesTexels, hasExclusions = lists.excluded != BufferId{};
    if (usesTexels) return hasExclusions ? kernels::findContactsExclusions : kernels::findContacts;
    return hasExclusions ? kernels::findContactsExclusionsLoads : kernels::findContactsLoads;
}

} // namespace

std::uint32_t rowOf(std::size_t slots) {
    return static_cast<std::uint32_t>(slots) + CONTACT_ROW_EXTRA;
}

Lists add(ProgramBuilder& program, const Request& request) {
    const std::size_t count = request.radii.size();
    Lists lists{.grid = hash_grid::add(program, {.radii = request.radii,
                                                 .margin = request.margin,
                                                 .slack = slackShare * request.margin,
                                                 .usesTexels = request.usesTexels}),
                .hasOneRadius = hasOneRadius(request.radii)};
    const std::vector<std::uint32_t> large = slotsAbove(request.radii, lists.grid.push.most);
    lists.push = {.count = lists.grid.push.count,
                  .cells = lists.grid.push.cells,
                  .edge = lists.grid.push.edge,
                  .most = lists.grid.push.most,
                  .margin = request.margin,
                  .capacity = request.capacity,
                  .row = rowOf(count),
                  .limit = request.limit,
                  .large = static_cast<std::uint32_t>(large.size())};
    const std::size_t elements = request.capacity * std::size_t{lists.push.row};
    lists.contacts = request.contacts.empty()
                         ? program.scratch<layout::ContactCandidate>("contacts", elements)
                         : program.upload("contacts", request.contacts);
    lists.counts = request.counts.empty() ? program.scratch<std::uint32_t>("contacts.counts", count)
                                          : program.upload("contacts.counts", request.counts);
    lists.found = program.scratch<std::uint32_t>("contacts.found", count);
    lists.candidates = program.scratch<std::uint32_t>("contacts.candidates", elements);
    lists.large = program.upload("contacts.large", large);
    if (!request.exclusions.empty()) lists.excluded = program.upload("contacts.excluded", request.exclusions);
    return lists;
}

void addWatch(ProgramBuilder& program, const Lists& lists, BufferId positions) {
    hash_grid::addBuild(program, lists.grid, positions);
}

void addUpdate(ProgramBuilder& program, const Lists& lists, BufferId positions) {
    addWatch(program, lists, positions);
    addLists(program, lists, positions);
}

void addLists(ProgramBuilder& program, const Lists& lists, BufferId positions) {
    const hash_grid::Grid& grid = lists.grid;
    std::vector<BufferId> buffers{grid.sorted, grid.starts, positions,        grid.radii,
                                  grid.bounds, lists.found, lists.candidates, lists.large};
    if (lists.excluded != BufferId{}) buffers.push_back(lists.excluded);
    program.dispatchIndirect(findingKernel(lists), grid.particles, buffers, lists.push,
                             {{hasOneRadiusId, lists.hasOneRadius}});
    program.dispatchIndirect(
        grid.usesTexels ? kernels::sortContacts : kernels::sortContactsLoads, grid.particles,
        {lists.candidates, grid.radii, lists.found, lists.contacts, lists.counts, program.program().status},
        lists.push);
}

} // namespace sinew::sim::collision::contact_lists
