// Slots, fill words and chunks of a grid.
#include "sim/lattice/placement.hpp"

#include <algorithm>

namespace sinew::sim::lattice {

namespace {

std::uint32_t roundUp(std::uint32_t value, std::uint32_t step) {
    return (value + step - 1) / step * step;
}

/// Fill of a cell, 0 outside the grid.
std::uint32_t fillAt(const Grid& grid, std::int64_t x, std::int64_t y, std::int64_t z) {
    const std::int64_t cellsX = grid.nodes[0] - 1, cellsY = isSheet(grid) ? 1 : grid.nodes[1] - 1,
                       cellsZ = grid.nodes[2] - 1;
    if (x < 0 || y < 0 || z < 0 || x >= cellsX || y >= cellsY || z >= cellsZ) return 0;
    return grid.fill[static_cast<std::size_t>(x + cellsX * (y + cellsY * z))];
}

/// Whether each slice of a block holds a particle.
std::vector<bool> slicesWithParticles(const Grid& grid, const std::vector<bool>& isLive, std::uint32_t blockX,
                                      std::uint32_t blockY, std::uint32_t columnsX, std::uint32_t columnsY) {
    std::vector<bool> result(grid.nodes[2]);
    for (std::uint32_t z = 0; z < grid.nodes[2]; ++z)
        for (std::uint32_t y = blockY; y < std::min(blockY + columnsY, grid.nodes[1]); ++y)
            for (std::uint32_t x = blockX; x < std::min(blockX + columnsX, grid.nodes[0]); ++x)
                if (isLive[x + std::size_t{grid.nodes[0]} * (y + std::size_t{grid.nodes[1]} * z)])
                    result[z] = true;
    return result;
}

/// Slices that the block of columns at `column` (x, y) covers.
struct Run {
    std::array<std::uint32_t, 2> column;
    std::uint32_t slice, layers;
};

/// Appends the runs of true, each divided into equal parts of at most `longest`.
void appendRuns(const std::vector<bool>& isLive, std::array<std::uint32_t, 2> column, std::uint32_t longest,
                std::vector<Run>& runs) {
    const auto count = static_cast<std::uint32_t>(isLive.size());
    for (std::uint32_t begin = 0; begin < count;) {
        std::uint32_t end = begin;
        while (end < count && isLive[end]) ++end;
        const std::uint32_t parts = (end - begin + longest - 1) / longest;
        for (std::uint32_t part = 0; part < parts; ++part) {
            const std::uint32_t from = begin + (end - begin) * part / parts;
            const std::uint32_t to = begin + (end - begin) * (part + 1) / parts;
            runs.push_back({column, from, to - from});
        }
        begin = end + 1;
    }
}

} // namespace

Box place(const Grid& grid, std::uint32_t first) {
    Box box;
    box.sliceStride = roundUp(grid.nodes[0], isSheet(grid) ? 4 : 2);
    box.rowStride = box.sliceStride * grid.nodes[2];
    box.slots = box.rowStride * roundUp(grid.nodes[1], isSheet(grid) ? 1 : 2);
    const std::uint32_t rim = (isSheet(grid) ? 0 : box.rowStride) + box.sliceStride + 1;
    box.origin = first + rim;
    box.end = box.origin + box.slots + rim;
    return box;
}

std::array<std::uint32_t, 3> coordinates(const Grid& grid, std::uint32_t node) {
    return {node % grid.nodes[0], node / grid.nodes[0] % grid.nodes[1], node / grid.nodes[0] / grid.nodes[1]};
}

std::uint32_t fillAround(const Grid& grid, const std::array<std::uint32_t, 3>& node) {
    std::uint32_t word = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        const std::int64_t x = std::int64_t{node[0]} - 1 + (k & 1);
        const std::int64_t y =
            isSheet(grid) ? 0 - std::int64_t{k >> 1 & 1} : std::int64_t{node[1]} - 1 + (k >> 1 & 1);
        const std::int64_t z = std::int64_t{node[2]} - 1 + (k >> 2);
        word |= fillAt(grid, x, y, z) << 4 * k;
    }
    return word;
}

void writeCells(const Grid& grid, const Box& box, std::span<std::uint32_t> words) {
    for (const std::uint32_t node : grid.node) {
        const auto at = coordinates(grid, node);
        words[box.slot(at[0], at[1], at[2])] = fillAround(grid, at);
    }
}

std::vector<layout::LatticeChunk> chunksOf(const Grid& grid, const Box& box, std::uint32_t columnsX,
                                           std::uint32_t columnsY, std::uint32_t longest) {
    std::vector<bool> isLive(std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2]);
    for (const std::uint32_t node : grid.node) isLive[node] = true;
    std::vector<Run> runs;
    for (std::uint32_t y = 0; y < grid.nodes[1]; y += columnsY)
        for (std::uint32_t x = 0; x < grid.nodes[0]; x += columnsX)
            appendRuns(slicesWithParticles(grid, isLive, x, y, columnsX, columnsY), {x, y}, longest, runs);
    // neighbouring runs have equal height and length: the lanes of a device then march in step
    std::ranges::stable_sort(runs, {}, &Run::slice);
    std::vector<layout::LatticeChunk> chunks;
    for (const Run& run : runs)
        chunks.push_back({box.slot(run.column[0], run.column[1], run.slice), run.layers});
    return chunks;
}

std::vector<layout::LatticeChunk> runsOf(const Grid& grid, const Box& box) {
    std::vector<std::uint32_t> slots;
    for (const std::uint32_t node : grid.node) {
        const auto at = coordinates(grid, node);
        slots.push_back(box.slot(at[0], at[1], at[2]));
    }
    std::ranges::sort(slots);
    std::vector<layout::LatticeChunk> runs;
    for (const std::uint32_t slot : slots) {
        if (runs.empty() || slot - runs.back().origin >= LATTICE_GROUP) runs.push_back({slot, 0});
        runs.back().layers = slot - runs.back().origin + 1;
    }
    return runs;
}

} // namespace sinew::sim::lattice
