// The table of shapes, and the shapes with a parametric form.
#include "mesh/generate.hpp"

#include "mesh/implicit_shapes.hpp"
#include "mesh/surface_nets.hpp"
#include "mesh/vector3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace sinew::mesh {
namespace {

constexpr double tau = 2 * std::numbers::pi;

TriangleMesh makeOrgan(std::uint32_t resolution) {
    return isosurface(organDistance, {Vector3(-0.18, -0.13, -0.13), Vector3(0.2, 0.12, 0.13)},
                      0.3 / resolution);
}

TriangleMesh makeSlab(std::uint32_t resolution) {
    const double spacing = 0.3 / resolution;
    const Vector3 half = Vector3(0.15, 0.03, 0.1) + Vector3::Constant(2 * spacing);
    return isosurface(slabDistance, {-half, half}, spacing);
}

/// A geodesic sphere of radius 0.15 m: each face of an octahedron split into n^2 triangles. Vertices on the
/// sphere.
TriangleMesh makeSphere(std::uint32_t resolution) {
    const auto n = static_cast<std::int32_t>(std::max(resolution / 2, 1u));
    TriangleMesh mesh;
    std::map<std::array<std::int32_t, 3>, std::uint32_t>
        numbers; // by octahedron coordinates, |x| + |y| + |z| = n
    const auto vertexAt = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        const auto [entry, isNew] =
            numbers.try_emplace({x, y, z}, static_cast<std::uint32_t>(mesh.positions.size()));
        if (isNew) {
            // Equal angles along the octahedron's edges make triangles of nearly equal size.
            const auto bent = [n](std::int32_t c) { return std::sin(tau / 4 * c / n); };
            mesh.positions.push_back(toVec3(0.15 * Vector3(bent(x), bent(y), bent(z)).normalized()));
        }
        return entry->second;
    };
    for (unsigned octant = 0; octant < 8; ++octant) {
        const std::array<std::int32_t, 3> sign{(octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1,
                                               (octant & 4) != 0 ? -1 : 1};
        const bool isMirrored = sign[0] * sign[1] * sign[2] < 0;
        const auto add = [&](std::array<std::int32_t, 2> a, std::array<std::int32_t, 2> b,
                             std::array<std::int32_t, 2> c) {
            const auto at = [&](std::array<std::int32_t, 2> p) {
                return vertexAt(sign[0] * p[0], sign[1] * p[1], sign[2] * (n - p[0] - p[1]));
            };
            if (isMirrored) std::swap(b, c);
            mesh.triangles.push_back({at(a), at(b), at(c)});
        };
        for (std::int32_t j = 0; j < n; ++j)
            for (std::int32_t i = 0; i + j < n; ++i) {
                add({i, j}, {i + 1, j}, {i, j + 1});
                if (i + j + 1 < n) add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
            }
    }
    return mesh;
}

/// Adds the triangles of a closed net of `along` rings, each of `around` consecutive points.
void addRings(TriangleMesh& mesh, std::uint32_t along, std::uint32_t around) {
    for (std::uint32_t i = 0; i < along; ++i)
        for (std::uint32_t j = 0; j < around; ++j) {
            const std::uint32_t next = (i + 1) % along, up = (j + 1) % around;
            const std::uint32_t a = i * around + j, b = i * around + up, c = next * around + up,
                                d = next * around + j;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
}

/// The centre line of a (2, 3) torus knot.
Vector3 knotAt(double t) {
    const double radius = 0.09 * (1 + 0.45 * std::cos(3 * t));
    return {radius * std::cos(2 * t), 0.09 * 0.55 * std::sin(3 * t), radius * std::sin(2 * t)};
}

TriangleMesh makeTorusKnot(std::uint32_t resolution) {
    constexpr double tube = 0.026;
    const std::uint32_t around = std::max(resolution / 3, 6u), along = 6 * resolution;
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < along; ++i) {
        const double t = tau * i / along, step = tau * 1e-4;
        const Vector3 center = knotAt(t), tangent = (knotAt(t + step) - knotAt(t - step)).normalized();
        // The direction away from the axis of the torus never runs along the knot and closes without a twist.
        const Vector3 ring = 0.09 * Vector3(std::cos(2 * t), 0, std::sin(2 * t));
        const Vector3 normal = (center - ring - (center - ring).dot(tangent) * tangent).normalized();
        const Vector3 binormal = tangent.cross(normal);
        for (std::uint32_t j = 0; j < around; ++j) {
            const double angle = tau * j / around;
            mesh.positions.push_back(
                toVec3(center + tube * (std::cos(angle) * normal + std::sin(angle) * binormal)));
        }
    }
    addRings(mesh, along, around);
    return mesh;
}

/// The wall of a tube along x, cut lengthwise: two straight sides and two half circles, (x, distance from the
/// axis), in the order outer side, rim, inner side, rim.
std::vector<std::array<double, 2>> tubeProfile(std::uint32_t resolution) {
    constexpr double outer = 0.06, inner = 0.032, rim = (outer - inner) / 2, reach = 0.15 - rim;
    const auto count = [resolution](double length) {
        return static_cast<std::uint32_t>(std::max(std::lround(length / 0.3 * resolution), 3l));
    };
    const std::uint32_t along = count(2 * reach), round = count(std::numbers::pi * rim);
    std::vector<std::array<double, 2>> profile;
    for (const double end : {1.0, -1.0}) { // the side that leads to this end, and the rim there
        const double side = end > 0 ? outer : inner;
        for (std::uint32_t i = 0; i < along; ++i)
            profile.push_back({end * reach * (2.0 * i / along - 1), side});
        for (std::uint32_t i = 0; i < round; ++i) {
            const double angle = std::numbers::pi * i / round;
            profile.push_back(
                {end * (reach + rim * std::sin(angle)), (outer + inner) / 2 + end * rim * std::cos(angle)});
        }
    }
    return profile;
}

TriangleMesh makeTube(std::uint32_t resolution) {
    const auto profile = tubeProfile(resolution);
    const auto rows = static_cast<std::uint32_t>(profile.size()), around = std::max(resolution, 8u);
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < around; ++j) {
            const double angle = tau * j / around;
            mesh.positions.push_back(toVec3(
                Vector3(profile[i][0], profile[i][1] * std::cos(angle), profile[i][1] * std::sin(angle))));
        }
    addRings(mesh, rows, around);
    return mesh;
}

