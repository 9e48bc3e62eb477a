// Removal of leftovers: triangles that stick out of a surface, and walls within a volume that no side of it
// needs.
#include "mesh/repair_steps.hpp"
#include "mesh/vector3.hpp"

#include <numeric>

namespace sinew::mesh {
namespace {

/// Number of open edges of each triangle, and of crowded ones (with three triangles and more).
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

void removeSingles(TriangleMesh& mesh, Places& places) {
    const EdgeCounts counts = countEdgesOf(mesh);
    const auto sticksOut = [&](std::uint32_t triangle) {
        return counts.open[triangle] == 2 && counts.crowded[triangle] == 1;
    };
    std::vector<bool> isKept(mesh.triangles.size(), true);
    const std::size_t before = places.size();
    forEachEdge(mesh.triangles, [&](std::span<const HalfEdge> sides) {
        const auto loose =
            static_cast<std::size_t>(std::ranges::count_if(sides, sticksOut, &HalfEdge::triangle));
        if (sides.size() < 3 || sides.size() - loose != 2) return;
        for (const HalfEdge& side : sides)
            if (sticksOut(side.triangle)) {
                isKept[side.triangle] = false;
                places.push_back(mesh.positions[side.low]);
            }
    });
    if (places.size() > before) mesh = keep(mesh, isKept);
}

/// Triangles connected across edges of two triangles, and the crowded edges around them.
struct Sheet {
    std::size_t firstEdge = 0, edgeCount = 0; ///< in Walls::edgesOf_
    double area = 0;
    bool isWall = true; ///< every edge of its rim has three triangles, one of them of this sheet
};

/// An edge of three triangles.
struct CrowdedEdge {
    std::array<HalfEdge, 3> sides;
    bool isFree = true; ///< has not lost a triangle
};

class Walls {
public:
    explicit Walls(const TriangleMesh& mesh) : mesh_(mesh) {
        std::size_t count = 0;
        numbers_ = numberParts(mesh_, count);
        sheets_.resize(count);
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            const auto [a, b, c] = mesh_.triangles[i];
            const Vector3 origin = toVector(mesh_.positions[a]);
            sheets_[numbers_[i]].area +=
                (toVector(mesh_.positions[b]) - origin).cross(toVector(mesh_.positions[c]) - origin).norm();
        }
        findEdges();
    }

    /// Marks the triangles of walls, the smallest wall first: without them each edge around them has two
    /// triangles with consistent orientation.
    void mark(std::vector<bool>& isKept, Places& places) {
        std::vector<std::size_t> order(sheets_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sheets_[i].area; });
        std::vector<bool> isRemoved(sheets_.size());
        for (const std::size_t i : order) {
            if (!sheets_[i].isWall || sheets_[i].edgeCount == 0 || !areFree(i)) continue;
            for (const std::uint32_t edge : edgesOf(i)) crowded_[edge].isFree = false;
            isRemoved[i] = true;
        }
        for (std::size_t i = 0; i < isKept.size(); ++i) {
            const std::size_t sheet = numbers_[i];
            if (!isRemoved[sheet]) continue;
            isKept[i] = false;
            places.push_back(mesh_.positions[crowded_[edgesOf(sheet).front()].sides[0].low]);
        }
    }

private:
    void findEdges() {
        std::vector<std::array<std::uint32_t, 2>> pairs; // sheet, edge
        forEachEdge(mesh_.triangles, [&](std::span<const HalfEdge> sides) {
            if (sides.size() == 2) return;
            for (const HalfEdge& side : sides) {
                Sheet& sheet = sheets_[numbers_[side.triangle]];
                sheet.isWall = sheet.isWall && sides.size() == 3;
                if (sides.size() != 3) continue;
                pairs.push_back({numbers_[side.triangle], static_cast<std::uint32_t>(crowded_.size())});
            }
            if (sides.size() == 3) crowded_.push_back({{sides[0], sides[1], sides[2]}});
        });
        std::ranges::sort(pairs);
        for (const auto& [sheet, edge] : pairs) {
            if (sheets_[sheet].edgeCount++ == 0) sheets_[sheet].firstEdge = edgesOf_.size();
            edgesOf_.push_back(edge);
        }
    }

    std::span<const std::uint32_t> edgesOf(std::size_t sheet) const {
        return std::span(edgesOf_).subspan(sheets_[sheet].firstEdge, sheets_[sheet].edgeCount);
    }

    bool areFree(std::size_t sheet) const {
        return std::ranges::all_of(edgesOf(sheet), [&](std::uint32_t index) {
            const CrowdedEdge& edge = crowded_[index];
            int others = 0, balance = 0;
            for (const HalfEdge& side : edge.sides)
                if (numbers_[side.triangle] != sheet) {
                    ++others;
                    balance += side.isForward ? 1 : -1;
                }
            return edge.isFree && others == 2 && balance == 0;
        });
    }

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> numbers_;
    std::vector<Sheet> sheets_;
    std::vector<CrowdedEdge> crowded_;
    std::vector<std::uint32_t> edgesOf_; ///< sheet by sheet
};

} // namespace

void removeLeftovers(TriangleMesh& mesh, Places& places) {
    removeSingles(mesh, places);
    std::vector<bool> isKept(mesh.triangles.size(), true);
    const std::size_t before = places.size();
    Walls(mesh).mark(isKept, places);
    if (places.size() > before) mesh = keep(mesh, isKept);
}

} // namespace sinew::mesh
