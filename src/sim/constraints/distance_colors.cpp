// The edges of `gauss_seidel`, color by color, and the links from which its warm start gathers multipliers.
#include "sim/constraints/distance.hpp"

#include "kernels.hpp"
#include "sim/model/coloring.hpp"
#include "sim/model/state.hpp"

#include <algorithm>

namespace sinew::sim::constraints::distance {

namespace {

constexpr std::uint32_t degreeId = 1; // constant_id in advance_substep.comp

// Edges by color, and the index of the edge of each constraint in the coloring's order.
struct EdgeList {
    std::vector<layout::DistanceEdge> edges;
    std::vector<ColoredEdges::Color> colors;
    std::vector<std::uint32_t> places;
};

EdgeList listEdges(const Scene& scene, const Coloring& coloring, const StateLayout& layout) {
    // Padding of a color: an edge from a padding particle to itself, at rest, which writes nothing.
    const auto immovable = static_cast<std::uint32_t>(layout.count - 1);
    const layout::DistanceEdge padding{immovable, immovable, 0, 1};
    EdgeList list;
    for (std::size_t k = 0; k < coloring.colorCount(); ++k) {
        const auto first = static_cast<std::uint32_t>(list.edges.size());
        for (const std::uint32_t index : coloring.color(k)) {
            const DistanceConstraint& c = scene.distances[index];
            list.places.push_back(static_cast<std::uint32_t>(list.edges.size()));
            list.edges.push_back({c.a, c.b, c.restLength, c.compliance});
        }
        do list.edges.push_back(padding);
        while (list.edges.size() % GROUP_ITEMS != 0);
        list.colors.push_back({first, static_cast<std::uint32_t>(list.edges.size()) - first});
    }
    return list;
}

// The links of every moving particle, in the order of the sweep.
void uploadWarmLinks(ProgramBuilder& program, const SceneModel& model, const Coloring& coloring,
                     const EdgeList& list, ColoredEdges& result) {
    const Scene& scene = model.scene;
    std::vector<std::vector<std::uint32_t>> linksOf(scene.particles.size());
    for (std::size_t entry = 0; entry < coloring.order.size(); ++entry) {
        const DistanceConstraint& c = scene.distances[coloring.order[entry]];
        if (model.moves(c.a)) linksOf[c.a].push_back(list.places[entry] | WARM_LINK_SIGN);
        if (model.moves(c.b)) linksOf[c.b].push_back(list.places[entry]);
    }
    for (const auto& links : linksOf)
        result.degree = std::max(result.degree, static_cast<std::uint32_t>(links.size()));
    const auto nothing = static_cast<std::uint32_t>(list.edges.size() - 1); // padding
    std::vector<std::uint32_t> slots(model.layout.count * result.degree, nothing);
    for (std::size_t i = 0; i < linksOf.size(); ++i)
        for (std::size_t s = 0; s < linksOf[i].size(); ++s)
            slots[(i / LINK_BLOCK * result.degree + s) * LINK_BLOCK + i % LINK_BLOCK] = linksOf[i][s];
    result.links = program.upload("distance.warm_links", slots);
}

} // namespace

ProgramBuilder::Constants ColoredEdges::constants() const {
    return degree > 0 ? ProgramBuilder::Constants{{degreeId, degree}} : ProgramBuilder::Constants{};
}

ColoredEdges uploadColors(ProgramBuilder& program, const SceneModel& model) {
    const Settings& settings = model.settings;
    const Coloring coloring = colorByParticles(model.scene, model.inverseMass);
    if (coloring.order.empty()) return {};
    const EdgeList list = listEdges(model.scene, coloring, model.layout);
    ColoredEdges result{.colors = list.colors, .edges = program.upload("distance.edges", list.edges)};
    const bool isCompliant = std::ranges::any_of(
        list.edges, [](const layout::DistanceEdge& edge) { return edge.compliance > 0 && edge.a != edge.b; });
    const bool isWarm = settings.warmStart > 0;
    if (isWarm || (isCompliant && settings.iterations > 1))
        result.multipliers = program.scratch<layout::vec4>("distance.multipliers", list.edges.size());
    if (isWarm) {
        uploadWarmLinks(program, model, coloring, list, result);
        program.restoreOnUndo(result.multipliers);
    }
    return result;
}

void addSweep(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredEdges& edges,
              BufferId corrections, float warmStart, Sweep sweep) {
    std::vector<BufferId> buffers{corrections, particles.step, edges.edges, particles.positions, corrections};
    constexpr std::uint32_t hasMultipliersId = 1; // constant_id in solve_distance_color.comp
    const bool hasMultipliers = edges.multipliers != BufferId{};
    const BufferId multipliers = boundIf(hasMultipliers, edges.multipliers);
    buffers.insert(buffers.end(), {multipliers, multipliers});
    for (std::uint32_t k = 0; k < edges.colors.size(); ++k) {
        const auto [first, count] = edges.colors[k];
        program.dispatch(kernels::solveDistanceColor, count, buffers,
                         layout::ColorPush{count, first, sweep.isOpening, sweep.isClosing, warmStart},
                         {{hasMultipliersId, hasMultipliers}});
        program.numberLast(k);
    }
}

void addDamping(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredEdges& edges,
                float dampingTime) {
    for (std::uint32_t k = 0; k < edges.colors.size(); ++k) {
        const auto [first, count] = edges.colors[k];
        program.dispatch(kernels::dampDistanceColor, count,
                         {particles.velocities, particles.step, edges.edges, particles.positions},
                         layout::DampColorPush{count, first, dampingTime});
        program.numberLast(k);
    }
}

} // namespace sinew::sim::constraints::distance
