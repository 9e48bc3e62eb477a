// Counts are padded to whole work groups.
#include "sim/model/state.hpp"

#include "common/layout.h"

#include <algorithm>

namespace sinew::sim {

std::size_t paddedCount(std::size_t particles) {
    return (particles + GROUP_ITEMS - 1) / GROUP_ITEMS * GROUP_ITEMS;
}

StateLayout orderedLayout(std::size_t particles) {
    StateLayout layout{.count = paddedCount(particles)};
    for (std::uint32_t i = 0; i < particles; ++i) layout.slot.push_back(i);
    return layout;
}

std::vector<std::uint32_t> slotsInOrder(const StateLayout& layout) {
    std::vector<std::uint32_t> slots = layout.slot;
    std::ranges::sort(slots);
    return slots;
}

std::vector<std::uint32_t> compactSlots(const StateLayout& layout) {
    std::vector<std::uint32_t> slots = slotsInOrder(layout);
    const std::size_t size = paddedCount(slots.size());
    if (4 * size > 3 * layout.count) return {};
    std::vector<bool> holds(layout.count, false);
    for (const std::uint32_t slot : slots) holds[slot] = true;
    for (std::uint32_t slot = 0; slots.size() < size; ++slot)
        if (!holds[slot]) slots.push_back(slot);
    return slots;
}

std::vector<std::uint32_t> bodiesOfSlots(const Scene& scene, const StateLayout& layout, std::uint32_t none) {
    std::vector<std::uint32_t> bodies(layout.count, none);
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
        for (std::uint32_t i = 0; i < scene.bodies[b].particleCount; ++i)
            bodies[layout.slot[scene.bodies[b].firstParticle + i]] = b;
    return bodies;
}

std::size_t positionCount(const StateLayout& layout) {
    return layout.hasRemainders ? 2 * layout.count : layout.count;
}

ProgramBuilder::Constants remainderConstants(const StateLayout& layout) {
    constexpr std::uint32_t hasRemaindersId = 10; // constant_id in remainder.glsl
    if (!layout.hasRemainders) return {};
    return {{hasRemaindersId, 1}};
}

ProgramBuilder::Constants receivedConstants(const ParticleBuffers& particles) {
    constexpr std::uint32_t receivedSlotsId = 23; // constant_id in received.glsl
    const bool keeps = particles.received != unbound;
    return {{receivedSlotsId, keeps ? static_cast<std::uint32_t>(particles.layout.count) : 0}};
}

} // namespace sinew::sim
