// Bends, C = x_a - 2 x_b + x_c, on the device: terms of the gather of `split`, a constraint pass of `jacobi`,
// one pass for each color of `gauss_seidel`. Bends without a moving particle are left out.
#pragma once

#include "common/layout.h"
#include "sim/constraints/correction_slots.hpp"
#include "sim/model/scene_model.hpp"

namespace sinew::sim::constraints::bend {

/// Whether a bend has a particle that moves.
bool canMove(const BendConstraint& bend, std::span<const float> inverseMass);

/// The bends of `split`, padded to `degree` slots a particle, in blocks like links (layout.h).
struct GatherBends {
    std::uint32_t degree = 0;
    std::vector<layout::SplitBend> bends;
};
/// `omega`: share of bends in the stability bound (SplitBudget::omegaBends).
GatherBends gatherBends(const SceneModel& model, double omega);

/// The buffers of the constraint pass of `jacobi`.
struct Rows {
    std::uint32_t count = 0, firstSlot = 0;
    BufferId rows, multipliers;
};
/// Reserves three slots a bend: for a, b and c.
Rows reserve(const SceneModel& model, CorrectionSlots& slots);
void upload(ProgramBuilder& program, const SceneModel& model, std::span<const float> weights, Rows& rows);
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Rows& rows,
             BufferId corrections, bool isFirstIteration);

/// The buffers of the passes of `gauss_seidel`: bends by color, each color padded to whole work groups. Their
/// multipliers start every substep at 0.
struct ColoredBends {
    struct Color {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Color> colors;
    BufferId bends, multipliers; ///< multipliers: invalid if one sweep a substep needs none
};
ColoredBends uploadColors(ProgramBuilder& program, const SceneModel& model);
/// Appends one pass a color, in place in `corrections`; `isFirst` in the first sweep of a substep.
void addSweep(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredBends& bends,
              BufferId corrections, bool isFirst);

} // namespace sinew::sim::constraints::bend
