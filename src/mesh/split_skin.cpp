// First the skin is split along the planes between cells. The anchor of a vertex then is the nearest node,
// which is a corner of all cells that contain the vertex. Nodes a and b of one cell are ends of an edge of
// its tetrahedra if a <= b or b <= a along all axes; an edge of the skin whose ends are not comparable in
// this way gets a vertex in between with the minimum or maximum of a and b as its anchor, whichever is
// nearer. Both are comparable with every node comparable with a and b, so three comparable nodes always
// result, without further use of geometry: nothing depends on rounding.
#include "mesh/split_skin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

namespace sinew::mesh {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Node = std::array<std::int64_t, 3>;

// Vertices nearer than this to a plane between cells [cells] count as on it, without being moved: thinner
// parts give no usable normal once the skin is strained, while vertices on both sides of them would have only
// half of the skin around each. It also makes fewer parts.
constexpr double onPlane = 1e-2;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

bool isBelow(const Node& a, const Node& b) {
    return a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2];
}

bool areComparable(const Node& a, const Node& b) {
    return isBelow(a, b) || isBelow(b, a);
}

Node minimum(const Node& a, const Node& b) {
    return {std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2])};
}

Node maximum(const Node& a, const Node& b) {
    return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
}

Vector3 placeOf(const Node& node) {
    return {static_cast<double>(node[0]), static_cast<double>(node[1]), static_cast<double>(node[2])};
}

class Splitter {
public:
    Splitter(std::vector<Vector3> positions, std::vector<Triangle> triangles)
        : skin_{std::move(positions), std::move(triangles), {}, {}} {
        skin_.wholeOf.resize(skin_.triangles.size());
        std::iota(skin_.wholeOf.begin(), skin_.wholeOf.end(), 0u);
    }

