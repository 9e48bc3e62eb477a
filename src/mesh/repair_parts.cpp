// Reversal of parts that are inside out. A part is a set of triangles connected across edges of two
// triangles.
#include "mesh/disjoint_sets.hpp"
#include "mesh/point_tree.hpp"
#include "mesh/repair_steps.hpp"
#include "mesh/triangle_tree.hpp"

#include <map>
#include <numeric>

namespace sinew::mesh {
namespace {

constexpr std::size_t mostContainers = 64; ///< the largest parts are tested as containers
constexpr std::size_t samplesOfPart = 8;

struct Part {
    std::vector<std::uint32_t> triangles;
    bool isClosed = true;
    double volume = 0; ///< signed
    Eigen::AlignedBox3d box;
};

/// Finds open parts. A part is closed if along each edge equally many of its triangles run in both
/// directions.
void findOpenParts(const std::vector<HalfEdge>& all, const std::vector<std::uint32_t>& numbers,
                   std::vector<Part>& parts) {
    std::map<std::uint32_t, int> balance;
    forEachEdge(all, [&](std::span<const HalfEdge> sides) {
        if (sides.size() == 2) {
            if (sides[0].isForward == sides[1].isForward) parts[numbers[sides[0].triangle]].isClosed = false;
            return;
        }
        balance.clear();
        for (const HalfEdge& side : sides) balance[numbers[side.triangle]] += side.isForward ? 1 : -1;
        for (const auto& [part, sum] : balance)
            if (sum != 0) parts[part].isClosed = false;
    });
}

/// Signed volume, relative to the centre of the part: far from it a small volume is lost in rounding.
double volumeOf(const TriangleMesh& mesh, const Part& part) {
    const Vector3 middle = part.box.center();
    double volume = 0;
    for (const std::uint32_t triangle : part.triangles) {
        const auto [a, b, c] = mesh.triangles[triangle];
        volume +=
            (toVector(mesh.positions[a]) - middle)
                .dot((toVector(mesh.positions[b]) - middle).cross(toVector(mesh.positions[c]) - middle)) /
            6;
    }
    return volume;
}

/// Index of the part of each triangle.
std::vector<std::uint32_t> numberParts(std::size_t triangles, const std::vector<HalfEdge>& all,
                                       std::size_t& count, Across across) {
    DisjointSets sets(triangles);
    forEachEdge(all, [&](std::span<const HalfEdge> sides) {
        if (sides.size() > 2 && across == Across::pairs) return;
        for (const HalfEdge& side : sides) sets.join(sides.front().triangle, side.triangle);
    });
    std::vector<std::uint32_t> numbers(triangles);
    count = 0;
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
        numbers[i] = sets.root(i) == i ? static_cast<std::uint32_t>(count++) : numbers[sets.root(i)];
    return numbers;
}

std::vector<Part> findParts(const TriangleMesh& mesh) {
    std::size_t count = 0;
    const std::vector<HalfEdge> sides = sortedSides(mesh.triangles);
    const std::vector<std::uint32_t> numbers =
        numberParts(mesh.triangles.size(), sides, count, Across::pairs);
    std::vector<Part> parts(count);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) {
        Part& part = parts[numbers[i]];
        part.triangles.push_back(i);
        for (const std::uint32_t vertex : mesh.triangles[i])
            part.box.extend(toVector(mesh.positions[vertex]));
    }
    for (Part& part : parts) part.volume = volumeOf(mesh, part);
    findOpenParts(sides, numbers, parts);
    return parts;
}

/// Tests whether parts lie within other parts, which may be open: the winding number there exceeds a half.
class Nesting {
public:
    Nesting(const TriangleMesh& mesh, const std::vector<Part>& parts) : mesh_(mesh), parts_(parts) {
        containers_.resize(parts.size());
        std::iota(containers_.begin(), containers_.end(), 0u);
        std::ranges::stable_sort(containers_, std::greater(),
                                 [&](std::uint32_t i) { return parts[i].box.volume(); });
        containers_.resize(std::min(containers_.size(), mostContainers));
        for (const Vec3& position : mesh.positions) positions_.push_back(toVector(position));
        std::vector<Vec3> corners;
        for (const Part& part : parts) corners.push_back(toVec3(part.box.min()));
        std::vector<std::uint32_t> all(parts.size());
        std::iota(all.begin(), all.end(), 0u);
        lowCorners_.emplace(corners, all);
    }

