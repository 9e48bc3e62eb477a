// The buffers of lists and of the memory of contacts.
#include "sim/collision/pooled_lists.hpp"

#include "kernels.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>

namespace sinew::sim::collision::pooled_lists {

static_assert(ranges::mostContactRoom == CONTACT_MOST_ROOM);

namespace {

// A buffer of `count` elements with the given initial contents.
template <typename T>
BufferId bufferOf(ProgramBuilder& program, const std::string& name, std::size_t count,
                  std::vector<T> initial) {
    if (initial.empty()) return program.scratch<T>(name, count);
    initial.resize(count);
    return program.upload(name, initial);
}

std::vector<std::uint32_t> othersOf(const Initial& initial) {
    std::vector<std::uint32_t> others;
    for (const layout::ContactCandidate& contact : initial.contacts) others.push_back(contact.other);
    return others;
}

Memory addMemory(ProgramBuilder& program, const Request& request, std::size_t room) {
    const auto keptIn = [&](const std::string& suffix, const Initial& first) -> Kept {
        return {.ranges = bufferOf(program, request.name + ".lists" + suffix, request.owners, first.ranges),
                .memory = bufferOf(program, request.name + ".memory" + suffix, room, first.memory),
                .others = bufferOf(program, request.name + ".others" + suffix, room, othersOf(first))};
    };
    return {.memory = bufferOf(program, request.name + ".memory", room, request.initial.memory),
            .kept = keptIn(".kept", {}),
            .saved = keptIn(".saved", request.initial)};
}

} // namespace

Lists add(ProgramBuilder& program, const Request& request) {
    const std::string& name = request.name;
    const std::size_t room = request.owners * request.each, entriesOfPair = request.others > 0 ? 1 : 2;
    const std::size_t ofRows = request.others > 0 ? request.owners + request.others : 0;
    Lists lists{.room = static_cast<std::uint32_t>(room),
                .contacts = bufferOf(program, name + ".contacts", room, request.initial.contacts),
                .ranges = bufferOf(program, name + ".lists", request.owners, request.initial.ranges),
                .pairs = program.scratch<layout::vec4>(
                    name + ".pairs", room / entriesOfPair + (room + 3) / 4 + (ofRows + 3) / 4),
                .chains = program.scratch<std::uint32_t>(name + ".chains", request.owners)};
    if (request.others > 0)
        lists.links = {.elements = program.scratch<std::uint32_t>(name + ".links", room),
                       .ranges = program.scratch<layout::ListRange>(name + ".link_lists", request.others),
                       .chains = program.scratch<std::uint32_t>(name + ".link_chains", request.others),
                       .owners = program.scratch<std::uint32_t>(name + ".owners", room)};
    if (!request.hasMemory) return lists;
    lists.memory = addMemory(program, request, room);
    const Kept& saved = lists.memory->saved;
    program.program().contactMemory.push_back(
        {lists.contacts, lists.ranges, lists.memory->memory, saved.ranges, saved.memory, saved.others});
    for (const BufferId buffer :
         {lists.contacts, lists.ranges, lists.memory->memory, saved.ranges, saved.memory, saved.others})
        program.addToState(buffer, buffer);
    return lists;
}

std::vector<BufferId> keepingBuffers(const Lists& lists) {
    const Memory& memory = *lists.memory;
    return {lists.contacts,     lists.ranges,       memory.memory,
            memory.kept.memory, memory.kept.others, memory.kept.ranges};
}

void addPlan(ProgramBuilder& program, const hash_grid::Grid& grid, BufferId points,
             const layout::FaceFindPush& push, const ProgramBuilder::Constants& kind) {
    program.dispatchIndirect(
        kernels::planRows, grid.oneGroup,
        {points, grid.bounds, program.program().status, grid.owners.arguments, grid.touching.arguments}, push,
        kind);
}

std::vector<BufferId> sortingBuffers(ProgramBuilder& program, const Lists& lists, const hash_grid::Grid& grid,
                                     BufferId radii) {
    const Memory none{.memory = unbound, .kept = {unbound, unbound, unbound}, .saved = {}};
    const Memory& memory = lists.memory ? *lists.memory : none;
    return {lists.pairs,        lists.chains,      radii,
            lists.contacts,     lists.ranges,      program.program().status,
            grid.bounds,        memory.memory,     memory.kept.memory,
            memory.kept.others, memory.kept.ranges};
}

void addPublishing(ProgramBuilder& program, const Lists& lists, const hash_grid::Grid& grid) {
    const bool hasMemory = lists.memory.has_value();
    const Kept none{unbound, unbound, unbound};
    const Kept& saved = hasMemory ? lists.memory->saved : none;
    const std::vector<BufferId> buffers{program.program().status,
                                        grid.detected,
                                        grid.bounds,
                                        boundIf(hasMemory, lists.contacts),
                                        boundIf(hasMemory, lists.ranges),
                                        hasMemory ? lists.memory->memory : unbound,
                                        saved.memory,
                                        saved.others,
                                        saved.ranges};
    constexpr std::uint32_t hasMemoryId = 1; // constant_id in publish_lists.comp
    const std::uint32_t items = std::max(grid.push.count, grid.touchingParticles.most);
    program.dispatch(kernels::publishLists, items, buffers, layout::CountPush{grid.push.count},
                     {{hasMemoryId, hasMemory}});
    // While everything sleeps no pass plans the number of groups, and lists must not be made again.
    if (program.program().sleep.arguments == BufferId{}) return;
    program.fill(grid.arguments, 0);
    if (grid.owners.arguments != unbound) program.fill(grid.owners.arguments, 0);
}

IndirectItems entriesInUse(const Lists& lists, const hash_grid::Grid& grid) {
    return {grid.touching.arguments, 2, std::min<std::uint32_t>(lists.room, ROWS_MOST_GROUPS * GROUP_ITEMS)};
}

} // namespace sinew::sim::collision::pooled_lists
