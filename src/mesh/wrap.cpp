// The wrapped surface is a net around samples that lie inside (mesh/surface_nets), placed by their distances
// from the mesh. All lengths are in cells of the grid.
#include "mesh/wrap.hpp"

#include "mesh/components.hpp"
#include "mesh/inside.hpp"
#include "mesh/place_grid.hpp"
#include "mesh/surface_nets.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::mesh {
namespace {

using Index3 = std::array<std::uint32_t, 3>;

constexpr std::uint32_t perCell = 2;    ///< samples along an edge of a cell
constexpr double apart = 1.0 / perCell; ///< distance between neighbouring samples
constexpr std::uint32_t rim = 2;        ///< layers of samples around the grid
constexpr double farAway = 2;           ///< replaces the distance of samples without a near surface
/// Components that are nowhere this deep could fall between samples: they are thickened until they are.
constexpr double leastDepth = 0.45;
/// Open components of less area are too narrow to be thickened by themselves: triangles of a file in which no
/// two share corners [cells^2].
constexpr double leastArea = 4;
constexpr std::uint32_t nobody = ~0u, debris = nobody - 1; ///< label of far samples; of narrow components

/// Signed distances at the samples of a grid and of a rim around it, negative inside.
class Field {
public:
    Field(const TriangleMesh& mesh, const VoxelGrid& grid)
        : positions_(toCellUnits(mesh, grid)), tree_(positions_, mesh.triangles),
          componentOf_(mesh.triangles.size(), debris) {
        std::uint32_t number = 0;
        for (const Component& component : components(mesh)) {
            if (!component.isClosed && areaOf(mesh, component) < leastArea) continue;
            for (const std::uint32_t triangle : component.triangles) componentOf_[triangle] = number;
            ++number;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) count_[axis] = perCell * grid.cells[axis] + 2 * rim;
        values_.assign(std::size_t{count_[0]} * count_[1] * count_[2], farAway);
        const Inside inside(positions_, mesh.triangles, tree_, grid.cells, perCell);
        std::vector<bool> isNear(values_.size());
        nearest_.assign(values_.size(), nobody);
        forEach([&](const Index3& at) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (at[axis] < rim || at[axis] + rim >= count_[axis]) return;
            const Index3 sample{at[0] - rim, at[1] - rim, at[2] - rim};
            if (inside(sample).isInside) values_[index(at)] = -farAway;
            if (grid.voxels[sample[0] / perCell +
                            grid.cells[0] * (sample[1] / perCell + std::size_t{grid.cells[1]} *
                                                                       (sample[2] / perCell))] == Voxel::hull)
                forAround(at, rim, [&](std::size_t other) { isNear[other] = true; });
        });
        measure(isNear);
        thicken();
        nearest_ = {};
    }

    bool isEmpty() const {
        return std::ranges::none_of(values_, [](double value) { return value < 0; });
    }

    Eigen::AlignedBox3d box() const {
        return {placeOf({0, 0, 0}), placeOf({count_[0] - 1, count_[1] - 1, count_[2] - 1})};
    }

    /// Trilinear interpolation between samples; constant beyond the last ones.
    double operator()(const Vector3& x) const {
        Index3 low{};
        Vector3 share;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<Eigen::Index>(axis);
            const double most = count_[axis] - 1;
            const double place = std::clamp((x[n] - placeOf({0, 0, 0})[n]) / apart, 0.0, most);
            low[axis] = std::min(static_cast<std::uint32_t>(place), count_[axis] - 2);
            share[n] = place - low[axis];
        }
        double sum = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            double weight = 1;
            Index3 at = low;
            for (unsigned axis = 0; axis < 3; ++axis) {
                const bool isHigh = (corner >> axis & 1) != 0;
                at[axis] += isHigh ? 1 : 0;
                weight *= isHigh ? share[axis] : 1 - share[axis];
            }
            sum += weight * values_[index(at)];
        }
        return sum;
    }

