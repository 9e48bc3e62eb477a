// Colliders are asked for each particle. Other bodies are drawn along gravity into a map of depths.
#include "sim/stiffness/carried.hpp"

#include "sim/colliders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::stiffness {

namespace {

using collision::cross;
using collision::dot;
using collision::minus;
using collision::toVector;
using collision::Vector;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double steepest = 0.5;      // sine of the slope on which friction still holds
constexpr std::size_t mostTimes = 32; // of keyframes that are looked at

double acrossLength(const Vector& v, const Vector& down) {
    const double depth = dot(v, down);
    return std::sqrt(std::max(0.0, dot(v, v) - depth * depth));
}

// In the frame of a collider: whether a ray from `from` along `down` meets it, on a round one where it is not
// steep.
bool isBelow(const Collider& collider, double kept, const Vector& from, const Vector& down) {
    if (collider.shape == ColliderShape::box) {
        const Vector half = toVector(collider.halfExtents);
        double enters = -infinite, leaves = infinite;
        for (std::size_t k = 0; k < 3; ++k) {
            const double reach = half[k] + kept;
            if (down[k] == 0 && std::abs(from[k]) > reach) return false;
            if (down[k] == 0) continue;
            const auto [first, last] =
                std::minmax({(-reach - from[k]) / down[k], (reach - from[k]) / down[k]});
            enters = std::max(enters, first);
            leaves = std::min(leaves, last);
        }
        return enters <= leaves && leaves >= 0;
    }
    // the point of the capsule's axis that is nearest to the ray's line
    const double half = collider.shape == ColliderShape::capsule ? double{collider.halfLength} : 0;
    const double flat = 1 - down[1] * down[1];
    const double height = from[1] - dot(from, down) * down[1];
    const double y = flat > 1e-12 ? std::clamp(height / flat, -half, half) : (down[1] < 0 ? -half : half);
    const Vector toAxis{-from[0], y - from[1], -from[2]};
    const double reach = double{collider.radius} + kept;
    return acrossLength(toAxis, down) <= steepest * reach && dot(toAxis, down) >= -reach;
}

// Across gravity, the two deepest of different components in each cell.
class DepthMap {
public:
    // Of the box that `places` lie in.
    DepthMap(const std::vector<Vector>& places, const Vector& down)
        : frame_(collision::frameOf(down)), cells_(std::size_t{side} * side) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            low_[axis] = infinite;
            for (const Vector& place : places)
                low_[axis] = std::min(low_[axis], dot(place, frame_[axis + 1]));
            for (const Vector& place : places)
                cell_ = std::max(cell_, (dot(place, frame_[axis + 1]) - low_[axis]) / (side - 1));
        }
        if (cell_ == 0) cell_ = 1;
    }

    void addSquare(const Vector& place, double half, std::uint32_t component) {
        const auto [depth, x, y] = onMap(place);
        const double reach = half / cell_;
        const Range columns = rangeOf(x - reach, x + reach), rows = rangeOf(y - reach, y + reach);
        for (int j = rows.first; j <= rows.last; ++j)
            for (int i = columns.first; i <= columns.last; ++i) add(i, j, depth, component);
    }

    void addTriangle(const std::array<Vector, 3>& corners, std::uint32_t component) {
        for (const Vector& corner : corners) addSquare(corner, 0, component);
        const auto [depthA, ax, ay] = onMap(corners[0]);
        const auto [depthB, bx, by] = onMap(corners[1]);
        const auto [depthC, cx, cy] = onMap(corners[2]);
        const double area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        if (area == 0) return;
        const Range columns = rangeOf(std::min({ax, bx, cx}), std::max({ax, bx, cx})),
                    rows = rangeOf(std::min({ay, by, cy}), std::max({ay, by, cy}));
        for (int j = rows.first; j <= rows.last; ++j)
            for (int i = columns.first; i <= columns.last; ++i) {
                const double v = ((i - ax) * (cy - ay) - (j - ay) * (cx - ax)) / area;
                const double w = ((bx - ax) * (j - ay) - (by - ay) * (i - ax)) / area;
                if (v < 0 || w < 0 || v + w > 1) continue;
                add(i, j, depthA + v * (depthB - depthA) + w * (depthC - depthA), component);
            }
    }

    // Whether something of another component is in the cell of `place`, no higher than `slack` above it.
    bool isBelow(const Vector& place, double slack, std::uint32_t component) const {
        const auto [depth, x, y] = onMap(place);
        const double lowest = depth - slack;
        const auto& cell =
            cells_[indexOf(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)))];
        return std::ranges::any_of(cell, [&](const Occupant& occupant) {
            return occupant.component != component && occupant.depth > lowest;
        });
    }

