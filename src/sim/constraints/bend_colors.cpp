// The bends of `gauss_seidel`, color by color.
#include "sim/constraints/bend.hpp"

#include "kernels.hpp"
#include "sim/model/coloring.hpp"

#include <algorithm>
#include <array>

namespace sinew::sim::constraints::bend {

ColoredBends uploadColors(ProgramBuilder& program, const SceneModel& model) {
    const Coloring coloring = colorBends(model.scene, model.inverseMass);
    if (coloring.order.empty()) return {};
    const auto immovable = static_cast<std::uint32_t>(model.layout.count - 1);
    std::vector<layout::ColoredBend> items;
    ColoredBends result;
    bool isCompliant = false;
    for (std::size_t k = 0; k < coloring.colorCount(); ++k) {
        const auto first = static_cast<std::uint32_t>(items.size());
        for (const std::uint32_t index : coloring.color(k)) {
            const BendConstraint& c = model.scene.bends[index];
            items.push_back({c.a, c.b, c.c, c.compliance});
            isCompliant = isCompliant || c.compliance > 0;
        }
        while (items.size() % GROUP_ITEMS != 0) items.push_back({immovable, immovable, immovable, 1});
        result.colors.push_back({first, static_cast<std::uint32_t>(items.size()) - first});
    }
    result.bends = program.upload("bends", items);
    if (isCompliant && model.settings.iterations > 1)
        result.multipliers = program.scratch<layout::vec4>("bends.multipliers", items.size());
    return result;
}

void addSweep(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredBends& bends,
              BufferId corrections, bool isFirst) {
    constexpr std::uint32_t hasMultipliersId = 1; // constant_id in solve_bend_color.comp
    const bool hasMultipliers = bends.multipliers != BufferId{};
    const std::array buffers{corrections, particles.step, bends.bends, particles.positions,
                             boundIf(hasMultipliers, bends.multipliers)};
    for (std::uint32_t k = 0; k < bends.colors.size(); ++k) {
        const auto [first, count] = bends.colors[k];
        program.dispatch(kernels::solveBendColor, count, buffers,
                         layout::BendColorPush{count, first, isFirst}, {{hasMultipliersId, hasMultipliers}});
        program.numberLast(k);
    }
}

} // namespace sinew::sim::constraints::bend