private:
    std::size_t index(const Index3& at) const {
        return at[0] + count_[0] * (at[1] + std::size_t{count_[1]} * at[2]);
    }
    Vector3 placeOf(const Index3& at) const {
        return apart * (Vector3(at[0], at[1], at[2]) - Vector3::Constant(rim - 0.5));
    }

    template <typename Visit> void forEach(const Visit& visit) const {
        for (std::uint32_t k = 0; k < count_[2]; ++k)
            for (std::uint32_t j = 0; j < count_[1]; ++j)
                for (std::uint32_t i = 0; i < count_[0]; ++i) visit(Index3{i, j, k});
    }

    /// Calls visit(index) for a sample and its neighbours up to `reach` away along each axis.
    template <typename Visit>
    void forAround(const Index3& at, std::uint32_t reach, const Visit& visit) const {
        const auto low = [&](std::size_t axis) { return at[axis] - std::min(at[axis], reach); };
        const auto high = [&](std::size_t axis) { return std::min(at[axis] + reach, count_[axis] - 1); };
        for (std::uint32_t k = low(2); k <= high(2); ++k)
            for (std::uint32_t j = low(1); j <= high(1); ++j)
                for (std::uint32_t i = low(0); i <= high(0); ++i) visit(index({i, j, k}));
    }

    /// Computes distances of samples near the mesh, and of those where inside and outside meet in a hole of
    /// it.
    void measure(const std::vector<bool>& isNear) {
        std::vector<bool> isBeside(values_.size());
        forEach([&](const Index3& at) {
            bool meets = false;
            forAround(at, 1, [&](std::size_t other) {
                meets = meets || (values_[other] < 0) != (values_[index(at)] < 0);
            });
            if (meets) forAround(at, 1, [&](std::size_t other) { isBeside[other] = true; });
        });
        forEach([&](const Index3& at) {
            if (!isNear[index(at)] && !isBeside[index(at)]) return;
            double& value = values_[index(at)];
            const TriangleTree::Nearest found = tree_.nearest(placeOf(at));
            value = std::copysign(std::max(distance(placeOf(at), found.distance), 1e-6), value);
            if (isNear[index(at)]) nearest_[index(at)] = componentOf_[found.triangle];
        });
    }

    /// Thickens thin components. A sample belongs to the component nearest to it, so that a thick component
    /// beside a thin one does not keep it thin. Narrow open components belong to whatever is around them.
    void thicken() {
        const std::vector<double> given = values_;
        forEach([&](const Index3& at) {
            const std::uint32_t own = nearest_[index(at)];
            if (own == nobody) return;
            double depth = 0;
            forAround(at, perCell, [&](std::size_t other) {
                if (nearest_[other] == own || nearest_[other] == nobody || own == debris)
                    depth = std::max(depth, -given[other]);
            });
            if (depth < leastDepth)
                values_[index(at)] =
                    std::min(given[index(at)], tree_.distance(placeOf(at)) - (leastDepth - depth));
        });
    }

    /// Distance for the field. In a hole the surface is far: there the winding number, which falls from 1 to
    /// 0 across the hole, gives the distance from its middle.
    double distance(const Vector3& x, double fromMesh) const {
        if (fromMesh < apart) return fromMesh;
        return std::min(fromMesh, farAway * std::abs(0.5 - std::abs(tree_.windingNumber(x))));
    }

    /// Area of a component [cells^2].
    double areaOf(const TriangleMesh& mesh, const Component& component) const {
        double area = 0;
        for (const std::uint32_t triangle : component.triangles) {
            const auto& [a, b, c] = mesh.triangles[triangle];
            area += (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]).norm() / 2;
        }
        return area;
    }

    std::vector<Vector3> positions_;
    TriangleTree tree_;
    std::vector<std::uint32_t> componentOf_; ///< by triangle
    std::vector<std::uint32_t> nearest_;     ///< temporary: component nearest to each sample near the mesh
    Index3 count_{};
    std::vector<double> values_;
};

} // namespace

TriangleMesh wrap(const TriangleMesh& mesh, const VoxelGrid& grid) {
    const Field field(mesh, grid);
    if (field.isEmpty()) return {.name = mesh.name};
    TriangleMesh result = isosurface(std::cref(field), field.box(), apart);
    result.name = mesh.name;
    for (Vec3& position : result.positions)
        position = toVec3(toVector(grid.origin) + double{grid.spacing} * toVector(position));
    return result;
}

} // namespace sinew::mesh
