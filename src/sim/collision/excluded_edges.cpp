// The edges of a scene, and pairs of edges of a linked body that may not touch, from the scene at rest: links
// keep apart what is so near there.
#include "sim/collision/contact_lists.hpp"
#include "sim/collision/edge_contacts.hpp"
#include "sim/collision/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sinew::sim::collision::edge_contacts {

namespace {

using edge_lists::Edge;

constexpr double nearness = 1.05;

// Largest stretch of an edge at which all of it still touches others.
constexpr double mostStretch = 1.5;

// Sine of the angle between two faces below which their edge counts as part of a plane.
constexpr double flatness = 1e-3;

// An edge as the side of one face.
struct Side {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t face;
};

std::vector<Side> sidesOf(const Scene& scene) {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < scene.faces.size(); ++f)
        for (std::size_t k = 0; k < 3 && !scene.faces[f].isSolid; ++k) {
            const std::uint32_t a = scene.faces[f].particles[k], b = scene.faces[f].particles[(k + 1) % 3];
            sides.push_back({{std::min(a, b), std::max(a, b)}, f});
        }
    std::ranges::stable_sort(sides, {}, &Side::ends);
    return sides;
}

Vector at(const Scene& scene, std::uint32_t particle) {
    return toVector(scene.particles[particle].position);
}

Vector normalOf(const Scene& scene, const Face& face) {
    const Vector a = at(scene, face.particles[0]);
    return cross(minus(at(scene, face.particles[1]), a), minus(at(scene, face.particles[2]), a));
}

bool neverMoves(const Face& face, const std::vector<float>& inverseMass) {
    return std::ranges::none_of(face.particles, [&](std::uint32_t i) { return inverseMass[i] > 0; });
}

// Whether an edge lies in a static plane: contacts with it are contacts with the faces.
bool isFlat(const Scene& scene, std::span<const Side> sides, const std::vector<float>& inverseMass) {
    if (sides.size() != 2) return false;
    const Face &one = scene.faces[sides[0].face], &other = scene.faces[sides[1].face];
    if (!neverMoves(one, inverseMass) || !neverMoves(other, inverseMass)) return false;
    const Vector n = normalOf(scene, one), m = normalOf(scene, other), across = cross(n, m);
    const double lengths = dot(n, n) * dot(m, m);
    return lengths > 0 && dot(across, across) < flatness * flatness * lengths;
}

// The edges of one linked body, in cells so wide that partners are in neighbouring ones.
struct Placed {
    std::uint32_t body;
    std::array<std::int64_t, 3> cell; // z, y, x: rows of x are adjacent
    std::uint32_t edge;
    bool operator<(const Placed& other) const {
        return body != other.body ? body < other.body : cell < other.cell;
    }
};

double distance(const Scene& scene, const Edge& one, const Edge& other) {
    const Vector a = at(scene, one.ends[0]), b = at(scene, one.ends[1]), c = at(scene, other.ends[0]),
                 d = at(scene, other.ends[1]);
    double least = std::min({squaredToSegment(a, c, d), squaredToSegment(b, c, d), squaredToSegment(c, a, b),
                             squaredToSegment(d, a, b)});
    const Vector ab = minus(b, a), cd = minus(d, c), ca = minus(a, c), across = cross(ab, cd);
    const double squared = dot(across, across);
    if (squared > 1e-12 * dot(ab, ab) * dot(cd, cd)) {
        const double s = dot(cross(cd, ca), across) / squared, t = dot(cross(ab, ca), across) / squared;
        const double height = dot(across, ca);
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, height * height / squared);
    }
    return std::sqrt(least);
}

bool shareAnEnd(const Edge& one, const Edge& other) {
    return one.ends[0] == other.ends[0] || one.ends[0] == other.ends[1] || one.ends[1] == other.ends[0] ||
           one.ends[1] == other.ends[1];
}

std::vector<Placed> placed(const Scene& scene, std::span<const std::uint32_t> bodies,
                           std::span<const Edge> edges) {
    std::map<std::uint32_t, double> widths;
    for (const Edge& edge : edges) {
        double& width = widths[bodies[edge.ends[0]]];
        width = std::max(width, 2 * nearness * (double{edge.radius} + double{edge.thickness}));
    }
    std::vector<Placed> result;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const std::uint32_t body = bodies[edges[e].ends[0]];
        const Vector a = at(scene, edges[e].ends[0]), b = at(scene, edges[e].ends[1]);
        const double width = std::max(widths[body], 1e-30);
        const auto index = [&](std::size_t axis) {
            return static_cast<std::int64_t>(
                std::clamp(std::floor((a[axis] + b[axis]) / (2 * width)), -9e18, 9e18));
        };
        result.push_back({body, {index(2), index(1), index(0)}, e});
    }
    std::ranges::stable_sort(result, std::less<>());
    return result;
}

} // namespace

std::vector<Edge> edgesOf(const Scene& scene, const std::vector<float>& inverseMass) {
    const std::vector<Side> sides = sidesOf(scene);
    std::vector<Edge> edges;
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        const auto& ends = sides[first].ends;
        float thickness = scene.faces[sides[first].face].thickness;
        for (last = first; last < sides.size() && sides[last].ends == ends; ++last)
            thickness = std::min(thickness, scene.faces[sides[last].face].thickness);
        if (isFlat(scene, std::span(sides).subspan(first, last - first), inverseMass)) continue;
        const Vector d = minus(at(scene, ends[1]), at(scene, ends[0]));
        const bool moves = inverseMass[ends[0]] > 0 || inverseMass[ends[1]] > 0;
        const double half = (moves ? mostStretch : 1.0) * std::sqrt(dot(d, d)) / 2;
        edges.push_back({ends, thickness, static_cast<float>(half) + thickness, moves});
    }
    return edges;
}

std::vector<std::uint32_t> excludedEdges(const Scene& scene, std::span<const std::uint32_t> bodies,
                                         std::span<const Edge> edges) {
    const std::vector<Placed> places = placed(scene, bodies, edges);
    std::vector<std::vector<std::uint32_t>> partners(edges.size());
    for (const Placed& place : places)
        for (int row = 0; row < 9; ++row) {
            Placed first = place, last = place;
            for (Placed* end : {&first, &last}) {
                end->cell[0] += row / 3 - 1;
                end->cell[1] += row % 3 - 1;
            }
            --first.cell[2];
            ++last.cell[2];
            for (auto other = std::ranges::lower_bound(places, first, std::less<>());
                 other != places.end() && !(last < *other); ++other) {
                const Edge &one = edges[place.edge], &two = edges[other->edge];
                if (shareAnEnd(one, two) || (!one.moves && !two.moves)) continue;
                const double reach = nearness * (double{one.thickness} + double{two.thickness});
                if (distance(scene, one, two) < reach) partners[place.edge].push_back(other->edge);
            }
        }
    std::vector<std::uint32_t> result(edges.size() + 1);
    for (std::size_t e = 0; e <= edges.size(); ++e) {
        result[e] = static_cast<std::uint32_t>(result.size());
        if (e == edges.size()) break;
        std::ranges::sort(partners[e]);
        result.insert(result.end(), partners[e].begin(), partners[e].end());
    }
    return result;
}

} // namespace sinew::sim::collision::edge_contacts
