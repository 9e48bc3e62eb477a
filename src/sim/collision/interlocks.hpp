// Interlocked bodies: bodies that overlap when a scene is loaded, so deeply that particles inside a lattice
// touch others. The lines between such particles have arbitrary directions, and the lattices would stay
// locked for ever. Instead, such a pair of bodies is separated along the normals of the lattices, which turn
// with them, and every contact between the two pushes at a limited speed, until no part of one is deeper than
// a tenth of a radius in the other. A scene without such bodies has none of these passes.
#pragma once

#include "sim/collision/contact_lists.hpp"
#include "sim/collision/overlaps.hpp"
#include "sim/model/state.hpp"

#include <optional>
#include <vector>

namespace sinew::sim::collision::interlocks {

/// Data by slot; bodies are linked bodies, numbered from 1 on. Empty if nothing interlocks.
struct Plan {
    std::vector<layout::InterlockNode> nodes;
    std::vector<layout::vec4> depths; ///< direction to the outside, in the axes of the grid, and depth [m]
    /// Start of the partners of each body, and one more entry for the end; then for each partner its body and
    /// the index of the pair.
    std::vector<std::uint32_t> partners;
    std::uint32_t pairs = 0;
    std::vector<std::array<std::uint32_t, 2>> bodies; ///< by pair: the smallest particle of each
};

/// Finds pairs of bodies whose particles overlap and are to be separated, one of them inside a lattice.
Plan find(const Scene& scene, const StateLayout& layout, std::span<const std::uint32_t> bodies,
          const overlaps::Overlaps& overlaps);

struct Interlocks {
    layout::InterlockPush push{};
    BufferId nodes, depths, partners, normals, pairs, arguments, moving;
};

/// Empty if the plan is empty.
std::optional<Interlocks> add(ProgramBuilder& program, const Plan& plan, std::size_t slots,
                              float recoverySpeed);

/// Buffers that the passes share with those of ordinary contacts.
struct Shared {
    const contact_lists::Lists& lists;
    BufferId slips; ///< w: remaining overlap [m]; the whole reach = none touches here
    BufferId touching;
};

/// Appends the passes of a substep, after lists were made, that move predicted positions. They run while a
/// pair is interlocked.
void addPasses(ProgramBuilder& program, const Interlocks& interlocks, const Shared& shared,
               const ParticleBuffers& predicted);

/// Appends the pass at the end of a step that decides which pairs are apart.
void addClosing(ProgramBuilder& program, const Interlocks& interlocks);

} // namespace sinew::sim::collision::interlocks
