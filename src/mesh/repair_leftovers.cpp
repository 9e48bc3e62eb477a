// Triangles that stick out of a surface, and walls within a volume, which no side of it needs.
#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <numeric>

namespace sinew::mesh {
namespace {

/// How many edges of each triangle are open, and how many are crowded (three triangles and more).
struct EdgeCounts {
    std::vector<std::uint8_t> open, crowded;
};

EdgeCounts countEdgesOf(const TriangleMesh& mesh) {
    EdgeCounts counts{std::vector<std::uint8_t>(mesh.triangles.size()),
                      std::vector<std::uint8_t>(mesh.triangles.size())};
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        if (sides.size() == 1) ++counts.open[sides.front().triangle];
        if (sides.size() > 2)
            for (const HalfEdge& side : sides) ++counts.crowded[side.triangle];
    });
    return counts;
}

std::size_t removeSingles(TriangleMesh& mesh) {
    const EdgeCounts counts = countEdgesOf(mesh);
    const auto sticksOut = [&](std::uint32_t triangle) {
        return counts.open[triangle] == 2 && counts.crowded[triangle] == 1;
    };
    std::vector<bool> isKept(mesh.triangles.size(), true);
    std::size_t count = 0;
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        const auto loose =
            static_cast<std::size_t>(std::ranges::count_if(sides, sticksOut, &HalfEdge::triangle));
        if (sides.size() < 3 || sides.size() - loose != 2) return;
        for (const HalfEdge& side : sides)
            if (sticksOut(side.triangle)) {
                isKept[side.triangle] = false;
                ++count;
            }
    });
    if (count > 0) mesh = keep(mesh, isKept);
    return count;
}

/// Triangles connected across edges of two triangles, and the crowded edges around them.
struct Sheet {
    std::vector<std::uint32_t> triangles;
    std::vector<std::size_t> edges;
    double area = 0;
    bool isWall = true; ///< bounded by edges of three triangles alone, of which it has one each
};

struct CrowdedEdge {
    std::vector<HalfEdge> sides;
    bool isFree = true; ///< still of three triangles
};

class Walls {
public:
    explicit Walls(const TriangleMesh& mesh) : mesh_(mesh), sheets_(findSheets()) {}

    /// Marks the triangles of walls, the smallest first: without them each edge around them has two sides
    /// that run opposite ways.
    std::size_t mark(std::vector<bool>& isKept) {
        std::vector<std::size_t> order(sheets_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sheets_[i].area; });
        std::size_t count = 0;
        for (const std::size_t i : order) {
            const Sheet& sheet = sheets_[i];
            if (!sheet.isWall || sheet.edges.empty() || !areFree(sheet, i)) continue;
            for (const std::size_t edge : sheet.edges) crowded_[edge].isFree = false;
            for (const std::uint32_t triangle : sheet.triangles) isKept[triangle] = false;
            count += sheet.triangles.size();
        }
        return count;
    }

private:
    std::vector<Sheet> findSheets() {
        std::size_t count = 0;
        numbers_ = numberParts(mesh_, count);
        std::vector<Sheet> sheets(count);
        for (std::uint32_t i = 0; i < numbers_.size(); ++i) {
            const auto [a, b, c] = mesh_.triangles[i];
            const Vector3 origin = toVector(mesh_.positions[a]);
            sheets[numbers_[i]].triangles.push_back(i);
            sheets[numbers_[i]].area +=
                (toVector(mesh_.positions[b]) - origin).cross(toVector(mesh_.positions[c]) - origin).norm();
        }
        forEachEdge(mesh_.triangles, [&](std::span<const HalfEdge> sides) {
            if (sides.size() == 2) return;
            for (const HalfEdge& side : sides) {
                Sheet& sheet = sheets[numbers_[side.triangle]];
                sheet.isWall = sheet.isWall && sides.size() == 3;
                sheet.edges.push_back(crowded_.size());
            }
            crowded_.push_back({{sides.begin(), sides.end()}});
        });
        return sheets;
    }

    bool areFree(const Sheet& sheet, std::size_t number) const {
        return std::ranges::all_of(sheet.edges, [&](std::size_t index) {
            const CrowdedEdge& edge = crowded_[index];
            int others = 0, balance = 0;
            for (const HalfEdge& side : edge.sides)
                if (numbers_[side.triangle] != number) {
                    ++others;
                    balance += side.isForward ? 1 : -1;
                }
            return edge.isFree && others == 2 && balance == 0;
        });
    }

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> numbers_;
    std::vector<CrowdedEdge> crowded_;
    std::vector<Sheet> sheets_;
};

} // namespace

std::size_t removeLeftovers(TriangleMesh& mesh) {
    std::size_t count = removeSingles(mesh);
    std::vector<bool> isKept(mesh.triangles.size(), true);
    const std::size_t walls = Walls(mesh).mark(isKept);
    if (walls > 0) mesh = keep(mesh, isKept);
    return count + walls;
}

} // namespace sinew::mesh
