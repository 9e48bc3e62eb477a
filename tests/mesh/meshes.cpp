// The winding number is computed from its formula and shares no code with TriangleTree.
#include "meshes.hpp"

#include "mesh/place_grid.hpp"

#include <cmath>
#include <numbers>

namespace sinew::mesh::test {

TriangleMesh box(Vec3 low, Vec3 high) {
    TriangleMesh mesh{.name = "box"};
    for (unsigned corner = 0; corner < 8; ++corner)
        mesh.positions.push_back({(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                  (corner & 4) != 0 ? high.z : low.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh moved(TriangleMesh mesh, Vec3 offset) {
    for (Vec3& p : mesh.positions) p = {p.x + offset.x, p.y + offset.y, p.z + offset.z};
    return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, float factor) {
    for (Vec3& p : mesh.positions) p = {p.x * factor, p.y * factor, p.z * factor};
    return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh mesh = a;
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto& [i, j, k] : b.triangles) mesh.triangles.push_back({first + i, first + j, first + k});
    return mesh;
}

TriangleMesh unwelded(const TriangleMesh& mesh) {
    TriangleMesh result{.name = mesh.name, .objects = mesh.objects, .objectNames = mesh.objectNames};
    for (const auto& triangle : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        for (const std::uint32_t vertex : triangle) result.positions.push_back(mesh.positions[vertex]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

TriangleMesh openedAbove(const TriangleMesh& mesh, float height) {
    TriangleMesh result{.name = mesh.name, .positions = mesh.positions};
    for (const auto& [a, b, c] : mesh.triangles)
        if ((mesh.positions[a].y + mesh.positions[b].y + mesh.positions[c].y) / 3 <= height)
            result.triangles.push_back({a, b, c});
    return result;
}

TriangleMesh withFlipped(TriangleMesh mesh, std::size_t step) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += step)
        std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    return mesh;
}

TriangleMesh inverted(TriangleMesh mesh) {
    return withFlipped(std::move(mesh), 1);
}

double windingNumber(const TriangleMesh& mesh, const Vector3& point) {
    double turns = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vector3 a = toVector(mesh.positions[i]) - point, b = toVector(mesh.positions[j]) - point,
                      c = toVector(mesh.positions[k]) - point;
        Eigen::Matrix3d corners;
        corners << a, b, c;
        turns += 2 * std::atan2(corners.determinant(), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                           b.dot(c) * a.norm() + c.dot(a) * b.norm());
    }
    return turns / (4 * std::numbers::pi);
}

std::size_t indexOf(const VoxelGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
    return i + grid.cells[0] * (j + std::size_t{grid.cells[1]} * k);
}

std::vector<std::size_t> cellsOfSurfaceSamples(const TriangleMesh& mesh, const VoxelGrid& grid) {
    Random random(3);
    std::vector<std::size_t> cells;
    const std::vector<Vector3> positions = toCellUnits(mesh, grid);
    for (const auto& [a, b, c] : mesh.triangles)
        for (int sample = 0; sample < 30; ++sample) {
            double u = sample < 3 ? sample == 1 : random.unit(), v = sample < 3 ? sample == 2 : random.unit();
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const Vector3 x =
                positions[a] + u * (positions[b] - positions[a]) + v * (positions[c] - positions[a]);
            const auto cell = [&](Eigen::Index axis) {
                return static_cast<std::size_t>(std::floor(x[axis]));
            };
            cells.push_back(indexOf(grid, cell(0), cell(1), cell(2)));
        }
    return cells;
}

} // namespace sinew::mesh::test
