// Grids of equal shape and material are marched in one dispatch: chunks differ only in where they begin.
#include "sim/solvers/batches.hpp"
#include "sim/model/grids.hpp"
#include "sinew/events.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::sim::solvers {

namespace {

constexpr std::uint32_t sheetColumns = 4; // COLUMNS_X of gather_sheet

constexpr std::uint32_t cuttableColumns = 2; // of the kernels for cuttable lattices

// Columns of a block in x and in y.
std::array<std::uint32_t, 2> blockOf(const Grid& grid, std::uint32_t columns) {
    if (grid.isCuttable) columns = cuttableColumns;
    if (lattice::isSheet(grid)) return {sheetColumns, 1};
    if (hasCellVolumes(grid)) return {columns, 1}; // with 2 x 2 a GPU runs out of registers
    return {columns, columns};
}

layout::LatticePush pushOf(const Scene& scene, const Grid& grid, const lattice::Box& box,
                           std::span<const float> shares, const stiffness::CellShares& cells) {
    layout::LatticePush push{};
    push.rowStride = box.rowStride;
    push.sliceStride = box.sliceStride;
    constexpr float cellsOfALink[3] = {4, 2, 1};
    for (std::uint32_t kind = 0; kind < grid.kinds; ++kind) {
        const float whole = LATTICE_FULL * (lattice::isSheet(grid) ? 1 : cellsOfALink[kind]);
        const float stiffness = stiffness::stiffnessOf(grid.compliance[kind]);
        push.restLengths[kind] = grid.restLength[kind];
        push.units[kind] = stiffness / whole;
        push.shares[kind] = stiffness::wholeShare(scene, grid, kind, shares) / whole;
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
        if (batch.isSheet == lattice::isSheet(grid) && batch.hasBodyDiagonals == hasBodyDiagonals &&
            batch.isCuttable == grid.isCuttable && std::memcmp(&other, &push, sizeof push) == 0)
            return batch;
    }
    return batches.emplace_back(Batch{lattice::isSheet(grid),
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

std::vector<layout::LatticeChunk> chunksFor(const Grid& grid, const lattice::Box& box, const Forms& forms,
                                            bool isResident) {
    if (isOneNode(forms)) return lattice::runsOf(grid, box);
    const auto [columnsX, columnsY] = blockOf(grid, isResident ? 2 : forms.columns);
    return lattice::chunksOf(grid, box, columnsX, columnsY, isResident ? residentChunk(grid) : forms.chunk);
}

// Bodies of one dispatch have equal numbers of chunks: shorter lists are padded in place.
void appendBody(Batch& batch, const lattice::Box& box, std::vector<layout::LatticeChunk> chunks,
                bool isOneNode) {
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

bool isResident(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> grids) {
    // levels, attachments, grabs, fields, tethers, colliders, host colliders, driven bodies and events of
    // contacts need passes between substeps; absent bodies are left out of dispatches of a substep
    if (settings.keepsForces || (settings.events & contactEvents) != 0 || settings.levels > 0 ||
        !scene.attachments.empty() || settings.grabs > 0 || settings.fields > 0 ||
        settings.hostColliders > 0 || !scene.tethers.empty() || !scene.colliders.empty() ||
        !scene.driven.empty() || std::ranges::any_of(scene.bodies, &Body::isAbsent))
        return false;
    if (grids.empty() || listedParticles(scene, grids) > 0) return false;
    return std::ranges::all_of(grids, [&](std::uint32_t g) {
        const Grid& grid = scene.grids[g];
        return !grid.isCuttable && std::uint64_t{lattice::place(grid, 0).slots} * 2 * sizeof(layout::vec4) <=
                                       settings.forms.residentBytes;
    });
}

Batches batchesOf(const SceneModel& model, const stiffness::Shares& shares, Residence residence) {
    const Scene& scene = model.scene;
    const Settings& settings = model.settings;
    const std::vector<std::uint32_t>& grids = model.grids;
    const bool resident = residence == Residence::sharedMemory;
    Batches result;
    result.cells.resize(paddedCount(model.boxes.back().end), 0);
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        const lattice::Box& box = model.boxes[g];
        lattice::writeCells(grid, box, result.cells);
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

} // namespace sinew::sim::solvers
