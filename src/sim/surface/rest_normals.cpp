// Adds what each triangle says to its corners, in their order.
#include "sim/surface/rest_normals.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::surface {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

void add(const Triangle& triangle, std::span<const Point> rest, std::vector<Point>& sums) {
    for (std::size_t n = 0; n < 3; ++n) {
        const Point& here = rest[triangle[n]];
        const Point u = rest[triangle[(n + 1) % 3]] - here, v = rest[triangle[(n + 2) % 3]] - here;
        const Point across{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double twice = std::sqrt(dot(across, across)); // the area
        if (twice == 0) continue;
        const double longest = std::max({dot(u, u), dot(v, v), dot(v - u, v - u)});
        const double height = twice * twice / longest, blur = 4e-12 * dot(here, here); // squared
        const double weight = std::atan2(twice, dot(u, v)) * height / (height + blur) / twice;
        Point& sum = sums[triangle[n]];
        sum = {sum.x + weight * across.x, sum.y + weight * across.y, sum.z + weight * across.z};
    }
}

} // namespace

std::vector<Point> restNormals(const Skin& skin, std::span<const Point> rest) {
    std::vector<Point> sums(rest.size());
    for (const Triangle& triangle : skin.triangles) add(triangle, rest, sums);
    if (!skin.wholeOf.empty()) {
        for (const Triangle& whole : skin.wholeTriangles)
            for (const std::uint32_t corner : whole) sums[corner] = {};
        for (const Triangle& whole : skin.wholeTriangles) add(whole, rest, sums);
    }
    for (Point& sum : sums) {
        const double size = std::sqrt(dot(sum, sum)), scale = size > 0 ? 1 / size : 0;
        sum = {scale * sum.x, scale * sum.y, scale * sum.z};
    }
    return sums;
}

} // namespace sinew::sim::surface
