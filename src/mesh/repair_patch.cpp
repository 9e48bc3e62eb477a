// Triangulation of a hole. All triangulations of a loop are compared by dynamic programming, first by the
// largest angle between neighbours, including those on the rim, in steps of five degrees, then by their area
// [Liepa 2003].
#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace sinew::mesh {
namespace {

constexpr std::size_t mostPlanned = 128; ///< edges; planning takes n^3 steps
constexpr double bendStep = 5;           ///< [degrees]
constexpr double folded = 170;           ///< [degrees] angle of neighbours that lie on each other

double degreesBetween(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * (180 / std::numbers::pi);
}

Vector3 areaVector(const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b - a).cross(c - a) / 2;
}

std::vector<Vector3> pointsOf(const TriangleMesh& mesh, const Loop& loop) {
    std::vector<Vector3> points;
    for (const std::uint32_t vertex : loop.vertices) points.push_back(toVector(mesh.positions[vertex]));
    return points;
}

std::vector<Vector3> rimNormals(const TriangleMesh& mesh, const Loop& loop) {
    std::vector<Vector3> normals;
    for (const std::uint32_t triangle : loop.rim) {
        const auto [a, b, c] = mesh.triangles[triangle];
        normals.push_back(areaVector(toVector(mesh.positions[a]), toVector(mesh.positions[b]),
                                     toVector(mesh.positions[c])));
    }
    return normals;
}

/// Plans the triangles between the vertices i < k of a loop and the chord from i to k, for all i and k.
class Plan {
public:
    Plan(const TriangleMesh& mesh, const Loop& loop, const TakenEdges& taken)
        : loop_(loop), taken_(taken), count_(loop.vertices.size()), points_(pointsOf(mesh, loop)),
          rim_(rimNormals(mesh, loop)), best_(count_ * count_) {
        for (std::size_t span = 2; span < count_; ++span)
            for (std::size_t i = 0; i + span < count_; ++i) choose(i, i + span);
    }

    Patch patch() const {
        if (!at(0, count_ - 1).isPossible) return {};
        Patch result;
        std::vector<Vector3> inside(count_); // normals of the patch along the rim
        inside[count_ - 1] = at(0, count_ - 1).normal;
        std::vector<std::array<std::size_t, 2>> chords{{0, count_ - 1}};
        while (!chords.empty()) {
            const auto [first, last] = chords.back();
            chords.pop_back();
            const Choice& choice = at(first, last);
            result.triangles.push_back(
                {loop_.vertices[first], loop_.vertices[choice.middle], loop_.vertices[last]});
            for (const auto& side : {std::array{first, choice.middle}, std::array{choice.middle, last}}) {
                if (side[1] == side[0] + 1) {
                    inside[side[0]] = choice.normal;
                    continue;
                }
                if (degreesBetween(choice.normal, at(side[0], side[1]).normal) > folded) return {};
                chords.push_back(side);
            }
        }
        result.bend = meanBend(inside);
        return result;
    }

private:
    struct Choice {
        bool isPossible = false;
        std::size_t middle = 0;
        int bend = 0; ///< in steps
        double area = 0;
        Vector3 normal = Vector3::Zero();
    };

    Choice& at(std::size_t i, std::size_t k) { return best_[i * count_ + k]; }
    const Choice& at(std::size_t i, std::size_t k) const { return best_[i * count_ + k]; }
    bool isRim(std::size_t i, std::size_t k) const { return k == i + 1 || (i == 0 && k + 1 == count_); }

    /// Steps of bend across the chord from i to k, for a triangle with this normal at the chord.
    int bendAcross(std::size_t i, std::size_t k, const Vector3& normal) const {
        const Vector3& other = k == i + 1 ? rim_[i] : at(i, k).normal;
        return static_cast<int>(degreesBetween(normal, other) / bendStep);
    }

    void choose(std::size_t i, std::size_t k) {
        if (!isRim(i, k) && taken_.has(loop_.vertices[i], loop_.vertices[k])) return;
        Choice best;
        for (std::size_t m = i + 1; m < k; ++m) {
            const Choice &left = at(i, m), &right = at(m, k);
            if ((m > i + 1 && !left.isPossible) || (k > m + 1 && !right.isPossible)) continue;
            Choice choice{
                .isPossible = true, .middle = m, .normal = areaVector(points_[i], points_[m], points_[k])};
            if (choice.normal.isZero(0)) continue;
            choice.bend = std::max(
                {left.bend, right.bend, bendAcross(i, m, choice.normal), bendAcross(m, k, choice.normal)});
            if (i == 0 && k + 1 == count_)
                choice.bend = std::max(choice.bend,
                                       static_cast<int>(degreesBetween(choice.normal, rim_[k]) / bendStep));
            choice.area = left.area + right.area + choice.normal.norm();
            if (!best.isPossible || std::tie(choice.bend, choice.area) < std::tie(best.bend, best.area))
                best = choice;
        }
        at(i, k) = best;
    }

    double meanBend(const std::vector<Vector3>& inside) const {
        double sum = 0, length = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double edge = (points_[(i + 1) % count_] - points_[i]).norm();
            sum += edge * degreesBetween(rim_[i], inside[i]);
            length += edge;
        }
        return sum / length;
    }

    const Loop& loop_;
    const TakenEdges& taken_;
    std::size_t count_;
    std::vector<Vector3> points_, rim_;
    std::vector<Choice> best_;
};

/// A fan of triangles around the centre; possible only if none of them faces away from their mean normal.
Patch fan(const TriangleMesh& mesh, const Loop& loop) {
    const std::vector<Vector3> points = pointsOf(mesh, loop), rim = rimNormals(mesh, loop);
    Vector3 middle = Vector3::Zero(), mean = Vector3::Zero();
    for (const Vector3& point : points) middle += point / static_cast<double>(points.size());
    middle = toVector(toVec3(middle));
    const auto center = static_cast<std::uint32_t>(mesh.positions.size());
    Patch patch{.triangles = {}, .bend = 0, .center = toVec3(middle)};
    double length = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t next = (i + 1) % points.size();
        const Vector3 normal = areaVector(points[i], points[next], middle);
        mean += normal;
        const double edge = (points[next] - points[i]).norm();
        patch.bend += edge * degreesBetween(rim[i], normal);
        length += edge;
        patch.triangles.push_back({loop.vertices[i], loop.vertices[next], center});
    }
    patch.bend /= length;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!(areaVector(points[i], points[(i + 1) % points.size()], middle).dot(mean) > 0)) return {};
    return patch;
}

} // namespace

TakenEdges::TakenEdges(std::vector<VertexPair> edges) : edges_(std::move(edges)) {
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

bool TakenEdges::has(std::uint32_t a, std::uint32_t b) const {
    const VertexPair pair{std::min(a, b), std::max(a, b)};
    return std::ranges::binary_search(edges_, pair) || added_.contains(pair);
}

Patch makePatch(const TriangleMesh& mesh, const Loop& loop, const TakenEdges& taken) {
    return loop.vertices.size() > mostPlanned ? fan(mesh, loop) : Plan(mesh, loop, taken).patch();
}

} // namespace sinew::mesh
