// Repair of seams: vertices that are equal up to rounding, and T-junctions. Only vertices of open edges are
// processed, so that a closed mesh costs nothing and no closed part is changed.
#include "mesh/point_tree.hpp"
#include "mesh/repair_steps.hpp"

#include <cmath>
#include <limits>

namespace sinew::mesh {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

double lengthOf(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
    return (toVector(mesh.positions[a]) - toVector(mesh.positions[b])).norm();
}

/// Welding distance of each vertex.
std::vector<float> findReaches(const TriangleMesh& mesh, double tolerance) {
    std::vector<float> reaches(mesh.positions.size(), 0);
    for (const auto& [a, b, c] : mesh.triangles) {
        const double longest = std::max({lengthOf(mesh, a, b), lengthOf(mesh, b, c), lengthOf(mesh, c, a)});
        const auto reach = static_cast<float>(std::min(tolerance, longest / 4));
        for (const std::uint32_t vertex : {a, b, c}) reaches[vertex] = std::max(reaches[vertex], reach);
    }
    return reaches;
}

/// A triangle whose edge after corner `corner` is split at `points`, in order along the edge.
struct Split {
    std::uint32_t triangle = 0;
    std::size_t corner = 0;
    std::vector<std::uint32_t> points;
};

/// The neighbours of each vertex along open edges.
class OpenNeighbours {
public:
    explicit OpenNeighbours(const std::vector<OpenEdge>& edges) {
        for (const OpenEdge& edge : edges) {
            pairs_.push_back({edge.from, edge.to});
            pairs_.push_back({edge.to, edge.from});
        }
        std::ranges::sort(pairs_);
    }
    template <typename Test> bool any(std::uint32_t vertex, const Test& test) const {
        auto pair = std::ranges::lower_bound(pairs_, std::array{vertex, std::uint32_t{0}});
        for (; pair != pairs_.end() && (*pair)[0] == vertex; ++pair)
            if (test((*pair)[1])) return true;
        return false;
    }

private:
    std::vector<std::array<std::uint32_t, 2>> pairs_;
};

class JunctionFinder {
public:
    JunctionFinder(const TriangleMesh& mesh, const std::vector<OpenEdge>& edges, double tolerance)
        : mesh_(mesh), neighbours_(edges), tree_(mesh.positions, verticesOf(edges)), tolerance_(tolerance) {}

    /// Vertices at which `edge` must be split, in order along it.
    std::vector<std::uint32_t> pointsOn(const OpenEdge& edge) const {
        const Vector3 a = at(edge.from), b = at(edge.to);
        const double reach = std::min(tolerance_, (b - a).norm() / 4);
        std::vector<std::uint32_t> found;
        tree_.findNear(a, b, reach, found);
        std::vector<std::pair<double, std::uint32_t>> points;
        for (const std::uint32_t vertex : found) {
            if (std::ranges::find(mesh_.triangles[edge.triangle], vertex) !=
                mesh_.triangles[edge.triangle].end())
                continue;
            const Vector3 point = at(vertex);
            if ((point - a).norm() <= reach || (point - b).norm() <= reach) continue;
            if (runsAlong(edge, vertex, reach)) points.push_back({nearestOnSegment(a, b, point).at, vertex});
        }
        std::ranges::sort(points);
        std::vector<std::uint32_t> result;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (i == 0 || points[i].first > points[i - 1].first) result.push_back(points[i].second);
        return result;
    }

private:
    Vector3 at(std::uint32_t vertex) const { return toVector(mesh_.positions[vertex]); }

    /// True if an open edge at `vertex` overlaps `edge`.
    bool runsAlong(const OpenEdge& edge, std::uint32_t vertex, double reach) const {
        const Vector3 a = at(edge.from), b = at(edge.to), point = at(vertex);
        return neighbours_.any(vertex, [&](std::uint32_t other) {
            if (other == edge.from || other == edge.to) return true;
            const Vector3 end = at(other);
            return nearestOnSegment(a, b, end).distance <= reach ||
                   nearestOnSegment(point, end, a).distance <= reach ||
                   nearestOnSegment(point, end, b).distance <= reach;
        });
    }

