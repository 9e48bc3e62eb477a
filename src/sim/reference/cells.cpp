// V = det A with A = sum_k x_k s_k^T / 4, s_k the signs of corner k: dV/dx_k = cof(A) s_k / 4.
#include "sim/reference/cells.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <map>

namespace sinew::sim::reference {

namespace {

constexpr double recoveryStart = 0.5; // V / V0 below which there is recovery pressure

Eigen::Vector3d signs(std::size_t corner) {
    return {(corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0};
}

// Column k of the matrix of cofactors is the area spanned by the other two edges.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& edges) {
    Eigen::Matrix3d result;
    for (Eigen::Index k = 0; k < 3; ++k)
        result.col(k) =
            Eigen::Vector3d(edges.col((k + 1) % 3)).cross(Eigen::Vector3d(edges.col((k + 2) % 3)));
    return result;
}

Eigen::Matrix3d crossWith(const Eigen::Vector3d& v) {
    Eigen::Matrix3d result;
    result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return result;
}

void addCells(const Grid& grid, std::size_t index, std::vector<Cell>& cells) {
    std::map<std::uint32_t, std::uint32_t> particles; // by node
    for (std::size_t i = 0; i < grid.node.size(); ++i)
        particles[grid.node[i]] = grid.firstParticle + static_cast<std::uint32_t>(i);
    const auto [nx, ny, nz] = grid.nodes;
    for (std::uint32_t c = 0; c < grid.fill.size(); ++c) {
        if (grid.fill[c] == 0) continue;
        const std::uint32_t x = c % (nx - 1), y = c / (nx - 1) % (ny - 1), z = c / (nx - 1) / (ny - 1);
        Cell cell{.grid = index,
                  .spacing = double{grid.restLength[0]},
                  .fill = grid.fill[c] / 15.0,
                  .stiffness = double{grid.volumeStiffness},
                  .recovery = double{grid.recoveryPressure}};
        for (std::uint32_t k = 0; k < 8; ++k)
            cell.corners[k] = particles.at(x + k % 2 + nx * (y + k / 2 % 2 + ny * (z + k / 4)));
        cells.push_back(cell);
    }
}

} // namespace

std::vector<Cell> cellsOf(const Scene& scene) {
    std::vector<Cell> cells;
    for (std::size_t g = 0; g < scene.grids.size(); ++g)
        if (hasCellVolumes(scene.grids[g])) addCells(scene.grids[g], g, cells);
    return cells;
}

Corners cornersOf(const Cell& cell, const std::vector<Eigen::Vector3d>& x) {
    Corners corners;
    for (std::size_t k = 0; k < 8; ++k) corners[k] = x[cell.corners[k]];
    return corners;
}

Eigen::Matrix3d meanEdges(const Corners& x) {
    Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < 8; ++k) edges += x[k] * signs(k).transpose() / 4;
    return edges;
}

double volumeRatio(const Cell& cell, const Corners& x) {
    return meanEdges(x).determinant() / cell.restVolume();
}

Corners volumeGradient(const Corners& x) {
    const Eigen::Matrix3d areas = cofactors(meanEdges(x));
    Corners gradient;
    for (std::size_t k = 0; k < 8; ++k) gradient[k] = areas * signs(k) / 4;
    return gradient;
}

// Edges a and b of a cyclic triple (a, b, c) couple by e_a . (e_b x e_c): their block is -[e_c]x, that of b
// and a its transpose.
Eigen::Matrix3d volumeHessian(const Eigen::Matrix3d& edges, std::size_t i, std::size_t j) {
    const Eigen::Vector3d si = signs(i), sj = signs(j);
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    for (Eigen::Index c = 0; c < 3; ++c) {
        const Eigen::Index a = (c + 1) % 3, b = (c + 2) % 3;
        block += (si[b] * sj[a] - si[a] * sj[b]) / 16 * crossWith(edges.col(c));
    }
    return block;
}

double energyOf(const Cell& cell, double ratio) {
    const double missing = std::max(recoveryStart - ratio, 0.0);
    const double recovery =
        missing <= recoveryStart ? missing * missing / (2 * recoveryStart) : missing - recoveryStart / 2;
    return cell.fill * cell.restVolume() *
           (cell.stiffness / 2 * (ratio - 1) * (ratio - 1) + cell.recovery * recovery);
}

double pressureOf(const Cell& cell, double ratio) {
    const double recovery = std::clamp((recoveryStart - ratio) / recoveryStart, 0.0, 1.0);
    return cell.fill * (cell.stiffness * (1 - ratio) + cell.recovery * recovery);
}

double bulkStiffness(const Cell& cell, double ratio) {
    const bool isUnfolding = ratio > 0 && ratio < recoveryStart;
    return cell.fill * (cell.stiffness + (isUnfolding ? cell.recovery / recoveryStart : 0)) /
           cell.restVolume();
}

} // namespace sinew::sim::reference
