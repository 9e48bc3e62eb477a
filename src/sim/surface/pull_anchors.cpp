// The nearest point of the skin is in one of the eight cells around a particle, because vertices that follow
// the particle are there.
#include "sim/surface/point.hpp"
#include "sim/surface/skin_complex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::surface {

namespace {

Point along(const Point& a, double t, const Point& way) {
    return {a.x + t * way.x, a.y + t * way.y, a.z + t * way.z};
}

// The point of triangle `t` nearest to `p` [Ericson 2005, 5.1.5].
Point nearestOn(const Point& p, const std::array<Point, 3>& t) {
    const Point ab = t[1] - t[0], ac = t[2] - t[0], bc = t[2] - t[1];
    const Point ap = p - t[0], bp = p - t[1], cp = p - t[2];
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return t[0];
    if (d3 >= 0 && d4 <= d3) return t[1];
    if (d6 >= 0 && d5 <= d6) return t[2];
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(t[0], d1 / (d1 - d3), ab);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(t[0], d2 / (d2 - d6), ac);
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(t[1], (d4 - d3) / ((d4 - d3) + (d5 - d6)), bc);
    const double sum = va + vb + vc;
    return along(along(t[0], vb / sum, ab), vc / sum, ac);
}

class Puller {
public:
    Puller(const Scene& scene, const Grid& grid, const SkinComplex& complex)
        : scene_(scene), grid_(grid), complex_(complex) {
        for (std::uint32_t t = 0; t < complex.prisms.size(); ++t)
            for (const std::uint32_t vertex : complex.prisms[t].vertices)
                triangles_.push_back({vertexOf(vertex).cell, t});
        std::ranges::sort(triangles_);
        triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    }

    // The pulled position of a particle; none if it is inside or on the skin.
    std::optional<Vec3> place(const lattice::Box& box, std::uint32_t particle) const {
        const Particle& self = scene_.particles[particle];
        if (!(self.contactOffset < 0)) return std::nullopt;
        const Point x = pointOf(self.position);
        const auto node = lattice::coordinates(grid_, grid_.node[particle - grid_.firstParticle]);
        Point best;
        double least = std::numeric_limits<double>::max();
        for (std::uint32_t k = 0; k < 8; ++k) {
            const std::uint32_t cell =
                box.slot(node[0] - (k & 1), node[1] - (k >> 1 & 1), node[2] - (k >> 2));
            for (auto at = std::ranges::lower_bound(triangles_, std::pair{cell, 0u});
                 at != triangles_.end() && at->first == cell; ++at) {
                const Point nearest = nearestOn(x, corners(at->second)), way = nearest - x;
                if (dot(way, way) >= least) continue;
                least = dot(way, way);
                best = nearest;
            }
        }
        const double spacing = double{grid_.restLength[0]}, distance = std::sqrt(least);
        if (!(distance > 1e-4 * spacing) || distance > 2 * spacing) return std::nullopt;
        constexpr double below = 0.04; // cells
        const Point pulled = along(best, below * spacing / distance, best - x);
        return toVec3(pulled);
    }

private:
    const layout::HungVertex& vertexOf(std::uint32_t vertex) const {
        return complex_.vertices[vertex - complex_.firstHung];
    }
    std::array<Point, 3> corners(std::uint32_t triangle) const {
        const auto& v = complex_.prisms[triangle].vertices;
        return {pointOf(vertexOf(v[0]).rest), pointOf(vertexOf(v[1]).rest), pointOf(vertexOf(v[2]).rest)};
    }

    const Scene& scene_;
    const Grid& grid_;
    const SkinComplex& complex_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> triangles_; // by cell
};

} // namespace

std::vector<std::pair<std::uint32_t, Vec3>> pullAnchors(const Scene& scene, const Grid& grid,
                                                        const lattice::Box& box, const SkinComplex& complex) {
    const Puller puller(scene, grid, complex);
    std::vector<std::uint32_t> anchors = scene.skins[complex.skin].anchors;
    std::ranges::sort(anchors);
    anchors.erase(std::unique(anchors.begin(), anchors.end()), anchors.end());
    std::vector<std::pair<std::uint32_t, Vec3>> pulled;
    for (const std::uint32_t particle : anchors) {
        const auto node = lattice::coordinates(grid, grid.node[particle - grid.firstParticle]);
        if (const auto place = puller.place(box, particle))
            pulled.push_back({box.slot(node[0], node[1], node[2]), *place});
    }
    return pulled;
}

} // namespace sinew::sim::surface