    const TriangleMesh& mesh_;
    OpenNeighbours neighbours_;
    PointTree tree_;
    double tolerance_;
};

std::vector<Triangle> pieces(const Triangle& triangle, const Split& split) {
    const std::uint32_t end = triangle[(split.corner + 1) % 3], apex = triangle[(split.corner + 2) % 3];
    std::vector<Triangle> result;
    std::uint32_t from = triangle[split.corner];
    for (const std::uint32_t point : split.points) {
        result.push_back({from, point, apex});
        from = point;
    }
    result.push_back({from, end, apex});
    return result;
}

/// Texture coordinates of these pieces: linear along the edge.
std::vector<sim::TextureCorners> texturePieces(const TriangleMesh& mesh, const Split& split) {
    const Triangle& triangle = mesh.triangles[split.triangle];
    const sim::TextureCorners& whole = mesh.textureCoordinates[split.triangle];
    const std::size_t start = split.corner, end = (start + 1) % 3;
    const Vector3 a = toVector(mesh.positions[triangle[start]]), b = toVector(mesh.positions[triangle[end]]);
    std::vector<sim::TextureCorners> result;
    sim::TexturePoint from = whole[start];
    const sim::TexturePoint apex = whole[(start + 2) % 3];
    for (const std::uint32_t point : split.points) {
        const auto share = static_cast<float>(nearestOnSegment(a, b, toVector(mesh.positions[point])).at);
        const sim::TexturePoint to{whole[start].u + share * (whole[end].u - whole[start].u),
                                   whole[start].v + share * (whole[end].v - whole[start].v)};
        result.push_back({from, to, apex});
        from = to;
    }
    result.push_back({from, whole[end], apex});
    return result;
}

/// True if the corners lie exactly on a line: such a triangle would be dropped.
bool isEmpty(const TriangleMesh& mesh, const Triangle& triangle) {
    const Vector3 a = toVector(mesh.positions[triangle[0]]);
    return (toVector(mesh.positions[triangle[1]]) - a)
        .cross(toVector(mesh.positions[triangle[2]]) - a)
        .isZero(0);
}

/// One pass; true if any edge was split.
bool splitOnce(TriangleMesh& mesh, double tolerance, Places& places) {
    const std::vector<OpenEdge> edges = findOpenEdges(mesh);
    const JunctionFinder finder(mesh, edges, tolerance);
    std::vector<bool> isSplit(mesh.triangles.size());
    const std::size_t before = places.size();
    for (const OpenEdge& edge : edges) {
        if (isSplit[edge.triangle]) continue;
        const Triangle triangle = mesh.triangles[edge.triangle];
        Split split{edge.triangle, 0, finder.pointsOn(edge)};
        if (split.points.empty()) continue;
        while (triangle[split.corner] != edge.from) ++split.corner;
        const std::vector<Triangle> parts = pieces(triangle, split);
        if (std::ranges::any_of(parts, [&](const Triangle& part) { return isEmpty(mesh, part); })) continue;
        isSplit[edge.triangle] = true;
        if (!mesh.textureCoordinates.empty()) {
            const std::vector<sim::TextureCorners> corners = texturePieces(mesh, split);
            mesh.textureCoordinates[edge.triangle] = corners.front();
            mesh.textureCoordinates.insert(mesh.textureCoordinates.end(), corners.begin() + 1, corners.end());
        }
        mesh.triangles[edge.triangle] = parts.front();
        mesh.triangles.insert(mesh.triangles.end(), parts.begin() + 1, parts.end());
        if (!mesh.objects.empty()) mesh.objects.resize(mesh.triangles.size(), mesh.objects[edge.triangle]);
        if (!mesh.parts.empty()) mesh.parts.resize(mesh.triangles.size(), mesh.parts[edge.triangle]);
        places.push_back(mesh.positions[split.points.front()]);
    }
    return places.size() > before;
}

} // namespace

std::vector<OpenEdge> findOpenEdges(const TriangleMesh& mesh) {
    std::vector<OpenEdge> edges;
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        if (sides.size() != 1) return;
        const HalfEdge& side = sides.front();
        edges.push_back(
            {side.isForward ? side.low : side.high, side.isForward ? side.high : side.low, side.triangle});
    });
    return edges;
}

std::vector<std::uint32_t> verticesOf(const std::vector<OpenEdge>& edges) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(2 * edges.size());
    for (const OpenEdge& edge : edges) vertices.insert(vertices.end(), {edge.from, edge.to});
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

void joinNear(TriangleMesh& mesh, double tolerance, Places& places, VertexPairs* pairs) {
    const std::vector<std::uint32_t> vertices = verticesOf(findOpenEdges(mesh));
    const std::vector<float> reaches = findReaches(mesh, tolerance);
    const PointTree tree(mesh.positions, vertices);
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> first(mesh.positions.size(), none), near;
    for (const std::uint32_t vertex : vertices) {
        if (first[vertex] != none) continue;
        first[vertex] = vertex;
        const Vector3 point = toVector(mesh.positions[vertex]);
        near.clear();
        tree.findNear(point, point, double{reaches[vertex]}, near);
        for (const std::uint32_t other : near) {
            if (first[other] != none) continue;
            if (lengthOf(mesh, vertex, other) > double{reaches[other]}) continue;
            first[other] = vertex;
            places.push_back(mesh.positions[vertex]);
            if (pairs) pairs->push_back({mesh.positions[vertex], mesh.positions[other]});
        }
    }
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& vertex : triangle)
            if (first[vertex] != none) vertex = first[vertex];
}

void splitJunctions(TriangleMesh& mesh, double tolerance, Places& places) {
    constexpr int mostPasses = 16; // a pass splits one edge per triangle
    for (int pass = 0; pass < mostPasses; ++pass)
        if (!splitOnce(mesh, tolerance, places)) break;
}

} // namespace sinew::mesh
