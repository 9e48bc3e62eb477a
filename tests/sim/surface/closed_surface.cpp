// Points have the names of layout::CutVertex: a number of their own, or a particle.
#include "sim/surface/closed_surface.hpp"

#include "common/layout.h"
#include "sim/scenes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace sinew::test {

using Eigen::Vector3d;
using namespace sim;

namespace {

template <typename T> std::vector<T> read(CutBody& body, BufferId buffer, std::uint64_t& hash) {
    const vk::BufferView view = body.runner().simulation().view(buffer);
    hash = fnv1a(queue().download<std::byte>(view), hash);
    return queue().download<T>(view);
}

Vector3d xyz(const layout::vec4& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

Vector3d embedded(const CutBody& body, const CellEmbedding& cell) {
    Vector3d x = Vector3d::Zero();
    const Vector3d t(double{cell.weights.x}, double{cell.weights.y}, double{cell.weights.z});
    for (std::uint32_t k = 0; k < 8; ++k) {
        double share = 1;
        for (std::uint32_t axis = 0; axis < 3; ++axis) share *= (k >> axis & 1) != 0 ? t[axis] : 1 - t[axis];
        x += share * body.at(cell.particles[k]);
    }
    return x;
}

} // namespace

ClosedSurface::ClosedSurface(CutBody& body) {
    body.runner().skin();
    addCut(body);
    addSkin(body);
}

std::uint32_t ClosedSurface::pointOf(std::uint32_t key, const Vector3d& rest, const Vector3d& drawn) {
    const auto [entry, isNew] = points_.try_emplace(key, static_cast<std::uint32_t>(rest_.size()));
    if (isNew) {
        rest_.push_back(rest);
        drawn_.push_back(drawn);
    }
    return entry->second;
}

// Positions of skin vertices that have moved beside a cut.
std::map<std::uint32_t, Vector3d> ClosedSurface::movedVertices(CutBody& body) {
    const CutSurfaceBuffers& buffers = body.runner().simulation().program().cutSurface;
    std::map<std::uint32_t, Vector3d> vertices;
    if (buffers.hung == BufferId{}) return vertices;
    const auto hung = read<layout::HungVertex>(body, buffers.hung, hash_);
    const auto moved = read<layout::vec4>(body, buffers.moved, hash_);
    for (std::size_t v = 0; v < hung.size(); ++v)
        if (moved[v].w >= VERTEX_MOVED) vertices.emplace(hung[v].vertex, xyz(moved[v]));
    return vertices;
}

void ClosedSurface::addSkin(CutBody& body) {
    const StepProgram& program = body.runner().simulation().program();
    const auto moved = movedVertices(body);
    const Skin& skin = body.scene().skins.at(0);
    const auto indices = read<std::uint32_t>(body, program.skinIndices, hash_);
    const auto vertices = read<layout::SkinVertex>(body, program.skinVertices, hash_);
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
        if (indices[3 * t] == indices[3 * t + 1]) continue; // it is drawn in pieces
        Triangle triangle;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t vertex = indices[3 * t + n];
            const bool isMesh = skin.particles.empty();
            const auto place = moved.find(vertex);
            const Vector3d rest = place != moved.end() ? place->second
                                  : isMesh             ? embedded(body, skin.cells[vertex])
                                                       : body.at(skin.particles[vertex]);
            triangle.points[n] =
                pointOf(isMesh ? SURFACE_SKIN | vertex : SURFACE_PARTICLE | skin.particles[vertex], rest,
                        xyz(vertices[vertex].position));
            triangle.normals[n] = xyz(vertices[vertex].normal);
        }
        triangles_.push_back(triangle);
    }
}

void ClosedSurface::addCut(CutBody& body) {
    const CutSurfaceBuffers& buffers = body.runner().simulation().program().cutSurface;
    const auto draws = read<layout::DrawArguments>(body, buffers.draws, hash_);
    const auto indices = read<std::uint32_t>(body, buffers.indices, hash_);
    const auto vertices = read<layout::SkinVertex>(body, buffers.vertices, hash_);
    const auto rest = read<layout::CutVertex>(body, buffers.rest, hash_);
    for (std::size_t draw = 0; draw < 2; ++draw)
        for (std::uint32_t t = 0; t < draws[draw].indexCount / 3; ++t) {
            Triangle triangle{.points = {}, .normals = {}, .part = draw == 0 ? Part::inside : Part::outside};
            for (std::size_t n = 0; n < 3; ++n) {
                const std::uint32_t v = indices[draws[draw].firstIndex + 3 * t + n];
                triangle.points[n] = pointOf(rest[v].point, xyz(rest[v].rest), xyz(vertices[v].position));
                triangle.normals[n] = xyz(vertices[v].normal);
            }
            triangles_.push_back(triangle);
        }
}

