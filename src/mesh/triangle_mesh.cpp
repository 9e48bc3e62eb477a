// Welding, topology and measures of triangle meshes. Results come from sorting, not from the order of a hash
// table: the same bytes on each run.
#include "mesh/triangle_mesh.hpp"

#include "mesh/topology.hpp"
#include "mesh/vector3.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>

namespace sinew::mesh {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Bit patterns of a position, and its vertex; -0 counts as 0.
struct Place {
    std::array<std::uint32_t, 3> bits;
    std::uint32_t vertex = 0;
    auto operator<=>(const Place&) const = default;
};

/// For each vertex the first vertex with the same position.
std::vector<std::uint32_t> findTwins(const std::vector<Vec3>& positions) {
    std::vector<Place> places;
    places.reserve(positions.size());
    for (const Vec3& p : positions)
        places.push_back({{std::bit_cast<std::uint32_t>(p.x + 0.0f), std::bit_cast<std::uint32_t>(p.y + 0.0f),
                           std::bit_cast<std::uint32_t>(p.z + 0.0f)},
                          static_cast<std::uint32_t>(places.size())});
    std::ranges::sort(places);
    std::vector<std::uint32_t> twins(positions.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool isTwin = i > 0 && places[i].bits == places[i - 1].bits;
        twins[places[i].vertex] = isTwin ? twins[places[i - 1].vertex] : places[i].vertex;
    }
    return twins;
}

/// True for a triangle without area. Differences of floats and their products are exact in double if
/// exponents are near each other, so a triangle is degenerate only if its corners really lie on a line;
/// slivers stay.
bool isDegenerate(const TriangleMesh& mesh, const Triangle& triangle) {
    const auto [a, b, c] = triangle;
    if (a == b || b == c || c == a) return true;
    const Vector3 origin = toVector(mesh.positions[a]);
    return (toVector(mesh.positions[b]) - origin).cross(toVector(mesh.positions[c]) - origin).isZero(0);
}

/// Marks each triangle at an edge that repeats an earlier one there: the same direction along the edge and
/// the same third corner.
void findDuplicates(const std::vector<Triangle>& triangles, std::span<const HalfEdge> sides,
                    std::vector<bool>& isDuplicate) {
    const auto thirdOf = [&](const HalfEdge& side) {
        const auto [a, b, c] = triangles[side.triangle];
        return a ^ b ^ c ^ side.low ^ side.high;
    };
    std::vector<std::tuple<bool, std::uint32_t, std::uint32_t>> order;
    for (const HalfEdge& side : sides) order.push_back({side.isForward, thirdOf(side), side.triangle});
    std::ranges::sort(order);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (std::get<0>(order[i]) == std::get<0>(order[i - 1]) &&
            std::get<1>(order[i]) == std::get<1>(order[i - 1]))
            isDuplicate[std::get<2>(order[i])] = true;
}

/// Marks each triangle that repeats an earlier one; counts the edges of the mesh including such triangles.
std::vector<bool> checkEdges(const std::vector<Triangle>& triangles, MeshDefects& defects) {
    std::vector<bool> isDuplicate(triangles.size());
    forEachEdge(triangles, [&](std::span<const HalfEdge> sides) {
        const bool isFlipped = sides.size() == 2 && sides[0].isForward == sides[1].isForward;
        if (sides.size() == 1) ++defects.boundaryEdges;
        if (sides.size() > 2) ++defects.nonManifoldEdges;
        if (isFlipped) ++defects.flippedEdges;
        if (isFlipped || sides.size() > 2) findDuplicates(triangles, sides, isDuplicate);
    });
    return isDuplicate;
}

void keepTriangles(TriangleMesh& mesh, const std::vector<bool>& isKept) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < isKept.size(); ++i) {
        if (!isKept[i]) continue;
        if (!mesh.objects.empty()) mesh.objects[kept] = mesh.objects[i];
        if (!mesh.parts.empty()) mesh.parts[kept] = mesh.parts[i];
        if (!mesh.textureCoordinates.empty()) mesh.textureCoordinates[kept] = mesh.textureCoordinates[i];
        mesh.triangles[kept++] = mesh.triangles[i];
    }
    mesh.triangles.resize(kept);
    if (!mesh.objects.empty()) mesh.objects.resize(kept);
    if (!mesh.parts.empty()) mesh.parts.resize(kept);
    if (!mesh.textureCoordinates.empty()) mesh.textureCoordinates.resize(kept);
}

