// Faces are sorted into the cells of a grid that their boxes meet; each edge looks at the faces of its cells.
#include "sinew/crossings.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace sinew::tools {

namespace {

using Vector = Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;

std::uint64_t keyOf(std::uint32_t i, std::uint32_t j) {
    return std::uint64_t{std::min(i, j)} << 32 | std::max(i, j);
}

struct Surface {
    std::vector<Vector> x; // by particle
    std::vector<Corners> faces;
    std::vector<std::array<std::uint32_t, 2>> edges; // of faces that can move, each once
};

Surface surfaceOf(const sim::Scene& scene, const State& state) {
    Surface surface;
    for (const auto& at : state.positions)
        surface.x.emplace_back(double{at[0]}, double{at[1]}, double{at[2]});
    std::unordered_set<std::uint64_t> cut, known;
    for (std::size_t d = 0; d < state.isCut.size(); ++d)
        if (!state.holds(d)) cut.insert(keyOf(scene.distances[d].a, scene.distances[d].b));
    for (const sim::Face& face : scene.faces) {
        bool isThere = true, moves = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = face.particles[k], b = face.particles[(k + 1) % 3];
            isThere = isThere && state.has(a) && surface.x[a].allFinite() && !cut.contains(keyOf(a, b));
            moves = moves || state.positions[a][3] != 0;
        }
        if (!isThere) continue;
        surface.faces.push_back(face.particles);
        for (std::size_t k = 0; k < 3 && moves; ++k) {
            const std::uint32_t a = face.particles[k], b = face.particles[(k + 1) % 3];
            if (known.insert(keyOf(a, b)).second) surface.edges.push_back({a, b});
        }
    }
    return surface;
}

// Cells of equal size over the box of all faces: at most 128 along an axis.
class Grid {
public:
    explicit Grid(const Surface& surface) : low_(Vector::Constant(std::numeric_limits<double>::max())) {
        Vector high = -low_;
        double lengths = 0;
        for (const Corners& face : surface.faces)
            for (std::size_t k = 0; k < 3; ++k) {
                low_ = low_.cwiseMin(surface.x[face[k]]);
                high = high.cwiseMax(surface.x[face[k]]);
                lengths += (surface.x[face[k]] - surface.x[face[(k + 1) % 3]]).norm();
            }
        const double mean = lengths / (3.0 * static_cast<double>(surface.faces.size()));
        edge_ = std::max({mean, (high - low_).maxCoeff() / 128, 1e-12});
        for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
            const auto& [a, b, c] = surface.faces[f];
            const Vector &p = surface.x[a], &q = surface.x[b], &r = surface.x[c];
            forEachCell(p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r),
                        [&](std::uint64_t cell) { faces_[cell].push_back(f); });
        }
    }

    // Each once, in order.
    std::vector<std::uint32_t> facesNear(const Vector& low, const Vector& high) const {
        std::vector<std::uint32_t> near;
        forEachCell(low, high, [&](std::uint64_t cell) {
            if (const auto found = faces_.find(cell); found != faces_.end())
                near.insert(near.end(), found->second.begin(), found->second.end());
        });
        std::ranges::sort(near);
        near.erase(std::unique(near.begin(), near.end()), near.end());
        return near;
    }

private:
    template <typename Visit>
    void forEachCell(const Vector& low, const Vector& high, const Visit& visit) const {
        const auto cellOf = [&](const Vector& p) -> Eigen::Vector<std::int64_t, 3> {
            return ((p - low_) / edge_).array().floor().cast<std::int64_t>().matrix();
        };
        const auto first = cellOf(low), last = cellOf(high);
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z)
                    visit(static_cast<std::uint64_t>((z * 256 + y) * 256 + x));
    }

    Vector low_;
    double edge_ = 1;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> faces_;
};

bool passesThrough(const Vector& from, const Vector& to, const Vector& a, const Vector& b, const Vector& c) {
    const Vector way = to - from, ab = b - a, ac = c - a, across = way.cross(ac);
    const double determinant = ab.dot(across);
    if (determinant == 0) return false; // parallel
    const Vector away = from - a, other = away.cross(ab);
    const double u = away.dot(across) / determinant, v = way.dot(other) / determinant;
    const double t = ac.dot(other) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

} // namespace

std::optional<std::size_t> crossingsOf(const sim::Scene& scene, const State& state) {
    const Surface surface = surfaceOf(scene, state);
    if (surface.edges.empty()) return {};
    const Grid grid(surface);
    std::size_t count = 0;
    for (const auto& [i, j] : surface.edges) {
        const Vector &from = surface.x[i], &to = surface.x[j];
        for (const std::uint32_t f : grid.facesNear(from.cwiseMin(to), from.cwiseMax(to))) {
            const Corners& face = surface.faces[f];
            if (std::ranges::any_of(face, [&](std::uint32_t k) { return k == i || k == j; })) continue;
            count += passesThrough(from, to, surface.x[face[0]], surface.x[face[1]], surface.x[face[2]]);
        }
    }
    return count;
}

} // namespace sinew::tools