std::size_t ClosedSurface::openEdges() const {
    std::map<std::array<std::uint32_t, 2>, int> balance;
    for (const Triangle& triangle : triangles_)
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = triangle.points[n], b = triangle.points[(n + 1) % 3];
            if (a != b) balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    return static_cast<std::size_t>(
        std::ranges::count_if(balance, [](const auto& e) { return e.second != 0; }));
}

std::size_t ClosedSurface::crowdedEdges() const {
    std::map<std::array<std::uint32_t, 2>, int> count;
    for (const Triangle& triangle : triangles_)
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = triangle.points[n], b = triangle.points[(n + 1) % 3];
            ++count[{std::min(a, b), std::max(a, b)}];
        }
    return static_cast<std::size_t>(std::ranges::count_if(count, [](const auto& e) { return e.second > 2; }));
}

std::vector<double> ClosedSurface::volumes(double cell) const {
    std::vector<std::uint32_t> parent(rest_.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Triangle& t : triangles_)
        for (std::size_t n = 1; n < 3; ++n) parent[root(t.points[0])] = root(t.points[n]);
    std::map<std::uint32_t, double> volumes;
    for (const Triangle& t : triangles_)
        volumes[root(t.points[0])] +=
            rest_[t.points[0]].dot(rest_[t.points[1]].cross(rest_[t.points[2]])) / 6;
    std::vector<double> result;
    for (const auto& [point, volume] : volumes)
        if (std::abs(volume) > 1e-9 * cell) result.push_back(volume);
    std::ranges::sort(result, std::greater<>());
    return result;
}

double ClosedSurface::volume() const {
    double sum = 0;
    for (const Triangle& t : triangles_)
        sum += rest_[t.points[0]].dot(rest_[t.points[1]].cross(rest_[t.points[2]])) / 6;
    return sum;
}

double ClosedSurface::areaOf(Part part, const std::vector<Vector3d>& places) const {
    double sum = 0;
    for (const Triangle& t : triangles_) {
        const Vector3d a = places[t.points[0]];
        if (t.part == part) sum += (places[t.points[1]] - a).cross(places[t.points[2]] - a).norm() / 2;
    }
    return sum;
}

double ClosedSurface::area(Part part) const {
    return areaOf(part, rest_);
}

double ClosedSurface::drawnArea(Part part) const {
    return areaOf(part, drawn_);
}

// Sums what the segments in all triangles enclose.
ClosedSurface::Section ClosedSurface::section(const CutPlane& plane) const {
    double twice = 0;
    Section section;
    for (const auto& triangle : triangles_) {
        std::array<Vector3d, 2> ends; // where the triangle crosses the plane upwards and downwards
        int found = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            const Vector3d a = rest_[triangle.points[n]], b = rest_[triangle.points[(n + 1) % 3]];
            const double from = plane.normal.dot(a - plane.point), to = plane.normal.dot(b - plane.point);
            if ((from >= 0) == (to >= 0)) continue;
            ends[from < 0 ? 0 : 1] = a + from / (from - to) * (b - a);
            ++found;
        }
        if (found != 2) continue;
        twice += plane.normal.dot((ends[0] - plane.point).cross(ends[1] - plane.point));
        section.rim += (ends[1] - ends[0]).norm();
    }
    section.area = std::abs(twice) / 2;
    return section;
}

// Counts entries and exits of the line, also before its start, because the surface may have several parts.
ClosedSurface::Chord ClosedSurface::chord(const Vector3d& from, const Vector3d& to,
                                          const std::vector<Vector3d>& places) const {
    const Vector3d way = to - from;
    double share = 0;
    int atStart = 0, atEnd = 0; // winding numbers
    for (const Triangle& triangle : triangles_) {
        const Vector3d &a = places[triangle.points[0]], ab = places[triangle.points[1]] - a,
                       ac = places[triangle.points[2]] - a, p = way.cross(ac), start = from - a,
                       q = start.cross(ab);
        const double volume = ab.dot(p);
        if (volume == 0) continue;
        const double u = start.dot(p) / volume, v = way.dot(q) / volume;
        if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
        const double at = ac.dot(q) / volume;
        const int turn = volume > 0 ? 1 : -1; // against the normal, the line enters
        share += turn * (1 - std::clamp(at, 0.0, 1.0));
        atStart += at < 0 ? turn : 0;
        atEnd += at < 1 ? turn : 0;
    }
    return {share * way.norm(), atStart > 0, atEnd > 0};
}

std::uint64_t ClosedSurface::hash() const {
    return hash_;
}

} // namespace sinew::test
