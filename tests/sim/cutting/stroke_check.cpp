// Computes all geometry in double from read-back data.
#include "sim/cutting/stroke_check.hpp"

#include "sim/compile/compile.hpp"
#include "sim/lattice/placement.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <numeric>

namespace sinew::test {

using Eigen::Vector3d;
using namespace sim;

namespace {

constexpr double hair =
    2e-3; // of the spacing: a point nearer than this to a plane or an outline may be on either side

/// A triangle of a blade. An open edge has no triangle beyond it.
struct BladePart {
    std::array<Vector3d, 3> corners;
    std::array<bool, 3> isOpen{}; // edge from corner n to the next
};

std::vector<BladePart> partsOf(const Blade& blade) {
    std::vector<BladePart> parts;
    const auto last = blade.from.size() - 1;
    for (std::size_t p = 0; p < last; ++p) {
        const Vector3d a = toVector(blade.from[p]), b = toVector(blade.from[p + 1]),
                       c = toVector(blade.to[p + 1]), d = toVector(blade.to[p]);
        parts.push_back({{a, b, c}, {true, p + 1 == last, false}});
        parts.push_back({{a, c, d}, {false, true, p == 0}});
    }
    return parts;
}

bool leadsThrough(const BladePart& part, const Vector3d& from, const Vector3d& to, double margin) {
    const auto& [a, b, c] = part.corners;
    const Vector3d area = (b - a).cross(c - a);
    if (area.norm() < margin * margin) return false;
    const Vector3d normal = area.normalized();
    const double above = normal.dot(from - a), below = normal.dot(to - a);
    if (std::min(std::abs(above), std::abs(below)) < margin || (above > 0) == (below > 0)) return false;
    const Vector3d x = from + above / (above - below) * (to - from);
    // The blade is shifted by a thousandth of a cell (BLADE_SHIFT_X ...). A link at a small angle meets it
    // farther along itself in proportion.
    const double within = margin * (to - from).norm() / std::abs(above - below);
    for (std::size_t n = 0; n < 3; ++n) {
        const Vector3d edge = part.corners[(n + 1) % 3] - part.corners[n];
        const double inside = normal.dot(edge.normalized().cross(x - part.corners[n]));
        if (!(inside >= (part.isOpen[n] ? within : 0))) return false; // false for an edge without length
    }
    return true;
}

bool hasSurface(CutBody& body) {
    return body.runner().simulation().cutSurface().vertices.size > 0;
}

} // namespace

StrokeCheck::StrokeCheck(const Scene& scene, const Settings& settings, bool isFree)
    : body_(scene, settings), inverseMasses_(sim::inverseMasses(scene)), isFree_(isFree) {
    for (const float inverse : inverseMasses_) masses_.push_back(inverse > 0 ? 1 / double{inverse} : 0);
    body_.runner().run(1);
    if (hasSurface(body_)) uncutVolume_ = ClosedSurface(body_).volume();
}

Vector3d StrokeCheck::momentum(double& scale) {
    const auto v = body_.runner().velocities();
    Vector3d sum = Vector3d::Zero();
    scale = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        sum += masses_[i] * v[i];
        scale += masses_[i] * v[i].norm();
    }
    return sum;
}

void StrokeCheck::run(int steps) {
    for (int s = 0; s < steps; ++s) ASSERT_EQ(body_.runner().run(1).nonFinite, 0u);
}

std::size_t StrokeCheck::crossings(const Blade& blade) const {
    const auto parts = partsOf(blade);
    const auto places = body_.bladePlaces();
    const double margin = hair * body_.spacing();
    const auto crosses = [&](const LiveLink& link) {
        return std::ranges::any_of(parts, [&](const BladePart& part) {
            return leadsThrough(part, places[link.a], places[link.b], margin);
        });
    };
    return static_cast<std::size_t>(std::ranges::count_if(body_.links(), crosses));
}

void StrokeCheck::checkLinks(const std::string& what, StrokeResult& result) {
    EXPECT_EQ(body_.oneSided(), 0u) << what << ": a dead link has two dead ends";
    const auto pieces = body_.pieces();
    EXPECT_EQ(pieces, body_.expectedPieces()) << what;
    std::vector<std::uint32_t> names;
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        if (pieces[i] == i) names.push_back(i);
    EXPECT_EQ(result.status.pieces, names.size()) << what;
    const auto sizes = body_.pieceSizes();
    EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}), body_.scene().grids[0].node.size())
        << what;
    if (!lattice::isSheet(body_.scene().grids[0])) {
        EXPECT_EQ(body_.looseLinks(), 0u) << what << ": rule K";
    }
    EXPECT_EQ(body_.runner().inverseMasses(), inverseMasses_) << what << ": masses";
    result.live = body_.links().size();
}

StrokeResult StrokeCheck::stroke(const Blade& blade, const std::string& what) {
    StrokeResult result;
    double scale = 0, ignored = 0;
    const Vector3d before = momentum(scale);
    const auto start = std::chrono::steady_clock::now();
    result.status = body_.runner().cut(blade);
    result.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    EXPECT_EQ(result.status.nonFinite, 0u) << what;
    EXPECT_EQ(result.status.contactRoom, 0u) << what;
    if (isFree_) {
        result.momentumError = (momentum(ignored) - before).norm() / std::max(scale, 1e-30);
        EXPECT_LT(result.momentumError, 1e-5) << what;
    }
    if (!blade.from.empty() && !blade.isCarried) {
        EXPECT_EQ(crossings(blade), 0u) << what;
    }
    checkLinks(what, result);
    return result;
}

void StrokeCheck::checkSurface(StrokeResult& result, const std::string& what) {
    if (uncutVolume_ == 0) return;
    EXPECT_EQ(result.status.cutSurfaceMissing, 0u) << what;
    const ClosedSurface surface(body_);
    const double cell = std::pow(body_.spacing(), 3);
    const auto volumes = surface.volumes(cell);
    result.openEdges = surface.openEdges();
    result.crowdedEdges = surface.crowdedEdges();
    result.triangles = surface.triangles().size();
    result.parts = volumes.size();
    result.volumeError = std::accumulate(volumes.begin(), volumes.end(), 0.0) / uncutVolume_ - 1;
    EXPECT_EQ(result.openEdges, 0u) << what;
    EXPECT_LT(std::abs(result.volumeError), 0.01) << what;
    EXPECT_TRUE(std::ranges::all_of(surface.drawn(), [](const Vector3d& x) { return x.allFinite(); }))
        << what;
}

} // namespace sinew::test