/// Removes vertices that no triangle uses.
TriangleMesh compacted(const TriangleMesh& mesh) {
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(mesh.positions.size(), unused);
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) number[vertex] = 0;
    TriangleMesh result{.name = mesh.name,
                        .objects = mesh.objects,
                        .objectNames = mesh.objectNames,
                        .parts = mesh.parts,
                        .textureCoordinates = mesh.textureCoordinates};
    for (std::size_t vertex = 0; vertex < number.size(); ++vertex)
        if (number[vertex] != unused) {
            number[vertex] = static_cast<std::uint32_t>(result.positions.size());
            result.positions.push_back(mesh.positions[vertex]);
        }
    result.triangles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        result.triangles.push_back({number[a], number[b], number[c]});
    return result;
}

} // namespace

void flip(TriangleMesh& mesh, std::size_t triangle) {
    std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
    if (mesh.textureCoordinates.empty()) return;
    std::swap(mesh.textureCoordinates[triangle][1], mesh.textureCoordinates[triangle][2]);
}

TriangleMesh weld(const TriangleMesh& mesh, MeshDefects& defects, std::vector<Vec3>* dropped) {
    defects = {};
    TriangleMesh joined = mesh;
    const std::vector<std::uint32_t> twins = findTwins(mesh.positions);
    std::vector<bool> isKept(joined.triangles.size());
    for (std::size_t i = 0; i < isKept.size(); ++i) {
        for (std::uint32_t& vertex : joined.triangles[i]) vertex = twins[vertex];
        isKept[i] = !isDegenerate(joined, joined.triangles[i]);
    }
    const auto drop = [&](const std::vector<bool>& isStaying) {
        for (std::size_t i = 0; dropped && i < isStaying.size(); ++i)
            if (!isStaying[i]) dropped->push_back(joined.positions[joined.triangles[i][0]]);
        keepTriangles(joined, isStaying);
    };
    defects.degenerateTriangles = static_cast<std::size_t>(std::ranges::count(isKept, false));
    drop(isKept);
    MeshDefects edges;
    std::vector<bool> isUnique = checkEdges(joined.triangles, edges);
    isUnique.flip();
    defects.duplicateTriangles = static_cast<std::size_t>(std::ranges::count(isUnique, false));
    if (defects.duplicateTriangles > 0) {
        drop(isUnique);
        edges = {};
        checkEdges(joined.triangles, edges);
    }
    defects.boundaryEdges = edges.boundaryEdges;
    defects.nonManifoldEdges = edges.nonManifoldEdges;
    defects.flippedEdges = edges.flippedEdges;
    return compacted(joined);
}

TriangleMesh keep(const TriangleMesh& mesh, const std::vector<bool>& isKept) {
    TriangleMesh kept = mesh;
    keepTriangles(kept, isKept);
    return compacted(kept);
}

MeshReport measure(const TriangleMesh& mesh) {
    MeshReport report;
    if (mesh.positions.empty()) return report;
    Vector3 low = toVector(mesh.positions.front()), high = low;
    for (const Vec3& position : mesh.positions) {
        low = low.cwiseMin(toVector(position));
        high = high.cwiseMax(toVector(position));
    }
    report.low = toVec3(low);
    report.high = toVec3(high);
    const Vector3 middle = (low + high) / 2; // keeps the sums below accurate far from the origin
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3 x = toVector(mesh.positions[a]) - middle, y = toVector(mesh.positions[b]) - middle,
                      z = toVector(mesh.positions[c]) - middle;
        report.volume += x.dot(y.cross(z)) / 6;
        report.area += (y - x).cross(z - x).norm() / 2;
    }
    return report;
}

MeshReport inspect(const TriangleMesh& mesh) {
    MeshDefects defects;
    MeshReport report = measure(weld(mesh, defects));
    report.defects = defects;
    return report;
}

} // namespace sinew::mesh
