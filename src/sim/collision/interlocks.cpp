// The host side: pairs of interlocked bodies, data of their lattices, and the order of the passes.
#include "sim/collision/interlocks.hpp"

#include "kernels.hpp"
#include "sim/forces/forces.hpp"
#include "sim/lattice/depths.hpp"
#include "sim/lattice/placement.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace sinew::sim::collision::interlocks {

namespace {

namespace k = kernels;

using BodyPair = std::array<std::uint32_t, 2>; // the smallest particle of each, ascending

// By slot: the smallest particle of the linked body, and whether filled cells surround it.
struct Places {
    std::vector<std::uint32_t> body;
    std::vector<bool> isInside;
};

Places placesOf(const Scene& scene, const StateLayout& layout, std::span<const std::uint32_t> bodies) {
    Places places{std::vector<std::uint32_t>(layout.count), std::vector<bool>(layout.count)};
    for (std::size_t i = 0; i < bodies.size(); ++i) places.body[layout.slot[i]] = bodies[i];
    for (const Grid& grid : scene.grids) {
        if (lattice::isSheet(grid)) continue;
        for (std::size_t n = 0; n < grid.node.size(); ++n) {
            const auto at = lattice::coordinates(grid, grid.node[n]);
            places.isInside[layout.slot[grid.firstParticle + n]] =
                lattice::isInside(lattice::fillAround(grid, at));
        }
    }
    return places;
}

std::set<BodyPair> pairsOf(const Places& places, const overlaps::Overlaps& overlaps) {
    std::set<BodyPair> pairs;
    for (std::size_t i = 0; i < overlaps.size(); ++i)
        for (const overlaps::Overlap& overlap : overlaps[i]) {
            if (overlap.isKept) continue;
            const std::uint32_t a = places.body[i], b = places.body[overlap.other];
            if (a != b && (places.isInside[i] || places.isInside[overlap.other]))
                pairs.insert({std::min(a, b), std::max(a, b)});
        }
    return pairs;
}

// Numbers of the bodies in pairs, from 1 on.
std::map<std::uint32_t, std::uint32_t> numbersOf(const std::set<BodyPair>& pairs) {
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const BodyPair& pair : pairs)
        for (const std::uint32_t body : pair) numbers[body] = 0;
    std::uint32_t next = 0;
    for (auto& [body, number] : numbers) number = ++next;
    return numbers;
}

std::vector<std::uint32_t> partnersOf(const std::set<BodyPair>& pairs,
                                      const std::map<std::uint32_t, std::uint32_t>& numbers) {
    std::vector<std::vector<std::uint32_t>> ofBodies(numbers.size());
    std::uint32_t index = 0;
    for (const auto& [a, b] : pairs) {
        const std::uint32_t first = numbers.at(a), second = numbers.at(b);
        ofBodies[first - 1].insert(ofBodies[first - 1].end(), {second, index});
        ofBodies[second - 1].insert(ofBodies[second - 1].end(), {first, index});
        ++index;
    }
    std::vector<std::uint32_t> partners{static_cast<std::uint32_t>(numbers.size() + 1)};
    for (const auto& list : ofBodies)
        partners.push_back(partners.back() + static_cast<std::uint32_t>(list.size()));
    for (const auto& list : ofBodies) partners.insert(partners.end(), list.begin(), list.end());
    return partners;
}

// The neighbours of a node along an axis; the node itself on a side without a filled cell.
std::array<std::uint32_t, 2> alongAxis(const Grid& grid, const std::array<std::uint32_t, 3>& at,
                                       std::uint32_t axis, std::span<const std::uint32_t> slotOfNode) {
    const std::uint32_t word = lattice::fillAround(grid, at);
    const std::array<std::uint32_t, 3> stride{1, grid.nodes[0], grid.nodes[0] * grid.nodes[1]};
    const std::uint32_t node = at[0] + stride[1] * at[1] + stride[2] * at[2];
    std::array<std::uint32_t, 2> slots{slotOfNode[node], slotOfNode[node]};
    for (std::uint32_t cell = 0; cell < 8; ++cell) {
        if ((word >> 4 * cell & 15) == 0) continue;
        const bool isAfter = (cell >> axis & 1) != 0;
        slots[isAfter ? 1 : 0] = slotOfNode[isAfter ? node + stride[axis] : node - stride[axis]];
    }
    return slots;
}

void addGrid(const Grid& grid, const StateLayout& layout, Plan& plan) {
    std::vector<std::uint32_t> slotOfNode(std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2]);
    for (std::size_t n = 0; n < grid.node.size(); ++n)
        slotOfNode[grid.node[n]] = layout.slot[grid.firstParticle + n];
    const std::vector<lattice::NodeDepth> depths = lattice::depthsOf(grid);
    for (std::size_t n = 0; n < grid.node.size(); ++n) {
        const std::uint32_t slot = layout.slot[grid.firstParticle + n];
        const auto& [depth, outward] = depths[n];
        const bool leadsOut = outward.x != 0 || outward.y != 0 || outward.z != 0;
        plan.depths[slot] = {outward.x, outward.y, outward.z, leadsOut ? depth : INTERLOCK_DEEPEST};
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const auto [before, after] =
                alongAxis(grid, lattice::coordinates(grid, grid.node[n]), axis, slotOfNode);
            plan.nodes[slot].before[axis] = before;
            plan.nodes[slot].after[axis] = after;
        }
    }
}

