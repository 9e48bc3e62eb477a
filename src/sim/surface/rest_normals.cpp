// Sums the contributions of the triangles to their corners, in the order of triangles.
#include "sim/surface/rest_normals.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::surface {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void add(const Triangle& triangle, std::span<const Point> rest, std::vector<Point>& sums) {
    for (std::size_t n = 0; n < 3; ++n) {
        const Point& here = rest[triangle[n]];
        const Point u = rest[triangle[(n + 1) % 3]] - here, v = rest[triangle[(n + 2) % 3]] - here;
        const Point across = cross(u, v);
        const double twice = std::sqrt(dot(across, across)); // the area
        if (twice == 0) continue;
        const double longest = std::max({dot(u, u), dot(v, v), dot(v - u, v - u)});
        const double height = twice * twice / longest, blur = NORMAL_BLUR * dot(here, here); // squared
        const double weight = std::atan2(twice, dot(u, v)) * height / (height + blur) / twice;
        Point& sum = sums[triangle[n]];
        sum = {sum.x + weight * across.x, sum.y + weight * across.y, sum.z + weight * across.z};
    }
}

void normalise(Point& sum) {
    const double size = std::sqrt(dot(sum, sum)), share = size > 0 ? 1 / size : 0;
    sum = {share * sum.x, share * sum.y, share * sum.z};
}

// Barycentric coordinates of the second and the third corner; those of the centroid without an area.
std::array<float, 2> sharesAt(const Point& x, const Triangle& whole, std::span<const Point> rest) {
    const Point &a = rest[whole[0]], ab = rest[whole[1]] - a, ac = rest[whole[2]] - a, ax = x - a;
    const Point across = cross(ab, ac);
    const double area = dot(across, across);
    if (area == 0) return {1.0f / 3, 1.0f / 3};
    const double b = std::clamp(dot(cross(ax, ac), across) / area, 0.0, 1.0),
                 c = std::clamp(dot(cross(ab, ax), across) / area, 0.0, 1.0 - b);
    return {static_cast<float>(b), static_cast<float>(c)};
}

} // namespace

std::vector<Point> restNormals(std::span<const Triangle> triangles, std::span<const Point> rest) {
    std::vector<Point> sums(rest.size());
    for (const Triangle& triangle : triangles) add(triangle, rest, sums);
    std::ranges::for_each(sums, normalise);
    return sums;
}

std::vector<layout::PartVertex> partVertices(const Skin& skin, std::span<const Point> rest) {
    std::vector<layout::PartVertex> found;
    if (skin.wholeOf.empty()) return found;
    std::vector<bool> isKnown(rest.size());
    for (const Triangle& whole : skin.wholeTriangles)
        for (const std::uint32_t corner : whole) isKnown[corner] = true;
    for (std::size_t t = 0; t < skin.triangles.size(); ++t)
        for (const std::uint32_t vertex : skin.triangles[t]) {
            if (isKnown[vertex]) continue;
            isKnown[vertex] = true;
            const std::uint32_t whole = skin.wholeOf[t];
            const auto [b, c] = sharesAt(rest[vertex], skin.wholeTriangles[whole], rest);
            found.push_back({vertex, whole, {b, c}});
        }
    return found;
}

std::vector<Point> litNormals(const Skin& skin, std::span<const layout::PartVertex> parts,
                              std::span<const Point> rest) {
    if (skin.wholeOf.empty()) return restNormals(skin.triangles, rest);
    std::vector<Point> normals = restNormals(skin.wholeTriangles, rest);
    for (const layout::PartVertex& part : parts) {
        const auto& [i, j, k] = skin.wholeTriangles[part.whole];
        const Point &a = normals[i], &b = normals[j], &c = normals[k];
        const double ofB = double{part.shares[0]}, ofC = double{part.shares[1]}, ofA = 1 - ofB - ofC;
        Point& sum = normals[part.vertex];
        sum = {ofA * a.x + ofB * b.x + ofC * c.x, ofA * a.y + ofB * b.y + ofC * c.y,
               ofA * a.z + ofB * b.z + ofC * c.z};
        normalise(sum);
    }
    return normals;
}

} // namespace sinew::sim::surface
