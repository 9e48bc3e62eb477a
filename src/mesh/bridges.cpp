// Connected voxels by flood fill; distances by a tree of boxes for each component.
#include "mesh/bridges.hpp"

#include "mesh/place_grid.hpp"
#include "mesh/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace sinew::mesh {
namespace {

constexpr std::size_t mostMeasured = 16;  ///< components of one connected set of voxels
constexpr std::size_t fewVertices = 1000; ///< of a component, to find the nearest pair by
constexpr std::size_t manyVertices = 50'000;

/// Numbers connected cells that are not empty, from 1.
class Labels {
public:
    explicit Labels(const VoxelGrid& grid) : grid_(grid), labels_(grid.voxels.size()) {
        std::uint32_t last = 0;
        for (std::size_t cell = 0; cell < labels_.size(); ++cell)
            if (grid.voxels[cell] != Voxel::empty && labels_[cell] == 0) fill(cell, ++last);
    }

    /// `point` in cell units.
    std::uint32_t at(const Vector3& point) const {
        std::size_t index = 0;
        for (const Eigen::Index axis : {2, 1, 0}) {
            const double last = grid_.cells[static_cast<std::size_t>(axis)] - 1.0;
            index = index * grid_.cells[static_cast<std::size_t>(axis)] +
                    static_cast<std::size_t>(std::clamp(std::floor(point[axis]), 0.0, last));
        }
        return labels_[index];
    }

private:
    void fill(std::size_t first, std::uint32_t label) {
        labels_[first] = label;
        std::vector<std::size_t> open{first};
        while (!open.empty()) {
            const std::size_t cell = open.back();
            open.pop_back();
            visitAround(cell, [&](std::size_t other) {
                if (grid_.voxels[other] == Voxel::empty || labels_[other] != 0) return;
                labels_[other] = label;
                open.push_back(other);
            });
        }
    }

    template <typename Visit> void visitAround(std::size_t cell, const Visit& visit) const {
        const auto [x, y, z] = grid_.cells;
        const std::array<std::size_t, 3> at{cell % x, cell / x % y, cell / x / y};
        const auto low = [&](std::size_t axis) { return at[axis] - (at[axis] > 0 ? 1 : 0); };
        const auto high = [&](std::size_t axis) {
            return std::min<std::size_t>(at[axis] + 1, grid_.cells[axis] - 1);
        };
        for (std::size_t k = low(2); k <= high(2); ++k)
            for (std::size_t j = low(1); j <= high(1); ++j)
                for (std::size_t i = low(0); i <= high(0); ++i) visit(i + x * (j + y * k));
    }

    const VoxelGrid& grid_;
    std::vector<std::uint32_t> labels_;
};

/// A component to measure distances from and to.
struct Measured {
    std::vector<Vector3> vertices; ///< three of each triangle
    TriangleTree tree;
    Eigen::AlignedBox3d box;

    Measured(const TriangleMesh& mesh, const Component& component)
        : tree(positionsOf(mesh, component, vertices), trianglesOf(component)) {
        for (const Vector3& vertex : vertices) box.extend(vertex);
    }

private:
    /// Three of each triangle in a row.
    static std::vector<Vector3> positionsOf(const TriangleMesh& mesh, const Component& component,
                                            std::vector<Vector3>& vertices) {
        for (const std::uint32_t triangle : component.triangles)
            for (const std::uint32_t vertex : mesh.triangles[triangle])
                vertices.push_back(toVector(mesh.positions[vertex]));
        return vertices;
    }
    static TriangleTree::Triangles trianglesOf(const Component& component) {
        TriangleTree::Triangles triangles;
        for (std::uint32_t i = 0; i < component.triangles.size(); ++i)
            triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        return triangles;
    }
};

/// Least distance from at most `most` vertices of one to the other; 0 where one of them lies inside of it.
double distance(const Measured& from, const Measured& to, std::size_t most) {
    const std::size_t stride = from.vertices.size() / most + 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < from.vertices.size(); i += stride) {
        if (to.box.contains(from.vertices[i]) && std::abs(to.tree.windingNumber(from.vertices[i])) > 0.5)
            return 0;
        if (to.box.exteriorDistance(from.vertices[i]) >= least) continue; // and so are all of its triangles
        least = std::min(least, to.tree.distance(from.vertices[i]));
    }
    return least;
}

/// The least distance of two that do not touch; infinite where all touch.
double gapOf(const std::vector<Measured>& parts) {
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < parts.size(); ++a)
        for (std::size_t b = a + 1; b < parts.size(); ++b) {
            if (parts[a].box.exteriorDistance(parts[b].box) >= gap) continue;
            const auto both = [&](std::size_t most) {
                return std::min(distance(parts[a], parts[b], most), distance(parts[b], parts[a], most));
            };
            const double rough = both(fewVertices);
            if (rough == 0 || rough > 2 * gap) continue;
            const double exact = both(manyVertices);
            if (exact > 0) gap = std::min(gap, exact);
        }
    return gap;
}

} // namespace

Bridges findBridges(const TriangleMesh& mesh, const std::vector<Component>& components,
                    const VoxelGrid& grid) {
    Bridges bridges{.gap = std::numeric_limits<double>::infinity()};
    if (components.size() < 2) return {};
    const Labels labels(grid);
    const std::vector<Vector3> positions = toCellUnits(mesh, grid);
    std::map<std::uint32_t, std::vector<const Component*>> sets;
    for (const Component& component : components)
        sets[labels.at(positions[mesh.triangles[component.triangles.front()][0]])].push_back(&component);
    for (const auto& [label, set] : sets) {
        if (set.size() < 2) continue;
        std::vector<Measured> parts;
        for (std::size_t i = 0; i < set.size() && i < mostMeasured; ++i) parts.emplace_back(mesh, *set[i]);
        const double gap = gapOf(parts);
        if (!std::isfinite(gap)) continue;
        bridges.components += set.size();
        bridges.gap = std::min(bridges.gap, gap);
    }
    return bridges.components > 0 ? bridges : Bridges{};
}

} // namespace sinew::mesh
