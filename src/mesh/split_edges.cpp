// Triangles around an edge, in the order of their angle about it: one that runs along the edge has its
// material before it, one that runs against the edge has it behind, so they pair like brackets.
#include "mesh/split_edges.hpp"

#include "mesh/vector3.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sinew::mesh {
namespace {

using Edge = std::array<std::uint32_t, 2>; // the lower vertex first

Edge edgeOf(const std::array<std::uint32_t, 3>& triangle, std::size_t n) {
    const std::uint32_t a = triangle[n], b = triangle[(n + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
}

/// A triangle at an edge.
struct Side {
    std::uint32_t triangle = 0;
    bool runsAlong = false; // in the direction from the lower vertex to the higher
    long angle = 0;         // in 1e-4 rad: the two sides of a cut coincide until they move apart
};

class Splitter {
public:
    explicit Splitter(TriangleMesh& mesh) : mesh_(mesh) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            if (a == b || b == c || c == a) continue; // degenerate: has no proper edges
            for (std::size_t n = 0; n < 3; ++n) around_[edgeOf(mesh.triangles[t], n)].push_back(t);
        }
    }

    std::size_t run() {
        std::vector<Edge> crowded;
        for (const auto& [edge, triangles] : around_)
            if (triangles.size() > 2) crowded.push_back(edge);
        std::size_t count = 0;
        for (const Edge& edge : crowded) count += split(edge) ? 1 : 0;
        return count;
    }

private:
    bool split(const Edge& edge) {
        std::vector<Side> sides = sidesOf(edge);
        const auto along = std::ranges::count_if(sides, &Side::runsAlong);
        if (2 * along != std::ssize(sides)) return false; // open surface
        std::ranges::stable_sort(sides, [](const Side& a, const Side& b) {
            return a.angle != b.angle ? a.angle < b.angle : a.runsAlong && !b.runsAlong;
        });
        std::rotate(sides.begin(), firstOf(sides), sides.end());
        std::vector<std::uint32_t> open; // triangles whose material has no second side yet
        for (const Side& side : sides) {
            if (!side.runsAlong) {
                open.push_back(side.triangle);
                continue;
            }
            const std::uint32_t middle = addMiddle(edge);
            divide(side.triangle, edge, middle);
            divide(open.back(), edge, middle);
            open.pop_back();
        }
        around_.erase(edge);
        return true;
    }

    /// The triangles at an edge, with angles about it relative to the first triangle.
    std::vector<Side> sidesOf(const Edge& edge) const {
        const Vector3 start = toVector(mesh_.positions[edge[0]]),
                      axis = (toVector(mesh_.positions[edge[1]]) - start).normalized();
        Vector3 zero = Vector3::Zero();
        std::vector<Side> sides;
        for (const std::uint32_t t : around_.at(edge)) {
            const auto& triangle = mesh_.triangles[t];
            std::size_t n = 0;
            while (edgeOf(triangle, n) != edge) ++n;
            Vector3 away = toVector(mesh_.positions[triangle[(n + 2) % 3]]) - start;
            away -= away.dot(axis) * axis;
            if (sides.empty()) zero = away;
            const double turn = 1e4 * std::atan2(axis.dot(zero.cross(away)), zero.dot(away));
            const long angle = std::isfinite(turn) ? std::lround(turn) : 0, half = 31416;
            sides.push_back({t, triangle[n] == edge[0], angle == -half ? half : angle});
        }
        return sides;
    }

    /// The side from which on the brackets match.
    static std::vector<Side>::iterator firstOf(std::vector<Side>& sides) {
        std::ptrdiff_t open = 0, fewest = 0, first = 0;
        for (std::ptrdiff_t s = 0; s < std::ssize(sides); ++s) {
            open += sides[static_cast<std::size_t>(s)].runsAlong ? -1 : 1;
            if (open < fewest) {
                fewest = open;
                first = s + 1;
            }
        }
        return sides.begin() + first;
    }

    std::uint32_t addMiddle(const Edge& edge) {
        const Vector3 middle = (toVector(mesh_.positions[edge[0]]) + toVector(mesh_.positions[edge[1]])) / 2;
        mesh_.positions.push_back(toVec3(middle));
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    /// Splits a triangle; the second half is a new triangle. Its parts of an edge that was split before are
    /// not listed: two triangles share each.
    void divide(std::uint32_t t, const Edge& edge, std::uint32_t middle) {
        std::size_t n = 0;
        while (edgeOf(mesh_.triangles[t], n) != edge) ++n;
        const auto [a, b, c] = std::array{mesh_.triangles[t][n], mesh_.triangles[t][(n + 1) % 3],
                                          mesh_.triangles[t][(n + 2) % 3]};
        const auto added = static_cast<std::uint32_t>(mesh_.triangles.size());
        mesh_.triangles[t] = {a, middle, c};
        mesh_.triangles.push_back({middle, b, c});
        const auto opposite = around_.find({std::min(b, c), std::max(b, c)});
        if (opposite != around_.end()) std::ranges::replace(opposite->second, t, added);
    }

    TriangleMesh& mesh_;
    std::map<Edge, std::vector<std::uint32_t>> around_; // triangles
};

} // namespace

std::size_t splitCrowdedEdges(TriangleMesh& mesh) {
    return Splitter(mesh).run();
}

} // namespace sinew::mesh