    SplitSkin run() {
        for (Eigen::Index axis = 0; axis < 3; ++axis) splitBetweenCells(axis);
        for (const Vector3& x : skin_.positions)
            skin_.anchors.push_back({std::llround(std::floor(x.x() + 0.5)),
                                     std::llround(std::floor(x.y() + 0.5)),
                                     std::llround(std::floor(x.z() + 0.5))});
        points_.clear();
        const std::vector<Triangle> whole = std::exchange(skin_.triangles, {});
        const std::vector<std::uint32_t> wholeOf = std::exchange(skin_.wholeOf, {});
        for (std::size_t t = 0; t < whole.size(); ++t) {
            splitBetweenNodes(whole[t]);
            skin_.wholeOf.resize(skin_.triangles.size(), wholeOf[t]);
        }
        return std::move(skin_);
    }

private:
    static std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }

    // The point at which an edge meets a plane: within the box of its ends, whatever the rounding.
    std::uint32_t pointOn(std::uint32_t a, std::uint32_t b, Eigen::Index axis, double plane) {
        const auto [entry, isNew] =
            points_.try_emplace(keyOf(a, b), static_cast<std::uint32_t>(skin_.positions.size()));
        if (!isNew) return entry->second;
        const Vector3 low = skin_.positions[std::min(a, b)], high = skin_.positions[std::max(a, b)];
        const double t = (plane - low[axis]) / (high[axis] - low[axis]);
        Vector3 point = (low + t * (high - low)).cwiseMax(low.cwiseMin(high)).cwiseMin(low.cwiseMax(high));
        point[axis] = plane;
        skin_.positions.push_back(point);
        return entry->second;
    }

    // Adds a part of a triangle with three or four corners; the shorter diagonal splits four.
    void addPart(const std::vector<std::uint32_t>& part, std::vector<Triangle>& to) const {
        if (part.size() == 3) {
            to.push_back({part[0], part[1], part[2]});
            return;
        }
        const auto& x = skin_.positions;
        const std::size_t turn =
            (x[part[0]] - x[part[2]]).squaredNorm() <= (x[part[1]] - x[part[3]]).squaredNorm() ? 0 : 1;
        const auto at = [&](std::size_t n) { return part[(n + turn) % 4]; };
        to.push_back({at(0), at(1), at(2)});
        to.push_back({at(0), at(2), at(3)});
    }

    // Coordinate of a vertex along an axis, rounded to a plane between cells if near one.
    double heightOf(std::uint32_t vertex, Eigen::Index axis) const {
        const double height = skin_.positions[vertex][axis], plane = std::round(height);
        return std::abs(height - plane) < onPlane ? plane : height;
    }

    // Splits at the lowest plane first, so that both triangles of an edge split alike.
    void splitBetweenCells(Eigen::Index axis) {
        std::vector<Triangle> done, open;
        std::vector<std::uint32_t> wholeOf;
        for (std::size_t t = 0; t < skin_.triangles.size(); ++t) {
            open.push_back(skin_.triangles[t]);
            while (!open.empty()) {
                const Triangle next = open.back();
                open.pop_back();
                splitAtLowest(next, axis, open, done);
            }
            wholeOf.resize(done.size(), skin_.wholeOf[t]);
        }
        skin_.triangles = std::move(done);
        skin_.wholeOf = std::move(wholeOf);
    }

    void splitAtLowest(const Triangle& triangle, Eigen::Index axis, std::vector<Triangle>& open,
                       std::vector<Triangle>& done) {
        std::array<double, 3> heights{};
        for (std::size_t n = 0; n < 3; ++n) heights[n] = heightOf(triangle[n], axis);
        const double plane = std::floor(std::ranges::min(heights)) + 1;
        if (!(plane < std::ranges::max(heights))) {
            done.push_back(triangle);
            return;
        }
        std::vector<std::uint32_t> below, above;
        for (std::size_t n = 0; n < 3; ++n) {
            const double height = heights[n], next = heights[(n + 1) % 3];
            if (height <= plane) below.push_back(triangle[n]);
            if (height >= plane) above.push_back(triangle[n]);
            if ((height < plane && next > plane) || (height > plane && next < plane)) {
                const std::uint32_t point = pointOn(triangle[n], triangle[(n + 1) % 3], axis, plane);
                below.push_back(point);
                above.push_back(point);
            }
        }
        addPart(below, done);
        addPart(above, open);
    }

    // The vertex between two with incomparable anchors; none if they are comparable.
    std::uint32_t between(std::uint32_t first, std::uint32_t second) {
        const std::uint32_t a = std::min(first, second), b = std::max(first, second);
        const Node from = skin_.anchors[a], to = skin_.anchors[b];
        if (areComparable(from, to)) return none;
        const auto [entry, isNew] =
            points_.try_emplace(keyOf(a, b), static_cast<std::uint32_t>(skin_.positions.size()));
        if (!isNew) return entry->second;
        const Vector3 x = skin_.positions[a], way = skin_.positions[b] - x;
        double early = 1, late = 0; // parameters at which the nearest node changes
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (from[axis] == to[axis]) continue;
            const auto n = static_cast<Eigen::Index>(axis);
            const double half = static_cast<double>(std::min(from[axis], to[axis])) + 0.5;
            early = std::min(early, (half - x[n]) / way[n]);
            late = std::max(late, (half - x[n]) / way[n]);
        }
        addVertex(x + std::clamp((early + late) / 2, 0.05, 0.95) * way, minimum(from, to), maximum(from, to));
        return entry->second;
    }

    void addVertex(const Vector3& x, const Node& low, const Node& high) {
        const bool isLow = (x - placeOf(low)).squaredNorm() <= (x - placeOf(high)).squaredNorm();
        skin_.positions.push_back(x);
        skin_.anchors.push_back(isLow ? low : high);
    }

    bool areTogether(std::uint32_t a, std::uint32_t b) const {
        return areComparable(skin_.anchors[a], skin_.anchors[b]);
    }

    // Adds the triangles from one corner of a polygon to all others; false if some anchors are incomparable.
    bool addFan(std::span<const std::uint32_t> polygon, std::size_t from) {
        const std::size_t count = polygon.size();
        const auto at = [&](std::size_t n) { return polygon[(from + n) % count]; };
        for (std::size_t n = 2; n + 1 < count; ++n)
            if (!areTogether(at(0), at(n))) return false;
        for (std::size_t n = 1; n + 1 < count; ++n) skin_.triangles.push_back({at(0), at(n), at(n + 1)});
        return true;
    }

    // Adds a fan from a vertex between two corners, so that no triangle has three vertices in a row; else one
    // from the centre.
    void splitBetweenNodes(const Triangle& triangle) {
        std::vector<std::uint32_t> polygon;
        std::vector<std::size_t> added;
        for (std::size_t n = 0; n < 3; ++n) {
            polygon.push_back(triangle[n]);
            const std::uint32_t point = between(triangle[n], triangle[(n + 1) % 3]);
            if (point == none) continue;
            added.push_back(polygon.size());
            polygon.push_back(point);
        }
        if (added.empty()) {
            skin_.triangles.push_back(triangle);
            return;
        }
        for (const std::size_t from : added)
            if (addFan(polygon, from)) return;
        Vector3 middle = Vector3::Zero();
        Node lowest = skin_.anchors[triangle[0]];
        for (const std::uint32_t corner : triangle) {
            middle += skin_.positions[corner] / 3;
            lowest = minimum(lowest, skin_.anchors[corner]);
        }
        const auto center = static_cast<std::uint32_t>(skin_.positions.size());
        addVertex(middle, lowest, lowest);
        for (std::size_t n = 0; n < polygon.size(); ++n)
            skin_.triangles.push_back({center, polygon[n], polygon[(n + 1) % polygon.size()]});
    }

    SplitSkin skin_;
    std::unordered_map<std::uint64_t, std::uint32_t> points_; // by edge
};

} // namespace

SplitSkin splitSkin(std::vector<Vector3> positions, std::vector<Triangle> triangles) {
    return Splitter(std::move(positions), std::move(triangles)).run();
}

} // namespace sinew::mesh
