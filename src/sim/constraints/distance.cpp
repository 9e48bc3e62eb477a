// The edges of the constraint pass of `jacobi`.
#include "sim/constraints/distance.hpp"

#include "kernels.hpp"

#include <algorithm>

namespace sinew::sim::constraints::distance {

namespace {

std::vector<DistanceConstraint> movable(const SceneModel& model) {
    std::vector<DistanceConstraint> result;
    std::ranges::copy_if(model.scene.distances, std::back_inserter(result),
                         [&](const DistanceConstraint& c) { return canMove(c, model.inverseMass); });
    return result;
}

} // namespace

bool canMove(const DistanceConstraint& constraint, std::span<const float> inverseMass) {
    return inverseMass[constraint.a] + inverseMass[constraint.b] > 0;
}

Edges reserve(const SceneModel& model, CorrectionSlots& slots) {
    const std::vector<DistanceConstraint> constraints = movable(model);
    Edges edges{.count = static_cast<std::uint32_t>(constraints.size()),
                .firstSlot = slots.size(),
                .dampingTime = model.scene.dampingTime};
    for (const DistanceConstraint& constraint : constraints) {
        slots.add(constraint.a);
        slots.add(constraint.b);
    }
    return edges;
}

void upload(ProgramBuilder& program, const SceneModel& model, std::span<const float> weights, Edges& edges) {
    if (edges.count == 0) return;
    std::vector<layout::DistanceEdge> items;
    std::vector<layout::DistanceMultiplier> multipliers;
    bool isCompliant = false;
    for (const DistanceConstraint& c : movable(model)) {
        items.push_back({c.a, c.b, c.restLength, c.compliance});
        multipliers.push_back({0, std::min(weights[c.a], weights[c.b])});
        isCompliant |= c.compliance > 0;
    }
    edges.edges = program.upload("distance.edges", items);
    if (isCompliant) edges.multipliers = program.upload("distance.multipliers", multipliers);
}

void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Edges& edges,
             BufferId corrections, bool isFirstIteration) {
    if (edges.count == 0) return;
    constexpr std::uint32_t hasMultipliersId = 1, hasDampingId = 12; // constant_ids in solve_distance.comp
    const bool hasMultipliers = edges.multipliers != BufferId{};
    const bool hasDamping = hasMultipliers && edges.dampingTime > 0;
    program.dispatch(
        kernels::solveDistance, edges.count,
        {edges.edges, particles.positions, corrections, particles.step,
         boundIf(hasMultipliers, edges.multipliers), boundIf(hasDamping, particles.velocities)},
        layout::DampedIterationPush{edges.count, edges.firstSlot, isFirstIteration, edges.dampingTime},
        {{hasMultipliersId, hasMultipliers}, {hasDampingId, hasDamping}});
}

} // namespace sinew::sim::constraints::distance
