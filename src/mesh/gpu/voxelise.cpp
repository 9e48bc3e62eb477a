// Read back between submissions: the number of hull cells and the length of their lists; the number of
// doubtful samples; then the result. Memory: 12 bytes and 2 bits a cell, 88 bytes a hull cell, 68 a column of
// cells along each axis, 20 a triangle and 4 for each cell that it touches, 16 a vertex.
#include "mesh/gpu/voxelise.hpp"

#include "mesh/gpu/whole_mesh.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/voxel_layout.h"
#include "mesh_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace sinew::mesh::gpu {
namespace {

using BufferId = Job::BufferId;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t linesOfColumn = 16, samplesOfCell = 64, wordsOfCell = 2, wordBits = 32;

std::uint64_t inBlocks(std::uint64_t count, std::uint64_t block) {
    return (count + block - 1) / block;
}

/// One kind of samples: centres of cells, or fill samples of hull cells. `lines` per column of cells.
struct Samples {
    const vk::ShaderCode *judge, *wind;
    std::uint32_t lines;
    BufferId votes, totals, inside, doubtful, count;
    std::uint64_t words;
};

/// One voxelisation: its stages, and the buffers that several stages use.
class Stages {
public:
    Stages(Job& job, const PlacedMesh& placed, const WholeMesh& whole);
    void markHull();
    void vote();
    void decide(const PlacedMesh& placed);
    void read(VoxelGrid& grid);

private:
    void mark(const vk::ShaderCode& code, std::initializer_list<BufferId> buffers);
    void scan(BufferId cells, std::uint64_t count);
    Samples makeSamples(const vk::ShaderCode& judge, const vk::ShaderCode& wind, std::uint32_t lines,
                        std::uint64_t slots, std::uint64_t words);

