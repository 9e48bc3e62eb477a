// The surface of a voxel body as faces that others touch.
#include "sim/lattice/placement.hpp"
#include "sim/lattice/squares.hpp"
#include "sinew/bodies.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim {

namespace {

using Node = std::array<std::uint32_t, 3>;

constexpr double mostStretch = 1.2; // of a surface that must stay impassable

// The squares between four neighbouring particles of a grid.
class SquareList {
public:
    explicit SquareList(const Grid& grid) : grid_(grid) {
        particle_.resize(std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2]);
        for (std::uint32_t i = 0; i < grid.node.size(); ++i) particle_[grid.node[i]] = grid.firstParticle + i;
    }

    // Appends the two triangles of every such square whose lowest corner is `low`.
    void addTo(std::vector<Face>& faces, const Node& low, float thickness, lattice::Squares squares) const {
        const std::uint32_t fill = lattice::fillAround(grid_, low);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            const bool isAbove = (fill >> 28 & 15) > 0;
            const bool isBelow = (fill >> (4 * (7 ^ 1u << axis)) & 15) > 0;
            if (squares == lattice::Squares::outer ? isAbove == isBelow : !isAbove || !isBelow) continue;
            Node alongU = low, alongV = low, high = low;
            ++alongU[u], ++alongV[v], ++high[u], ++high[v];
            // u x v is the axis: counter-clockwise seen from its positive side
            const std::uint32_t a = at(low), b = at(alongU), c = at(high), d = at(alongV);
            faces.push_back({isBelow ? std::array{a, b, c} : std::array{a, c, b}, thickness, true});
            faces.push_back({isBelow ? std::array{a, c, d} : std::array{a, d, c}, thickness, true});
        }
    }

private:
    std::uint32_t at(const Node& node) const {
        return particle_[node[0] + grid_.nodes[0] * (node[1] + std::size_t{grid_.nodes[1]} * node[2])];
    }

    const Grid& grid_;
    std::vector<std::uint32_t> particle_;
};

// By grid the smallest radius of moving particles outside this grid [m].
std::vector<double> leastBeside(const Scene& scene) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const std::vector<float> inverseMass = inverseMasses(scene);
    const auto others = static_cast<std::uint32_t>(scene.grids.size()); // index if in no grid
    std::vector<std::uint32_t> gridOf(scene.particles.size(), others);
    for (std::uint32_t g = 0; g < others; ++g)
        std::fill_n(gridOf.begin() + scene.grids[g].firstParticle, scene.grids[g].node.size(), g);
    std::vector<double> least(others + 1, none);
    for (std::size_t i = 0; i < gridOf.size(); ++i)
        if (scene.particles[i].radius > 0 && inverseMass[i] > 0)
            least[gridOf[i]] = std::min(least[gridOf[i]], double{scene.particles[i].radius});
    const auto smallest = static_cast<std::size_t>(std::ranges::min_element(least) - least.begin());
    double second = none;
    for (std::size_t g = 0; g < least.size(); ++g)
        if (g != smallest) second = std::min(second, least[g]);
    std::vector<double> beside(others, least[smallest]);
    if (smallest < others) beside[smallest] = second;
    return beside;
}

} // namespace

void lattice::appendSquares(std::vector<Face>& faces, const Grid& grid, float thickness, Squares squares) {
    const SquareList list(grid);
    for (const std::uint32_t node : grid.node) list.addTo(faces, coordinates(grid, node), thickness, squares);
}

void addSurfaceFaces(Scene& scene, const Grid& grid) {
    lattice::appendSquares(scene.faces, grid, scene.particles[grid.firstParticle].radius,
                           lattice::Squares::outer);
}

std::vector<std::uint32_t> gridsWithHoles(const Scene& scene) {
    const std::vector<double> least = leastBeside(scene);
    std::vector<std::uint32_t> result;
    for (std::uint32_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        const double radius = double{scene.particles[grid.firstParticle].radius};
        if (lattice::isSheet(grid) || radius <= 0) continue;
        // the middle of a square is half a diagonal away from its corners
        if (least[g] < mostStretch * std::sqrt(0.5) * double{grid.restLength[0]} - radius)
            result.push_back(g);
    }
    return result;
}

} // namespace sinew::sim