private:
    static constexpr int side = 256;
    struct Occupant {
        double depth = -infinite;
        std::uint32_t component = ~0u;
    };
    struct Range {
        int first, last;
    };

    // Depth [m], column and row [cells].
    Vector onMap(const Vector& place) const {
        return {dot(place, frame_[0]), (dot(place, frame_[1]) - low_[0]) / cell_,
                (dot(place, frame_[2]) - low_[1]) / cell_};
    }
    static Range rangeOf(double low, double high) {
        const auto clamped = [](double at) { return static_cast<int>(std::clamp(at, -1.0, double{side})); };
        return {std::max(0, clamped(std::round(low))), std::min(side - 1, clamped(std::round(high)))};
    }
    static std::size_t indexOf(int column, int row) {
        return static_cast<std::size_t>(std::clamp(row, 0, side - 1)) * side +
               static_cast<std::size_t>(std::clamp(column, 0, side - 1));
    }
    void add(int column, int row, double depth, std::uint32_t component) {
        auto& [deepest, second] = cells_[indexOf(column, row)];
        if (component == deepest.component) {
            deepest.depth = std::max(deepest.depth, depth);
        } else if (depth > deepest.depth) {
            second = deepest;
            deepest = {depth, component};
        } else if (depth > second.depth) {
            second = {depth, component};
        }
    }

    std::array<Vector, 3> frame_; // down first
    std::array<double, 2> low_{}; // [m]
    double cell_ = 0;             // [m]
    std::vector<std::array<Occupant, 2>> cells_;
};

bool isSteep(const std::array<Vector, 3>& corners, const Vector& down) {
    const Vector normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    return acrossLength(normal, down) > steepest * std::sqrt(dot(normal, normal));
}

} // namespace

std::vector<double> timesOf(const Scene& scene) {
    std::vector<double> times{0};
    for (const Collider& collider : scene.colliders)
        for (const Keyframe& key : collider.path) times.push_back(double{key.time});
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.size() <= mostTimes) return times;
    std::vector<double> some;
    for (std::size_t k = 0; k < mostTimes; ++k)
        some.push_back(times[k * (times.size() - 1) / (mostTimes - 1)]);
    return some;
}

void addCarriedByColliders(const Scene& scene, double time, const Vector& down, Holds& holds) {
    for (const Collider& collider : scene.colliders) {
        const Pose pose = poseAt(collider, time);
        const Vec3 axis{static_cast<float>(down[0]), static_cast<float>(down[1]),
                        static_cast<float>(down[2])};
        const Vector localDown = toVector(toLocal({.position = {}, .rotation = pose.rotation}, axis));
        for (std::size_t i = 0; i < holds.isHeld.size(); ++i) {
            const Particle& particle = scene.particles[i];
            const Vector from = toVector(toLocal(pose, particle.position));
            const double kept = double{collider.margin} + double{particle.contactOffset};
            if (!isBelow(collider, kept, from, localDown)) continue;
            holds.isHeld[i] = true;
            if (collider.shape == ColliderShape::box) holds.isSharp[i] = true;
        }
    }
}

void addCarriedByBodies(const Scene& scene, std::span<const std::uint32_t> components, const Vector& down,
                        Holds& holds) {
    std::vector<double> reaches(scene.particles.size(), 0); // of what touches others
    for (std::size_t i = 0; i < reaches.size(); ++i) reaches[i] = double{scene.particles[i].radius};
    for (const Face& face : scene.faces)
        for (const std::uint32_t corner : face.particles)
            reaches[corner] = std::max(reaches[corner], double{face.thickness});
    std::vector<bool> isLinked(scene.particles.size());
    for (const DistanceConstraint& c : scene.distances) isLinked[c.a] = isLinked[c.b] = true;
    std::vector<Vector> asked;
    for (std::size_t i = 0; i < reaches.size(); ++i)
        if (reaches[i] > 0 && isLinked[i]) asked.push_back(toVector(scene.particles[i].position));
    if (asked.empty()) return;

    DepthMap map(asked, down);
    for (std::size_t i = 0; i < reaches.size(); ++i)
        if (const double radius{scene.particles[i].radius}; radius > 0)
            map.addSquare(toVector(scene.particles[i].position), (isLinked[i] ? 1 : steepest) * radius,
                          components[i]);
    for (const Face& face : scene.faces) {
        std::array<Vector, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = toVector(scene.particles[face.particles[k]].position);
        if (!isSteep(corners, down)) map.addTriangle(corners, components[face.particles[0]]);
    }
    for (std::size_t i = 0; i < reaches.size(); ++i)
        if (reaches[i] > 0 && isLinked[i] &&
            map.isBelow(toVector(scene.particles[i].position), reaches[i], components[i]))
            holds.isHeld[i] = holds.isSharp[i] = true;
}

} // namespace sinew::sim::stiffness
