#include "sim/collision/passage.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

using Eigen::Vector3d;

namespace sinew::test {

namespace {

// A cubic c[0] + c[1] t + c[2] t^2 + c[3] t^3.
using Cubic = std::array<double, 4>;

double at(const Cubic& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

// The volume that three vectors span, over time.
Cubic volumeOf(const Corners& e, const Corners& d) {
    const auto triple = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        return a.cross(b).dot(c);
    };
    return {triple(e[0], e[1], e[2]),
            triple(d[0], e[1], e[2]) + triple(e[0], d[1], e[2]) + triple(e[0], e[1], d[2]),
            triple(d[0], d[1], e[2]) + triple(d[0], e[1], d[2]) + triple(e[0], d[1], d[2]),
            triple(d[0], d[1], d[2])};
}

// Times from 0 to 1 that divide the cubic into parts that only rise or only fall.
std::vector<double> turnsOf(const Cubic& c) {
    std::vector<double> turns{0};
    const double a = 3 * c[3], b = 2 * c[2], root = b * b - 4 * a * c[1];
    if (root >= 0) {
        const double q = -(b + std::copysign(std::sqrt(root), b)) / 2;
        for (const double t : {q / a, c[1] / q})
            if (t > 0 && t < 1) turns.push_back(t);
    }
    turns.push_back(1);
    std::ranges::sort(turns);
    return turns;
}

double rootBetween(const Cubic& c, double low, double high) {
    const bool isAbove = at(c, low) > 0;
    for (int turn = 0; turn < 60; ++turn) {
        const double middle = (low + high) / 2;
        ((at(c, middle) > 0) == isAbove ? low : high) = middle;
    }
    return (low + high) / 2;
}

// Whether a point, relative to the first corner of a triangle with these edges, is in it.
bool isInside(const Corners& edges) {
    const Vector3d n = edges[0].cross(edges[1]);
    const double area = n.squaredNorm();
    const double b = edges[2].cross(edges[1]).dot(n) / area, c = edges[0].cross(edges[2]).dot(n) / area;
    return area > 0 && b >= 0 && c >= 0 && b + c <= 1;
}

// Whether two edges in one plane cross; the third vector leads from an end of the second to one of the first.
bool areCrossed(const Corners& edges) {
    const Vector3d n = edges[0].cross(edges[1]);
    const double area = n.squaredNorm();
    const double s = edges[1].cross(edges[2]).dot(n) / area, t = edges[0].cross(edges[2]).dot(n) / area;
    return area > 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1;
}

// Whether three vectors come into one plane, at a time at which `isMet` holds for them.
template <typename Test> bool pass(const Corners& vectors, const Corners& ends, const Test& isMet) {
    Corners ways = vectors;
    for (std::size_t k = 0; k < 3; ++k) ways[k] = ends[k] - vectors[k];
    const Cubic volume = volumeOf(vectors, ways);
    const std::vector<double> turns = turnsOf(volume);
    for (std::size_t k = 0; k + 1 < turns.size(); ++k) {
        if ((at(volume, turns[k]) > 0) == (at(volume, turns[k + 1]) > 0)) continue;
        const double t = rootBetween(volume, turns[k], turns[k + 1]);
        Corners then;
        for (std::size_t e = 0; e < 3; ++e) then[e] = vectors[e] + t * ways[e];
        if (isMet(then)) return true;
    }
    return false;
}

} // namespace

bool passesThrough(const Vector3d& from, const Vector3d& to, const Corners& before, const Corners& after) {
    return pass({before[1] - before[0], before[2] - before[0], from - before[0]},
                {after[1] - after[0], after[2] - after[0], to - after[0]}, isInside);
}

bool edgesPass(const Ends& before, const Ends& after) {
    return pass({before[1] - before[0], before[3] - before[2], before[0] - before[2]},
                {after[1] - after[0], after[3] - after[2], after[0] - after[2]}, areCrossed);
}

} // namespace sinew::test
