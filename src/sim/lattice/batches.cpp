// Grids of equal shape and material are marched in one dispatch: chunks differ only in where they begin.
#include "sim/lattice/batches.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::sim::lattice {

namespace {

constexpr std::uint32_t sheetColumns = 4; // COLUMNS_X of gather_sheet

constexpr std::uint32_t cuttableColumns = 2; // of the kernels for cuttable lattices

// Columns of a block in x and in y.
std::array<std::uint32_t, 2> blockOf(const Grid& grid, std::uint32_t columns) {
    if (grid.isCuttable) columns = cuttableColumns;
    if (isSheet(grid)) return {sheetColumns, 1};
    if (hasCellVolumes(grid)) return {columns, 1}; // with 2 x 2 a GPU runs out of registers
    return {columns, columns};
}

bool isFull(const Grid& grid) {
    return grid.node.size() == std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2];
}

// The rule from particles to slots, if the scene consists of equal full grids in a row.
std::optional<EqualBoxes> equalBoxes(const Scene& scene, std::span<const std::uint32_t> grids,
                                     std::span<const Box> boxes) {
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

layout::LatticePush pushOf(const Scene& scene, const Grid& grid, const Box& box,
                           std::span<const float> shares, const solvers::CellShares& cells) {
    layout::LatticePush push{};
    push.rowStride = box.rowStride;
    push.sliceStride = box.sliceStride;
    constexpr float cellsOfALink[3] = {4, 2, 1};
    for (std::uint32_t kind = 0; kind < grid.kinds; ++kind) {
        const float whole = LATTICE_FULL * (isSheet(grid) ? 1 : cellsOfALink[kind]);
        const float stiffness = solvers::stiffnessOf(grid.compliance[kind]);
        push.restLengths[kind] = grid.restLength[kind];
        push.units[kind] = stiffness / whole;
        push.shares[kind] = solvers::wholeShare(scene, grid, kind, shares) / whole;
    }
    const float spacing = grid.restLength[0];
    push.volumeUnit = grid.volumeStiffness * spacing / LATTICE_FULL;
    push.volumeShare = 2 * cells.volume / LATTICE_FULL;
    push.recoveryUnit = grid.recoveryPressure * spacing / LATTICE_FULL;
    push.recoveryShare = 2 * cells.recovery / LATTICE_FULL;
    return push;
}

Batch& batchFor(std::vector<Batch>& batches, const Grid& grid, const layout::LatticePush& push) {
    const bool hasBodyDiagonals = grid.kinds == 3;
    for (Batch& batch : batches) {
        layout::LatticePush other = batch.push;
        other.bodyChunks = push.bodyChunks; // grows with the number of bodies
        if (batch.isSheet == isSheet(grid) && batch.hasBodyDiagonals == hasBodyDiagonals &&
            batch.isCuttable == grid.isCuttable && std::memcmp(&other, &push, sizeof push) == 0)
            return batch;
    }
    return batches.emplace_back(Batch{isSheet(grid),
                                      hasBodyDiagonals,
                                      hasCellVolumes(grid),
                                      grid.recoveryPressure > 0,
                                      grid.isCuttable,
                                      push,
                                      {},
                                      {}});
}

std::size_t wholeGroups(std::size_t chunks) {
    return (chunks + LATTICE_GROUP - 1) / LATTICE_GROUP * LATTICE_GROUP;
}

void finish(Batch& batch, bool isOneNode) {
    if (isOneNode) {
        batch.push.count = static_cast<std::uint32_t>(batch.chunks.size()) * LATTICE_GROUP;
        return;
    }
    batch.push.count = static_cast<std::uint32_t>(batch.chunks.size());
    batch.chunks.resize(wholeGroups(batch.chunks.size()), {batch.chunks.front().origin, 0});
}

// Slices that a lane marches so that a body's chunks just fill the lanes of its work group.
std::uint32_t residentChunk(const Grid& grid) {
    const auto [columnsX, columnsY] = blockOf(grid, 2);
    const std::uint32_t blocks =
        ((grid.nodes[0] + columnsX - 1) / columnsX) * ((grid.nodes[1] + columnsY - 1) / columnsY);
    const std::uint32_t runs = std::max(LATTICE_GROUP / blocks, 1u);
    return (grid.nodes[2] + runs - 1) / runs;
}

std::vector<layout::LatticeChunk> chunksFor(const Grid& grid, const Box& box, const Forms& forms,
                                            bool isResident) {
    if (isOneNode(forms)) return runsOf(grid, box);
    const auto [columnsX, columnsY] = blockOf(grid, isResident ? 2 : forms.columns);
    return chunksOf(grid, box, columnsX, columnsY, isResident ? residentChunk(grid) : forms.chunk);
}

// Bodies of one dispatch have equal numbers of chunks: shorter lists are padded in place.
void appendBody(Batch& batch, const Box& box, std::vector<layout::LatticeChunk> chunks, bool isOneNode) {
    const std::size_t before = batch.push.bodyChunks,
                      now = std::max(before, isOneNode ? chunks.size() : wholeGroups(chunks.size()));
    std::vector<layout::LatticeChunk> all;
    for (std::size_t body = 0; body < batch.bodies.size(); ++body) {
        const auto first = batch.chunks.begin() + static_cast<std::ptrdiff_t>(body * before);
        all.insert(all.end(), first, first + static_cast<std::ptrdiff_t>(before));
        all.resize((body + 1) * now, {batch.bodies[body], 0});
    }
    all.insert(all.end(), chunks.begin(), chunks.end());
    batch.bodies.push_back(box.origin);
    all.resize(batch.bodies.size() * now, {box.origin, 0});
    batch.chunks = std::move(all);
    batch.push.bodyChunks = static_cast<std::uint32_t>(now);
}

} // namespace