/// An open square of 1 m in the plane y = 0, facing up.
TriangleMesh makeCloth(std::uint32_t resolution) {
    TriangleMesh mesh;
    for (std::uint32_t row = 0; row <= resolution; ++row)
        for (std::uint32_t column = 0; column <= resolution; ++column) {
            mesh.positions.push_back(toVec3(Vector3(column, 0, row) / resolution - Vector3(0.5, 0, 0.5)));
            if (row == resolution || column == resolution) continue;
            const std::uint32_t a = column + (resolution + 1) * row, b = a + 1, c = a + resolution + 1,
                                d = c + 1;
            mesh.triangles.push_back({a, c, d});
            mesh.triangles.push_back({a, d, b});
        }
    return mesh;
}

using Maker = TriangleMesh (*)(std::uint32_t resolution);

constexpr std::array<Shape, 6> table{
    {{"organ", "a liver: smooth lobes, a notch, a hollow underside; 0.3 m"},
     {"torus_knot", "a tube along a (2, 3) torus knot; 0.3 m"},
     {"slab_with_hole", "a rounded slab, 0.3 x 0.06 x 0.2 m, with a hole through it"},
     {"sphere", "a geodesic sphere of radius 0.15 m"},
     {"tube", "a hollow tube along x with round rims, 0.3 m long, 0.06 and 0.032 m in radius"},
     {"cloth", "a flat square sheet of 1 m, open"}}};
constexpr std::array<Maker, table.size()> makers{makeOrgan,  makeTorusKnot, makeSlab,
                                                 makeSphere, makeTube,      makeCloth};

} // namespace

std::span<const Shape> shapes() {
    return table;
}

TriangleMesh generate(std::string_view name, std::uint32_t resolution) {
    if (resolution < 8 || resolution > 256)
        throw std::invalid_argument("generate: resolution " + std::to_string(resolution) +
                                    " is not within 8 to 256");
    const auto shape = std::ranges::find(table, name, &Shape::name);
    if (shape == table.end())
        throw std::invalid_argument("generate: no shape is called \"" + std::string(name) + "\"");
    TriangleMesh mesh = makers[static_cast<std::size_t>(shape - table.begin())](resolution);
    mesh.name = name;
    return mesh;
}

} // namespace sinew::mesh
