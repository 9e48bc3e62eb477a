// Listed particles stand at the head of the state, boxes of grids behind them.
#include "sim/model/grids.hpp"

#include "sim/model/links.hpp"

namespace sinew::sim {

namespace {

bool isFull(const Grid& grid) {
    return grid.node.size() == std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2];
}

// The rule from particles to slots, if the scene consists of equal full grids in a row.
std::optional<EqualBoxes> equalBoxes(const Scene& scene, std::span<const std::uint32_t> grids,
                                     std::span<const lattice::Box> boxes) {
    const Grid& first = scene.grids[grids[0]];
    const auto particles = static_cast<std::uint32_t>(first.node.size());
    if (!isFull(first) || scene.particles.size() != std::size_t{particles} * grids.size()) return {};
    for (std::uint32_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        if (!isFull(grid) || grid.nodes != first.nodes || grid.firstParticle != g * particles) return {};
    }
    return EqualBoxes{.particles = particles,
                      .nodesX = first.nodes[0],
                      .nodesY = first.nodes[1],
                      .origin = boxes[0].origin,
                      .rowStride = boxes[0].rowStride,
                      .sliceStride = boxes[0].sliceStride,
                      .boxStride = boxes.size() > 1 ? boxes[1].origin - boxes[0].origin : 0};
}

} // namespace

std::vector<std::uint32_t> computedGrids(const Scene& scene, const Settings& settings) {
    std::vector<std::uint32_t> grids;
    // kernels of grids support no internal damping either
    if (!settings.forms.usesGrids || !linksFitGrids(scene) || scene.dampingTime > 0) return grids;
    std::vector<std::uint32_t> links(scene.particles.size()); // by particle
    for (const DistanceConstraint& c : scene.distances) {
        ++links[c.a];
        ++links[c.b];
    }
    for (std::uint32_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        std::size_t all = 0;
        for (std::size_t i = 0; i < grid.node.size(); ++i) all += links[grid.firstParticle + i];
        if (all == 2 * std::size_t{grid.distanceCount}) grids.push_back(g);
    }
    return grids;
}

std::uint32_t listedParticles(const Scene& scene, std::span<const std::uint32_t> grids) {
    std::size_t count = scene.particles.size();
    for (const std::uint32_t grid : grids) count -= scene.grids[grid].node.size();
    return static_cast<std::uint32_t>(count);
}

std::vector<lattice::Box> boxesOf(const Scene& scene, std::span<const std::uint32_t> grids) {
    std::vector<lattice::Box> boxes;
    auto first = static_cast<std::uint32_t>(paddedCount(listedParticles(scene, grids)));
    for (const std::uint32_t grid : grids) {
        boxes.push_back(lattice::place(scene.grids[grid], first));
        first = boxes.back().end;
    }
    return boxes;
}

StateLayout layoutOf(const Scene& scene, std::span<const std::uint32_t> grids,
                     std::span<const lattice::Box> boxes) {
    if (grids.empty()) return orderedLayout(scene.particles.size());
    constexpr std::uint32_t unset = 0xffffffffu;
    StateLayout layout{.slot = std::vector<std::uint32_t>(scene.particles.size(), unset),
                       .count = paddedCount(boxes.back().end),
                       .isInOrder = false};
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        for (std::size_t i = 0; i < grid.node.size(); ++i) {
            const auto at = lattice::coordinates(grid, grid.node[i]);
            layout.slot[grid.firstParticle + i] = boxes[g].slot(at[0], at[1], at[2]);
        }
    }
    std::uint32_t next = 0;
    for (std::uint32_t& slot : layout.slot)
        if (slot == unset) slot = next++;
    layout.boxes = equalBoxes(scene, grids, boxes);
    return layout;
}

} // namespace sinew::sim