    Job& job_;
    const WholeMesh& whole_;
    std::uint64_t cellCount_;
    layout::VoxelPush push_;
    std::array<std::uint64_t, 3> columns_; ///< number of columns of cells, by axis
    BufferId vertices_, triangles_, rowStarts_, cells_, total_, touching_, hullCells_;
    std::uint32_t hullCount_ = 0;
    std::vector<Samples> samples_; ///< centres of cells, then fill samples of hull cells
};

Stages::Stages(Job& job, const PlacedMesh& placed, const WholeMesh& whole)
    : job_(job), whole_(whole),
      cellCount_(placed.grid.voxels.size()), push_{.cellsX = placed.grid.cells[0],
                                                   .cellsY = placed.grid.cells[1],
                                                   .cellsZ = placed.grid.cells[2],
                                                   .fractionBits = whole.fractionBits,
                                                   .cellCount = static_cast<std::uint32_t>(cellCount_)},
      columns_{cellCount_ / push_.cellsX, cellCount_ / push_.cellsY, cellCount_ / push_.cellsZ},
      vertices_(job.upload("vertices", std::span(whole.vertices))),
      triangles_(job.upload("triangles", std::span(whole.triangles))),
      rowStarts_(job.upload("row_starts", std::span(whole.rowStarts))),
      cells_(job.scratch<layout::VoxelCell>("cells", cellCount_)) {}

void Stages::mark(const vk::ShaderCode& code, std::initializer_list<BufferId> buffers) {
    for (const WholeMesh::Batch& batch : whole_.batches) {
        push_.triangle = batch.first;
        push_.triangleCount = batch.count;
        job_.dispatch(code, batch.rows, buffers, push_);
    }
}

/// Prefix sum: scans blocks, then the sums of blocks in the same way, then adds the sum before each block to
/// its cells.
void Stages::scan(BufferId cells, std::uint64_t count) {
    const std::uint64_t blockCount = inBlocks(count, VOXEL_SCAN_BLOCK);
    const BufferId blocks = job_.scratch<layout::VoxelCell>("blocks", blockCount);
    layout::VoxelPush push = push_;
    push.cellCount = static_cast<std::uint32_t>(count);
    job_.dispatch(kernels::scanCells, blockCount * GROUP_ITEMS, {cells, blocks}, push);
    if (blockCount == 1) {
        total_ = blocks;
        return;
    }
    scan(blocks, blockCount);
    job_.dispatch(kernels::addBlocks, count, {cells, blocks}, push);
}

void Stages::markHull() {
    job_.fill(cells_, 0);
    mark(kernels::markHull, {vertices_, triangles_, rowStarts_, cells_});
    scan(cells_, cellCount_);
    job_.run();
    const layout::VoxelCell total = job_.download<layout::VoxelCell>(total_).front();
    hullCount_ = total.hull;
    touching_ = job_.scratch<std::uint32_t>("touching", total.end);
    hullCells_ = job_.scratch<std::uint32_t>("hull_cells", hullCount_);
}

Samples Stages::makeSamples(const vk::ShaderCode& judge, const vk::ShaderCode& wind, std::uint32_t lines,
                            std::uint64_t slots, std::uint64_t words) {
    return {.judge = &judge,
            .wind = &wind,
            .lines = lines,
            .votes = job_.scratch<std::uint32_t>("votes", slots),
            .totals =
                job_.scratch<std::uint32_t>("totals", (columns_[0] + columns_[1] + columns_[2]) * lines),
            .inside = job_.scratch<std::uint32_t>("inside", words),
            .doubtful = job_.scratch<std::uint32_t>("doubtful", words),
            .count = job_.scratch<std::uint32_t>("doubtful_count", 1),
            .words = words};
}

void Stages::vote() {
    mark(kernels::listHullTriangles, {vertices_, triangles_, rowStarts_, cells_, touching_});
    job_.dispatch(kernels::listHull, cellCount_, {cells_, hullCells_}, push_);
    const Samples centers = makeSamples(kernels::judgeCenters, kernels::windCenters, 1, cellCount_,
                                        inBlocks(cellCount_, wordBits));
    const Samples fill =
        makeSamples(kernels::countVotes, kernels::computeWinding, linesOfColumn,
                    std::uint64_t{hullCount_} * linesOfColumn, std::uint64_t{hullCount_} * wordsOfCell);
    const BufferId links =
        job_.scratch<std::uint32_t>("links", std::ranges::max(columns_) + std::uint64_t{hullCount_});
    for (push_.axis = 0; push_.axis < 3; ++push_.axis) {
        job_.dispatch(kernels::voteCenters, columns_[push_.axis],
                      {vertices_, triangles_, cells_, touching_, centers.votes, centers.totals, links},
                      push_);
        job_.dispatch(kernels::traceLines, columns_[push_.axis] * linesOfColumn,
                      {vertices_, triangles_, cells_, touching_, fill.votes, fill.totals, links, hullCells_},
                      push_);
    }
    samples_ = {centers, fill};
    for (const Samples& samples : samples_) {
        job_.fill(samples.count, 0);
        job_.dispatch(*samples.judge, samples.words,
                      {cells_, hullCells_, samples.votes, samples.totals, samples.inside, samples.doubtful,
                       samples.count},
                      push_);
    }
    job_.run();
}

std::vector<layout::WindingNode> nodesOf(const TriangleTree& tree) {
    std::vector<layout::WindingNode> nodes;
    for (const TriangleTree::FlatNode& node : tree.flatten()) {
        const Vec3 center = toVec3(node.center), dipole = toVec3(node.dipole / (4 * std::numbers::pi));
        nodes.push_back({.center = {center.x, center.y, center.z, static_cast<float>(node.farSquared)},
                         .dipole = {dipole.x, dipole.y, dipole.z, 0},
                         .next = node.next,
                         .first = node.first,
                         .count = node.count});
    }
    return nodes;
}

void Stages::decide(const PlacedMesh& placed) {
    std::vector<std::uint32_t> counts;
    for (const Samples& samples : samples_)
        counts.push_back(job_.download<std::uint32_t>(samples.count).front());
    if (std::ranges::all_of(counts, [](std::uint32_t count) { return count == 0; })) return;
    const TriangleTree tree(placed.positions, placed.mesh.triangles);
    const std::vector<layout::WindingNode> nodes = nodesOf(tree);
    const BufferId nodeBuffer = job_.upload("nodes", std::span(nodes));
    const Words order = tree.order();
    const BufferId orderBuffer = job_.upload("order", std::span(order));
    push_.nodeCount = static_cast<std::uint32_t>(nodes.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Samples& samples = samples_[i];
        const BufferId list = job_.scratch<std::uint32_t>("doubtful_samples", counts[i]);
        job_.fill(samples.count, 0);
        job_.dispatch(kernels::listUndecided, samples.words, {samples.doubtful, samples.count, list}, push_);
        job_.dispatch(*samples.wind, counts[i],
                      {vertices_, triangles_, nodeBuffer, orderBuffer, hullCells_, list, samples.inside},
                      push_);
    }
    job_.run();
}

void Stages::read(VoxelGrid& grid) {
    const Words hullCells = job_.download<std::uint32_t>(hullCells_);
    const Words core = job_.download<std::uint32_t>(samples_[0].inside);
    const Words doubtfulCenters = job_.download<std::uint32_t>(samples_[0].doubtful);
    const Words fill = job_.download<std::uint32_t>(samples_[1].inside);
    const Words doubtful = job_.download<std::uint32_t>(samples_[1].doubtful);
    grid.hullCount = hullCount_;
    double cells = 0; // filled cells, as a sum of shares
    for (std::size_t i = 0; i < hullCount_; ++i) {
        grid.voxels[hullCells[i]] = Voxel::hull;
        const float share =
            static_cast<float>(std::popcount(fill[2 * i]) + std::popcount(fill[2 * i + 1])) / samplesOfCell;
        grid.fill[hullCells[i]] = share;
        grid.doubtful += (doubtful[2 * i] | doubtful[2 * i + 1]) != 0 ? 1 : 0;
        cells += double{share};
    }
    for (std::size_t word = 0; word < core.size(); ++word) {
        grid.doubtful += static_cast<std::size_t>(std::popcount(doubtfulCenters[word]));
        for (std::uint32_t bits = core[word]; bits != 0; bits &= bits - 1) {
            const std::size_t cell = word * wordBits + static_cast<std::size_t>(std::countr_zero(bits));
            grid.voxels[cell] = Voxel::core;
            grid.fill[cell] = 1;
            ++grid.coreCount;
        }
    }
    grid.filledVolume = (cells + static_cast<double>(grid.coreCount)) * std::pow(double{grid.spacing}, 3);
}

} // namespace

VoxelGrid Voxeliser::operator()(const TriangleMesh& mesh, const VoxelRequest& request) {
    PlacedMesh placed = placeGrid(mesh, request);
    const WholeMesh whole = toWholeNumbers(placed);
    Job job(device_, queue_, kernels_);
    Stages stages(job, placed, whole);
    stages.markHull();
    stages.vote();
    stages.decide(placed);
    stages.read(placed.grid);
    placed.grid.workBytes = job.bytes();
    return std::move(placed.grid);
}

} // namespace sinew::mesh::gpu
