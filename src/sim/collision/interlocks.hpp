// Bodies that lie in each other when a scene is loaded, so deep that particles inside a lattice touch others
// (contacts: 3, hard case 14). The lines between particles then lead anywhere, and lattices lock for ever.
// Such a pair of bodies parts along the normals of the lattices instead, which turn with them, and every
// contact between the two pushes at a limited speed, until nothing of them lies deeper than a tenth of a
// radius in the other. A scene without such bodies has none of this.
#pragma once

#include "sim/collision/contact_lists.hpp"
#include "sim/collision/overlaps.hpp"
#include "sim/compile.hpp"

#include <optional>
#include <vector>

namespace sinew::sim::collision::interlocks {

/// Of each slot; bodies are linked bodies, numbered from 1 on. Empty where nothing interlocks.
struct Plan {
    std::vector<layout::InterlockNode> nodes;
    std::vector<layout::vec4> depths; ///< which way is out, along the axes of the grid; how deep [m]
    /// Where the partners of each body begin, and one more for the end; then the partner and the pair of
    /// each.
    std::vector<std::uint32_t> partners;
    std::uint32_t pairs = 0;
};

/// Bodies of which particles overlap and part, one of them inside a lattice.
Plan find(const Scene& scene, const StateLayout& layout, const overlaps::Overlaps& overlaps);

struct Interlocks {
    layout::InterlockPush push{};
    BufferId nodes, depths, partners, normals, pairs, arguments, moving;
};

/// None where the plan is empty.
std::optional<Interlocks> add(ProgramBuilder& program, const Plan& plan, std::size_t slots,
                              float recoverySpeed);

/// What the passes share with those of ordinary contacts.
struct Shared {
    const contact_lists::Lists& lists;
    BufferId slips; ///< w: what is left of an overlap [m]; all of the reach = none touches here
    BufferId touching;
};

/// In a substep, after lists were made: moves what is predicted. Runs while anything interlocks.
void addPasses(ProgramBuilder& program, const Interlocks& interlocks, const Shared& shared,
               const ParticleBuffers& predicted);

/// Where a step ends: which pairs are apart.
void addClosing(ProgramBuilder& program, const Interlocks& interlocks);

} // namespace sinew::sim::collision::interlocks
