#include "sim/stiffness/bearing.hpp"

#include "sim/collision/vectors.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/lattice/placement.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::stiffness {

namespace {

using collision::dot;
using collision::minus;
using collision::toVector;
using collision::Vector;

// Adds k (a n n^T + (1 - a) I) for n along d; k I if d is 0.
void add(Symmetric& sum, const Vector& d, double k, double a) {
    const double squared = dot(d, d);
    if (squared == 0) a = 0;
    const double along = squared > 0 ? k * a / squared : 0, across = k * (1 - a);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += along * d[i] * d[i] + across;
    sum[3] += along * d[0] * d[1];
    sum[4] += along * d[0] * d[2];
    sum[5] += along * d[1] * d[2];
}

// By particle: its grid and its place there, for links whose direction at rest the grid tells.
struct Places {
    static constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> grid;
    std::vector<std::array<std::uint32_t, 3>> at;

    explicit Places(const Scene& scene) : grid(scene.particles.size(), none), at(scene.particles.size()) {
        for (std::uint32_t g = 0; g < scene.grids.size(); ++g)
            for (std::size_t i = 0; i < scene.grids[g].node.size(); ++i) {
                grid[scene.grids[g].firstParticle + i] = g;
                at[scene.grids[g].firstParticle + i] =
                    lattice::coordinates(scene.grids[g], scene.grids[g].node[i]);
            }
    }

    Vector between(const Scene& scene, std::uint32_t a, std::uint32_t b) const {
        if (grid[a] == none || grid[a] != grid[b])
            return minus(toVector(scene.particles[b].position), toVector(scene.particles[a].position));
        Vector d{};
        for (std::size_t k = 0; k < 3; ++k)
            d[k] = static_cast<double>(at[b][k]) - static_cast<double>(at[a][k]);
        return d;
    }
};

} // namespace

double largestEigenvalue(const Symmetric& matrix) {
    const auto [xx, yy, zz, xy, xz, yz] = matrix;
    const double mean = (xx + yy + zz) / 3, x = xx - mean, y = yy - mean, z = zz - mean;
    const double p = std::sqrt((x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz)) / 6);
    const double determinant = x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz);
    const double r = p > 0 ? std::clamp(determinant / (2 * p * p * p), -1.0, 1.0) : 0;
    const double start = std::sqrt((2 + 2 * r) / 3);
    return mean + p * (1 + start - start * start / (6 + 3 * start));
}

Bearing bearingOf(const Scene& scene, std::span<const float> shares, std::span<const CellShares> cells) {
    const Places places(scene);
    std::vector<Symmetric> rest(scene.particles.size()), start(scene.particles.size());
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& link = scene.distances[c];
        const double k{shares[c]};
        if (k == 0) continue;
        const Vector atRest = places.between(scene, link.a, link.b);
        const Vector atStart =
            minus(toVector(scene.particles[link.b].position), toVector(scene.particles[link.a].position));
        const double length = std::sqrt(dot(atStart, atStart));
        const double along = length > double{link.restLength} ? double{link.restLength} / length : 1;
        for (const std::uint32_t end : {link.a, link.b}) {
            add(rest[end], atRest, k, 1);
            add(start[end], atStart, k, along);
        }
    }
    for (std::size_t g = 0; g < cells.size(); ++g) {
        if (cells[g].volume == 0 && cells[g].recovery == 0) continue;
        lattice::forEachCell(scene.grids[g], [&](const lattice::Cell& cell) {
            for (const std::uint32_t corner : cell.corners)
                for (std::size_t d = 0; d < 3; ++d) {
                    rest[corner][d] += double{cells[g].volume} * cell.fill;
                    start[corner][d] += (double{cells[g].volume} + double{cells[g].recovery}) * cell.fill;
                }
        });
    }
    Bearing bearing;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        bearing.atRest.push_back(largestEigenvalue(rest[i]));
        bearing.atStart.push_back(largestEigenvalue(start[i]));
    }
    return bearing;
}

} // namespace sinew::sim::stiffness