// The first buffers of both passes over contacts.
std::vector<BufferId> sharedBuffers(const Interlocks& interlocks, const Shared& shared, BufferId step) {
    return {shared.lists.pooled.contacts, shared.lists.pooled.ranges, interlocks.normals, interlocks.nodes,
            interlocks.partners,          interlocks.pairs,           shared.touching,    step};
}

} // namespace

Plan find(const Scene& scene, const StateLayout& layout, std::span<const std::uint32_t> bodies,
          const overlaps::Overlaps& overlaps) {
    if (overlaps.empty()) return {};
    const Places places = placesOf(scene, layout, bodies);
    const std::set<BodyPair> pairs = pairsOf(places, overlaps);
    if (pairs.empty()) return {};
    const std::map<std::uint32_t, std::uint32_t> numbers = numbersOf(pairs);
    Plan plan{std::vector<layout::InterlockNode>(layout.count),
              std::vector<layout::vec4>(layout.count, {0, 0, 0, INTERLOCK_DEEPEST}),
              partnersOf(pairs, numbers),
              static_cast<std::uint32_t>(pairs.size()),
              {pairs.begin(), pairs.end()}};
    const auto numberOf = [&](std::uint32_t slot) {
        const auto found = numbers.find(places.body[slot]);
        return found == numbers.end() ? 0u : found->second;
    };
    for (const Grid& grid : scene.grids)
        if (!lattice::isSheet(grid) && numberOf(layout.slot[grid.firstParticle]) != 0)
            addGrid(grid, layout, plan);
    for (const std::uint32_t slot : layout.slot) plan.nodes[slot].body = numberOf(slot);
    return plan;
}

std::optional<Interlocks> add(ProgramBuilder& program, const Plan& plan, std::size_t slots,
                              float recoverySpeed) {
    if (plan.pairs == 0) return std::nullopt;
    Interlocks interlocks;
    interlocks.push.count = static_cast<std::uint32_t>(slots);
    interlocks.push.recoverySpeed = recoverySpeed;
    interlocks.push.pairs = plan.pairs;
    interlocks.nodes = program.upload("interlocks.nodes", plan.nodes);
    interlocks.depths = program.upload("interlocks.depths", plan.depths);
    interlocks.partners = program.upload("interlocks.partners", plan.partners);
    interlocks.normals = program.scratch<layout::vec4>("interlocks.normals", slots);
    interlocks.moving = program.scratch<layout::vec4>("interlocks.moving", slots);
    interlocks.pairs = program.upload("interlocks.pairs",
                                      std::vector<layout::InterlockPair>(plan.pairs, {INTERLOCK_PARTING, 0}));
    const layout::DispatchArguments all{interlocks.push.count / GROUP_ITEMS, 1, 1, 0};
    interlocks.arguments = program.upload("interlocks.arguments", std::vector{all});
    program.program().interlocks = plan.bodies;
    program.addToState(interlocks.pairs, interlocks.pairs, {.of = Elements::interlocks});
    program.addToState(interlocks.arguments, interlocks.arguments);
    return interlocks;
}

void addPasses(ProgramBuilder& program, const Interlocks& interlocks, const Shared& shared,
               const ParticleBuffers& predicted) {
    const IndirectItems items{interlocks.arguments, 0, interlocks.push.count};
    program.dispatchIndirect(k::rotateOutwardNormals, items,
                             {predicted.positions, interlocks.nodes, interlocks.depths, interlocks.normals},
                             interlocks.push);
    std::vector<BufferId> buffers = sharedBuffers(interlocks, shared, predicted.step);
    buffers.insert(buffers.end(),
                   {predicted.positions, predicted.velocities, interlocks.moving, shared.slips});
    program.dispatchIndirect(k::countInterlocked, items, buffers, interlocks.push);
    buffers = sharedBuffers(interlocks, shared, predicted.step);
    buffers.insert(buffers.end(), {interlocks.moving, predicted.positions, predicted.velocities});
    ProgramBuilder::Constants constants;
    forces::bindTo(predicted, &forces::Forces::ofContacts, buffers, constants);
    program.dispatchIndirect(k::separateInterlocked, items, buffers, interlocks.push, constants);
}

void addClosing(ProgramBuilder& program, const Interlocks& interlocks) {
    program.dispatch(k::updateInterlocks, GROUP_ITEMS,
                     {program.program().status, interlocks.pairs, interlocks.arguments}, interlocks.push);
}

} // namespace sinew::sim::collision::interlocks
