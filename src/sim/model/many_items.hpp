// Dispatches in which an invocation may have several items (shaders/glsl/common/many_items.glsl): a software
// device pays for each invocation of a large kernel, even where it has nothing to do. Results are the same
// bits.
#pragma once

#include "common/layout.h"
#include "sim/program/program.hpp"

#include <algorithm>
#include <cstdint>

namespace sinew::sim::many_items {

/// Invocations for `items`, `each` of them one: whole work groups.
constexpr std::uint32_t invocationsFor(std::uint32_t items, std::uint32_t each) {
    if (each == 1) return items;
    const std::uint32_t ofGroup = GROUP_ITEMS * each;
    return (items + ofGroup - 1) / ofGroup * GROUP_ITEMS;
}

/// As many as `wanted`, but no more than have all turns of their loops in one invocation, `turns` each at
/// most: some devices end the loops of an invocation silently at 65,535 turns in all.
constexpr std::uint32_t fitting(std::uint32_t wanted, std::uint32_t turns) {
    constexpr std::uint32_t mostTurns = 65'535;
    return std::clamp(mostTurns / turns, 1u, std::max(wanted, 1u));
}

/// Constants of a kernel that has several.
inline ProgramBuilder::Constants constantsFor(std::uint32_t each) {
    constexpr std::uint32_t itemsEachId = 23; // constant_id in many_items.glsl
    return {{itemsEachId, each}};
}

} // namespace sinew::sim::many_items
