// Which points of a linked body may not touch which of its faces, from the scene at rest: what is so near
// there is kept apart by links.
#include "sim/collision/contact_lists.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/collision/vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace sinew::sim::collision::face_contacts {

namespace {

constexpr double nearness = 1.05;

double distance(const Vector& p, const std::array<Vector, 3>& x) {
    const Vector ab = minus(x[1], x[0]), ac = minus(x[2], x[0]), ap = minus(p, x[0]), n = cross(ab, ac);
    const double nn = dot(n, n), b = dot(cross(ap, ac), n), c = dot(cross(ab, ap), n);
    if (nn > 0 && b >= 0 && c >= 0 && b + c <= nn) return std::abs(dot(ap, n)) / std::sqrt(nn);
    return std::sqrt(std::min(
        {squaredToSegment(p, x[0], x[1]), squaredToSegment(p, x[1], x[2]), squaredToSegment(p, x[2], x[0])}));
}

// Whether a point is that near to the box around three others.
bool isInBox(const Vector& p, const std::array<Vector, 3>& x, double reach) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({x[0][axis], x[1][axis], x[2][axis]});
        if (p[axis] < low - reach || p[axis] > high + reach) return false;
    }
    return true;
}

using Cell = std::array<std::int64_t, 3>;

// The points of one linked body, in cells as wide as a face reaches.
class Points {
public:
    Points(const Scene& scene, std::span<const float> radii) : scene_(scene), radii_(radii) {}

    void add(std::uint32_t i) {
        members_.push_back(i);
        widest_ = std::max(widest_, double{radii_[i]});
    }

    // For faces whose boxes are at most `extent` wide and which are at most so thick.
    void sort(double extent, double thickness) {
        edge_ = std::max(extent + 2 * nearness * (thickness + widest_), 1e-30);
        for (const std::uint32_t i : members_)
            cells_[cellOf(toVector(scene_.particles[i].position))].push_back(i);
    }

    void addNear(const layout::ContactFace& face, std::vector<std::uint32_t>& near) const {
        const std::array<std::uint32_t, 3> corners{face.a, face.b, face.c};
        std::array<Vector, 3> x;
        for (int c = 0; c < 3; ++c) x[c] = toVector(scene_.particles[corners[c]].position);
        const Cell home = cellOf(x[0]);
        for (std::int64_t n = 0; n < 27; ++n) {
            const auto found =
                cells_.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
            if (found == cells_.end()) continue;
            for (const std::uint32_t i : found->second) {
                if (std::ranges::find(corners, i) != corners.end()) continue;
                const double reach = nearness * (double{radii_[i]} + double{face.thickness});
                const Vector p = toVector(scene_.particles[i].position);
                if (isInBox(p, x, reach) && distance(p, x) < reach) near.push_back(i);
            }
        }
    }

private:
    Cell cellOf(const Vector& x) const {
        const auto index = [this](double value) {
            return static_cast<std::int64_t>(std::floor(value / edge_));
        };
        return {index(x[0]), index(x[1]), index(x[2])};
    }

    const Scene& scene_;
    std::span<const float> radii_;
    std::vector<std::uint32_t> members_;
    std::map<Cell, std::vector<std::uint32_t>> cells_;
    double widest_ = 0, edge_ = 1;
};

double extentOf(const Scene& scene, const layout::ContactFace& face) {
    const Vector a = toVector(scene.particles[face.a].position);
    double extent = 0;
    for (const std::uint32_t corner : {face.b, face.c}) {
        const Vector d = minus(toVector(scene.particles[corner].position), a);
        extent = std::max(extent, std::sqrt(dot(d, d)));
    }
    return extent;
}

} // namespace

std::vector<std::uint32_t> excludedPoints(const Scene& scene, std::span<const layout::ContactFace> faces,
                                          std::span<const float> radii, const StateLayout& layout) {
    const std::vector<std::uint32_t> bodies = contact_lists::linkedBodies(scene);
    struct Body {
        Points points;
        double extent = 0, thickness = 0;
    };
    std::map<std::uint32_t, Body> ofFaces;
    for (const layout::ContactFace& face : faces) {
        Body& body = ofFaces.try_emplace(bodies[face.a], Body{Points(scene, radii)}).first->second;
        body.extent = std::max(body.extent, extentOf(scene, face));
        body.thickness = std::max(body.thickness, double{face.thickness});
    }
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        if (const auto found = ofFaces.find(bodies[i]); found != ofFaces.end() && radii[i] >= 0)
            found->second.points.add(i);
    for (auto& [first, body] : ofFaces) body.points.sort(body.extent, body.thickness);
    std::vector<std::uint32_t> result(faces.size() + 1), near;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        result[f] = static_cast<std::uint32_t>(result.size());
        near.clear();
        ofFaces.at(bodies[faces[f].a]).points.addNear(faces[f], near);
        for (std::uint32_t& i : near) i = layout.slot[i];
        std::ranges::sort(near);
        result.insert(result.end(), near.begin(), near.end());
    }
    result[faces.size()] = static_cast<std::uint32_t>(result.size());
    return result;
}

} // namespace sinew::sim::collision::face_contacts