    /// Parts whose boxes may lie within the box of `container`, including itself, ascending.
    std::vector<std::uint32_t> candidatesWithin(std::uint32_t container) const {
        const Eigen::AlignedBox3d& box = parts_[container].box;
        Vector3 half = box.sizes() / 2, along = Vector3::Zero();
        Eigen::Index longest = 0;
        half.maxCoeff(&longest);
        along[longest] = half[longest];
        half[longest] = 0;
        std::vector<std::uint32_t> found;
        lowCorners_->findNear(box.center() - along, box.center() + along, half.norm() * 1.00001, found);
        std::ranges::sort(found);
        return found;
    }

    bool isWithinAny(std::uint32_t part) {
        return std::ranges::any_of(containers_,
                                   [&](std::uint32_t container) { return isWithin(part, container); });
    }

    bool isWithin(std::uint32_t part, std::uint32_t container) {
        const std::vector<std::uint32_t>& triangles = parts_[part].triangles;
        if (part == container || !parts_[container].box.contains(parts_[part].box)) return false;
        const TriangleTree& tree = treeOf(container);
        const std::size_t samples = std::min(samplesOfPart, triangles.size());
        for (std::size_t i = 0; i < samples; ++i) {
            const std::uint32_t triangle = triangles[i * triangles.size() / samples];
            if (std::abs(tree.windingNumber(positions_[mesh_.triangles[triangle][0]])) < 0.5) return false;
        }
        return true;
    }

private:
    const TriangleTree& treeOf(std::uint32_t container) {
        const auto found = trees_.find(container);
        if (found != trees_.end()) return found->second;
        TriangleTree::Triangles triangles;
        for (const std::uint32_t triangle : parts_[container].triangles)
            triangles.push_back(mesh_.triangles[triangle]);
        return trees_.emplace(container, TriangleTree(positions_, triangles)).first->second;
    }

    const TriangleMesh& mesh_;
    const std::vector<Part>& parts_;
    std::vector<std::uint32_t> containers_;
    std::vector<Vector3> positions_;
    std::optional<PointTree> lowCorners_; ///< low corners of the boxes of all parts
    std::map<std::uint32_t, TriangleTree> trees_;
};

} // namespace

std::vector<std::uint32_t> numberParts(const TriangleMesh& mesh, std::size_t& count, Across across) {
    return numberParts(mesh.triangles.size(), sortedSides(mesh.triangles), count, across);
}

void turnParts(TriangleMesh& mesh, Places& places) {
    const std::vector<Part> parts = findParts(mesh);
    const auto isInsideOut = [](const Part& part) { return part.isClosed && part.volume < 0; };
    if (std::ranges::none_of(parts, isInsideOut)) return;
    Nesting nesting(mesh, parts);
    std::vector<bool> isTurned(parts.size());
    for (std::uint32_t part = 0; part < parts.size(); ++part) {
        if (!isInsideOut(parts[part]) || nesting.isWithinAny(part)) continue;
        places.push_back(mesh.positions[mesh.triangles[parts[part].triangles.front()][0]]);
        isTurned[part] = true;
        for (const std::uint32_t inner : nesting.candidatesWithin(part))
            if (parts[inner].isClosed && nesting.isWithin(inner, part)) isTurned[inner] = true;
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (isTurned[i])
            for (const std::uint32_t triangle : parts[i].triangles) flip(mesh, triangle);
}

} // namespace sinew::mesh
