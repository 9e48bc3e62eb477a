// Lists of bends by particle and by constraint.
#include "sim/constraints/bend.hpp"

#include "kernels.hpp"

#include <algorithm>

namespace sinew::sim::constraints::bend {

namespace {

std::array<std::uint32_t, 3> particlesOf(const BendConstraint& bend) {
    return {bend.a, bend.b, bend.c};
}

std::vector<BendConstraint> movable(const SceneModel& model) {
    std::vector<BendConstraint> result;
    std::ranges::copy_if(model.scene.bends, std::back_inserter(result),
                         [&](const BendConstraint& bend) { return canMove(bend, model.inverseMass); });
    return result;
}

// Limited so that its product with h^2 stays within float32; the solver's clamp is far lower.
float stiffness(const BendConstraint& bend) {
    constexpr float stiffest = 1e20f; // [N/m]
    return bend.compliance > 0 ? std::min(1 / bend.compliance, stiffest) : stiffest;
}

} // namespace

bool canMove(const BendConstraint& bend, std::span<const float> inverseMass) {
    return inverseMass[bend.a] + inverseMass[bend.b] + inverseMass[bend.c] > 0;
}

GatherBends gatherBends(const SceneModel& model, double omega) {
    const std::vector<BendConstraint> bends = movable(model);
    const std::size_t particles = model.scene.particles.size();
    std::vector<std::uint32_t> counts(particles, 0), used(particles, 0);
    for (const BendConstraint& bend : bends)
        for (const std::uint32_t i : particlesOf(bend)) ++counts[i];
    GatherBends result;
    if (bends.empty()) return result;
    result.degree = *std::ranges::max_element(counts);
    const std::size_t padded = paddedCount(counts.size());
    result.bends.resize(padded * result.degree);
    const auto element = [&](std::size_t i, std::uint32_t slot) -> layout::SplitBend& {
        return result.bends[(i / LINK_BLOCK * result.degree + slot) * LINK_BLOCK + i % LINK_BLOCK];
    };
    for (std::uint32_t i = 0; i < padded; ++i)
        for (std::uint32_t slot = 0; slot < result.degree; ++slot)
            element(i, slot) = {i, i, i, 0, 0, 0, 0, 0};
    for (const BendConstraint& bend : bends) {
        const auto end = [&](std::uint32_t i) { return counts[i] * double{model.inverseMass[i]}; };
        const auto clamp = static_cast<float>(omega / (end(bend.a) + 4 * end(bend.b) + end(bend.c)));
        for (const std::uint32_t i : particlesOf(bend))
            element(i, used[i]++) = {bend.a,          bend.b, bend.c, i == bend.b ? 2.0f : -1.0f,
                                     stiffness(bend), clamp,  0,      0};
    }
    return result;
}

Rows reserve(const SceneModel& model, CorrectionSlots& slots) {
    const std::vector<BendConstraint> bends = movable(model);
    Rows rows{.count = static_cast<std::uint32_t>(bends.size()), .firstSlot = slots.size()};
    for (const BendConstraint& bend : bends)
        for (const std::uint32_t i : particlesOf(bend)) slots.add(i);
    return rows;
}

void upload(ProgramBuilder& program, const SceneModel& model, std::span<const float> weights, Rows& rows) {
    if (rows.count == 0) return;
    std::vector<layout::BendRow> items;
    for (const BendConstraint& bend : movable(model))
        items.push_back({bend.a, bend.b, bend.c, bend.compliance,
                         std::min({weights[bend.a], weights[bend.b], weights[bend.c]}), 0, 0, 0});
    rows.rows = program.upload("bends", items);
    rows.multipliers = program.scratch<layout::vec4>("bends.multipliers", rows.count);
}

void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Rows& rows,
             BufferId corrections, bool isFirstIteration) {
    if (rows.count == 0) return;
    program.dispatch(kernels::solveBends, rows.count,
                     {rows.rows, particles.positions, corrections, particles.step, rows.multipliers},
                     layout::IterationPush{rows.count, rows.firstSlot, isFirstIteration});
}

} // namespace sinew::sim::constraints::bend
