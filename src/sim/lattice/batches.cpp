// Grids of one shape and material march in one dispatch: a chunk says where it begins, all else is equal.
#include "sim/lattice/batches.hpp"

#include "sim/solvers/shares.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::sim::lattice {

namespace {

constexpr std::uint32_t sheetColumns = 4; // COLUMNS_X of gather_sheet

std::vector<Box> boxesOf(const Scene& scene, std::span<const std::uint32_t> grids) {
    std::vector<Box> boxes;
    auto first = static_cast<std::uint32_t>(paddedCount(listedParticles(scene, grids)));
    for (const std::uint32_t grid : grids) {
        boxes.push_back(place(scene.grids[grid], first));
        first = boxes.back().end;
    }
    return boxes;
}

// k~ of a whole link of a kind: a link's k~ over its stiffness is the same for all links of that rest length.
float shareOf(const Scene& scene, const Grid& grid, float restLength, float stiffness,
              std::span<const float> shares) {
    for (std::uint32_t c = grid.firstDistance; c < grid.firstDistance + grid.distanceCount; ++c) {
        const DistanceConstraint& link = scene.distances[c];
        if (link.restLength == restLength && shares[c] > 0)
            return shares[c] / solvers::stiffnessOf(link.compliance) * stiffness;
    }
    return stiffness; // no such link moves
}

layout::LatticePush pushOf(const Scene& scene, const Grid& grid, const Box& box,
                           std::span<const float> shares) {
    layout::LatticePush push{};
    push.rowStride = box.rowStride;
    push.sliceStride = box.sliceStride;
    constexpr float cellsOfALink[3] = {4, 2, 1};
    for (std::uint32_t kind = 0; kind < grid.kinds; ++kind) {
        const float whole = LATTICE_FULL * (isSheet(grid) ? 1 : cellsOfALink[kind]);
        const float stiffness = solvers::stiffnessOf(grid.compliance[kind]);
        push.restLengths[kind] = grid.restLength[kind];
        push.units[kind] = stiffness / whole;
        push.shares[kind] = shareOf(scene, grid, grid.restLength[kind], stiffness, shares) / whole;
    }
    return push;
}

Batch& batchFor(std::vector<Batch>& batches, const Grid& grid, const layout::LatticePush& push) {
    const bool hasBodyDiagonals = grid.kinds == 3;
    for (Batch& batch : batches)
        if (batch.isSheet == isSheet(grid) && batch.hasBodyDiagonals == hasBodyDiagonals &&
            std::memcmp(&batch.push, &push, sizeof push) == 0)
            return batch;
    return batches.emplace_back(Batch{isSheet(grid), hasBodyDiagonals, push, {}});
}

void finish(Batch& batch) {
    batch.push.count = static_cast<std::uint32_t>(batch.chunks.size());
    const std::size_t groups = (batch.chunks.size() + LATTICE_GROUP - 1) / LATTICE_GROUP;
    batch.chunks.resize(groups * LATTICE_GROUP, {batch.chunks.front().origin, 0});
}

} // namespace

std::vector<std::uint32_t> computedGrids(const Scene& scene, const Settings& settings) {
    std::vector<std::uint32_t> grids;
    if (!settings.forms.usesGrids) return grids;
    std::vector<std::uint32_t> links(scene.particles.size()); // of each particle
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

StateLayout layoutOf(const Scene& scene, std::span<const std::uint32_t> grids) {
    if (grids.empty()) return orderedLayout(scene.particles.size());
    constexpr std::uint32_t unset = 0xffffffffu;
    const std::vector<Box> boxes = boxesOf(scene, grids);
    StateLayout layout{.slot = std::vector<std::uint32_t>(scene.particles.size(), unset),
                       .count = paddedCount(boxes.back().end),
                       .isInOrder = false};
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        for (std::size_t i = 0; i < grid.node.size(); ++i) {
            const auto at = coordinates(grid, grid.node[i]);
            layout.slot[grid.firstParticle + i] = boxes[g].slot(at[0], at[1], at[2]);
        }
    }
    std::uint32_t next = 0;
    for (std::uint32_t& slot : layout.slot)
        if (slot == unset) slot = next++;
    return layout;
}

Batches batchesOf(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids,
                  std::span<const float> shares) {
    const std::vector<Box> boxes = boxesOf(scene, grids);
    Batches result;
    result.cells.resize(paddedCount(boxes.back().end), 0);
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        writeCells(grid, boxes[g], result.cells);
        const std::uint32_t columns = settings.forms.columns;
        const auto chunks = chunksOf(grid, boxes[g], isSheet(grid) ? sheetColumns : columns,
                                     isSheet(grid) ? 1 : columns, settings.forms.chunk);
        Batch& batch = batchFor(result.batches, grid, pushOf(scene, grid, boxes[g], shares));
        batch.chunks.insert(batch.chunks.end(), chunks.begin(), chunks.end());
    }
    for (Batch& batch : result.batches) finish(batch);
    return result;
}

} // namespace sinew::sim::lattice