std::vector<std::uint32_t> computedGrids(const Scene& scene, const Settings& settings) {
    std::vector<std::uint32_t> grids;
    // kernels of grids support neither bends nor internal damping
    if (!settings.forms.usesGrids || !scene.bends.empty() || scene.dampingTime > 0) return grids;
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

std::vector<Box> boxesOf(const Scene& scene, std::span<const std::uint32_t> grids) {
    std::vector<Box> boxes;
    auto first = static_cast<std::uint32_t>(paddedCount(listedParticles(scene, grids)));
    for (const std::uint32_t grid : grids) {
        boxes.push_back(place(scene.grids[grid], first));
        first = boxes.back().end;
    }
    return boxes;
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
    layout.boxes = equalBoxes(scene, grids, boxes);
    return layout;
}

bool isResident(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids) {
    // attachments, grabs, tethers, colliders, pokes and driven bodies need passes between substeps
    if (settings.keepsForces || !scene.attachments.empty() || settings.grabs > 0 || settings.pokes > 0 ||
        !scene.tethers.empty() || !scene.colliders.empty() || !scene.driven.empty())
        return false;
    if (grids.empty() || listedParticles(scene, grids) > 0) return false;
    return std::ranges::all_of(grids, [&](std::uint32_t g) {
        const Grid& grid = scene.grids[g];
        return !grid.isCuttable &&
               std::uint64_t{place(grid, 0).slots} * 2 * sizeof(layout::vec4) <= settings.forms.residentBytes;
    });
}

Batches batchesOf(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids,
                  const solvers::Shares& shares, Residence residence) {
    const std::vector<Box> boxes = boxesOf(scene, grids);
    const bool resident = residence == Residence::sharedMemory;
    Batches result;
    result.cells.resize(paddedCount(boxes.back().end), 0);
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        const Box& box = boxes[g];
        writeCells(grid, box, result.cells);
        layout::LatticePush push = pushOf(scene, grid, box, shares.ofLinks, shares.ofCells[grids[g]]);
        if (resident) {
            push.substeps = settings.substeps;
            push.bodySlots = box.slots;
        }
        const auto chunks = chunksFor(grid, box, settings.forms, resident);
        Batch& batch = batchFor(result.batches, grid, push);
        if (resident)
            appendBody(batch, box, chunks, isOneNode(settings.forms));
        else
            batch.chunks.insert(batch.chunks.end(), chunks.begin(), chunks.end());
    }
    if (!resident)
        for (Batch& batch : result.batches) finish(batch, isOneNode(settings.forms));
    return result;
}

} // namespace sinew::sim::lattice
