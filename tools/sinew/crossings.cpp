// Faces are sorted into the grid cells that their boxes overlap; each edge tests the faces in its cells.
#include "sinew/crossings.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
    std::vector<std::array<std::uint32_t, 2>> edges; // of movable faces, each once
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

using GridCell = Eigen::Vector<std::int64_t, 3>;

// Grid with cells of the mean edge length. Items that span more than a few cells are tested against all.
class Grid {
public:
    explicit Grid(const Surface& surface) {
        double lengths = 0;
        for (const Corners& face : surface.faces)
            for (std::size_t k = 0; k < 3; ++k)
                lengths += (surface.x[face[k]] - surface.x[face[(k + 1) % 3]]).norm();
        edge_ = std::max(lengths / (3.0 * static_cast<double>(surface.faces.size())), 1e-12);
        for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
            const auto& [a, b, c] = surface.faces[f];
            const Vector &p = surface.x[a], &q = surface.x[b], &r = surface.x[c];
            const Vector low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
            boxes_.push_back({low, high});
            if (isWide(low, high))
                wide_.push_back(f);
            else
                forEachCell(low, high, [&](std::uint64_t cell) { faces_[cell].push_back(f); });
        }
    }

    // Calls visit(face) once for each face whose box overlaps this one.
    template <typename Visit>
    void forEachNear(const Vector& low, const Vector& high, const Visit& visit) const {
        const auto look = [&](std::uint32_t f) {
            const auto& [first, last] = boxes_[f];
            if ((first.array() <= high.array()).all() && (low.array() <= last.array()).all()) visit(f);
        };
        if (isWide(low, high)) {
            for (std::uint32_t f = 0; f < boxes_.size(); ++f) look(f);
            return;
        }
        std::vector<std::uint32_t> near = wide_;
        forEachCell(low, high, [&](std::uint64_t cell) {
            if (const auto found = faces_.find(cell); found != faces_.end())
                near.insert(near.end(), found->second.begin(), found->second.end());
        });
        std::ranges::sort(near);
        near.erase(std::unique(near.begin(), near.end()), near.end());
        for (const std::uint32_t f : near) look(f);
    }

private:
    static constexpr double mostCells = 6; // along an axis

    bool isWide(const Vector& low, const Vector& high) const {
        return (high - low).maxCoeff() > mostCells * edge_;
    }

    // Distant cells may share keys, which only costs time.
    template <typename Visit>
    void forEachCell(const Vector& low, const Vector& high, const Visit& visit) const {
        const auto cellOf = [&](const Vector& p) -> GridCell {
            return (p / edge_).array().floor().max(-1e15).min(1e15).cast<std::int64_t>().matrix();
        };
        const GridCell first = cellOf(low), last = cellOf(high);
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z)
                    visit(keyOf(x) << 42 | keyOf(y) << 21 | keyOf(z));
    }
    static std::uint64_t keyOf(std::int64_t index) { return static_cast<std::uint64_t>(index) & 0x1fffffu; }

    double edge_ = 1;
    std::vector<std::array<Vector, 2>> boxes_; // of faces
    std::vector<std::uint32_t> wide_;
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
    for (const auto& edge : surface.edges) {
        const std::uint32_t i = edge[0], j = edge[1];
        const Vector &from = surface.x[i], &to = surface.x[j];
        grid.forEachNear(from.cwiseMin(to), from.cwiseMax(to), [&](std::uint32_t f) {
            const Corners& face = surface.faces[f];
            if (std::ranges::any_of(face, [&](std::uint32_t k) { return k == i || k == j; })) return;
            count +=
                passesThrough(from, to, surface.x[face[0]], surface.x[face[1]], surface.x[face[2]]) ? 1 : 0;
        });
    }
    return count;
}

} // namespace sinew::tools
