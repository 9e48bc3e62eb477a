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

constexpr std::size_t mostMeasured = 16;      ///< components per connected set of voxels
constexpr std::size_t coarseTriangles = 1000; ///< largest mesh whose edges are cut in pieces
constexpr std::size_t manyQueries = 100'000;  ///< from one component to another
constexpr std::size_t allQueries = 400'000;   ///< among the components of one connected set

/// Labels of connected sets of non-empty cells, from 1.
class Labels {
public:
    explicit Labels(const VoxelGrid& grid) : grid_(grid), labels_(grid.voxels.size()) {
        std::uint32_t last = 0;
        for (std::size_t cell = 0; cell < labels_.size(); ++cell)
            if (grid.voxels[cell] != Voxel::empty && labels_[cell] == 0) fill(cell, ++last);
    }

    /// Label of the cell at `point`, in cell units.
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

/// A component between which and others distances are measured.
struct Measured {
    /// A piece of an edge.
    struct Step {
        Vector3 from, to;
    };
    std::vector<Step> steps; ///< edges; those of a coarse mesh in pieces of about a voxel
    TriangleTree tree;
    Eigen::AlignedBox3d box;

    Measured(const TriangleMesh& mesh, const Component& component)
        : tree(positionsOf(mesh, component), trianglesOf(component)) {
        const std::vector<Vector3> vertices = positionsOf(mesh, component);
        for (const Vector3& vertex : vertices) box.extend(vertex);
    }

    void cut(const TriangleMesh& mesh, const Component& component, double voxel) {
        const std::vector<Vector3> vertices = positionsOf(mesh, component);
        const double most = component.triangles.size() > coarseTriangles ? 1 : 64;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vector3 from = vertices[i], edge = vertices[i % 3 == 2 ? i - 2 : i + 1] - from;
            const double pieces = std::clamp(std::ceil(edge.norm() / voxel), 1.0, most);
            for (double k = 0; k < pieces; ++k)
                steps.push_back({from + edge * (k / pieces), from + edge * ((k + 1) / pieces)});
        }
    }

private:
    /// Vertices triangle by triangle, three each.
    static std::vector<Vector3> positionsOf(const TriangleMesh& mesh, const Component& component) {
        std::vector<Vector3> vertices;
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

bool reachesInto(const Measured::Step& step, const Measured& to) {
    Eigen::AlignedBox3d box(step.from);
    box.extend(step.to);
    if (!to.box.intersects(box)) return false;
    if (to.box.contains(step.from) && std::abs(to.tree.windingNumber(step.from)) > 0.5) return true;
    const double length = (step.to - step.from).norm();
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    return length > 0 && to.tree.firstHit(step.from, (step.to - step.from) / length, none).distance <= length;
}

/// Least distance from at most `most` points on the edges of one component to the other; 0 if an edge of the
/// first meets or lies inside of the other, infinite if the distance exceeds `limit`.
double distance(const Measured& from, const Measured& to, std::size_t most, double limit) {
    const std::size_t stride = from.steps.size() / most + 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < from.steps.size(); i += stride) {
        if (reachesInto(from.steps[i], to)) return 0;
        if (to.box.exteriorDistance(from.steps[i].from) >= std::min(least, limit)) continue;
        least = std::min(least, to.tree.distance(from.steps[i].from));
    }
    return least <= limit ? least : std::numeric_limits<double>::infinity();
}

/// Adds the bridges and overlaps between the components of one connected set of voxels.
void compare(const TriangleMesh& mesh, const std::vector<const Component*>& set, double voxel,
             Bridges& bridges) {
    const double limit = 2 * std::sqrt(3.0) * voxel; // two diagonals: one voxel of each side
    std::vector<Measured> parts;
    for (std::size_t i = 0; i < set.size() && i < mostMeasured; ++i)
        parts.emplace_back(mesh, *set[i]).cut(mesh, *set[i], voxel);
    const std::size_t most = std::min(manyQueries, allQueries / (parts.size() * (parts.size() - 1)));
    std::vector<bool> isJoined(parts.size());
    for (std::size_t a = 0; a < parts.size(); ++a)
        for (std::size_t b = a + 1; b < parts.size(); ++b) {
            if (parts[a].box.exteriorDistance(parts[b].box) > limit) continue;
            const double there = distance(parts[a], parts[b], most, limit);
            const double gap = there > 0 ? std::min(there, distance(parts[b], parts[a], most, limit)) : 0;
            if (gap == 0) bridges.overlaps.push_back({set[a]->name, set[b]->name});
            if (gap == 0 || gap > limit) continue;
            isJoined[a] = isJoined[b] = true;
            if (gap >= bridges.gap) continue;
            bridges.gap = gap;
            bridges.nearest = {set[a]->name, set[b]->name};
        }
    const auto joined = static_cast<std::size_t>(std::ranges::count(isJoined, true));
    if (joined > 0) bridges.components += joined + set.size() - parts.size();
}

} // namespace

Bridges findBridges(const TriangleMesh& mesh, const std::vector<Component>& components,
                    const VoxelGrid& grid) {
    Bridges bridges{.gap = std::numeric_limits<double>::infinity()};
    if (components.size() < 2) return {};
    const Labels labels(grid);
    const std::vector<Vector3> positions = toCellUnits(mesh, grid);
    const auto labelOf = [&](const Component& component) {
        for (const std::uint32_t triangle : component.triangles)
            for (const std::uint32_t vertex : mesh.triangles[triangle])
                if (const std::uint32_t label = labels.at(positions[vertex]); label != 0) return label;
        return std::uint32_t{0}; // the component has no voxels
    };
    std::map<std::uint32_t, std::vector<const Component*>> sets;
    for (const Component& component : components)
        if (const std::uint32_t label = labelOf(component); label != 0) sets[label].push_back(&component);
    for (const auto& [label, set] : sets)
        if (set.size() > 1) compare(mesh, set, double{grid.spacing}, bridges);
    if (bridges.components == 0) bridges.gap = 0;
    return bridges;
}

} // namespace sinew::mesh
