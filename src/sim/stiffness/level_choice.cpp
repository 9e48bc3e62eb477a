#include "sim/stiffness/level_choice.hpp"

#include "sim/core/complaints.hpp"
#include "sinew/ranges.hpp"

#include <array>

namespace sinew::sim::stiffness {

namespace {

constexpr double leastLack = 1.8, lackOfLevel = 2.2; // see the header
constexpr double leastBesideSharp = 3.2;             // of a solid that has the sharp clamp without levels
// Factors on r, so that the number of levels is its logarithm.
constexpr double ofSheet = 1.1, ofSolid = 1.9;
// Blocks along the longest axis: of level 1, without which a body is too small for levels to win, and of the
// coarsest level.
constexpr std::uint32_t fewestBlocks = 5, coarsestOfSheet = 5, coarsestOfSolid = 3;

constexpr std::size_t mostLevels = static_cast<std::size_t>(ranges::levels.high);

std::uint32_t halved(std::uint32_t nodes) {
    return (nodes + 1) / 2;
}

// The factor r of a body: root mean square over its elastic links, as few stiff ones decide nothing.
double lackOf(const Terms& terms, const Grid& grid) {
    const double h = double{terms.scene.dt} / terms.settings.substeps;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = grid.firstDistance; i < std::size_t{grid.firstDistance} + grid.distanceCount; ++i) {
        const DistanceConstraint& c = terms.scene.distances[i];
        if (c.compliance == 0 || !canMove(terms.load, {c.a, c.b})) continue;
        sum += h * h / (double{c.compliance} * clampOfLink(terms.shares, terms.scene, i));
        ++count;
    }
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
}

// The smallest r with which levels beat what the scene has without them.
double leastLackOf(const Settings& settings, const Grid& grid) {
    return settings.hasSharpClamp && !lattice::isSheet(grid) ? leastBesideSharp : leastLack;
}

std::uint32_t levelsFor(const Terms& terms, const Grid& grid) {
    const double lack = lackOf(terms, grid);
    std::uint32_t blocks = halved(std::ranges::max(grid.nodes));
    if (lack < leastLackOf(terms.settings, grid) || blocks < fewestBlocks) return 0;
    const double most = std::log((lattice::isSheet(grid) ? ofSheet : ofSolid) * lack) / std::log(lackOfLevel);
    const std::uint32_t coarsest = lattice::isSheet(grid) ? coarsestOfSheet : coarsestOfSolid;
    std::uint32_t levels = 1;
    while (levels + 1 <= most && levels < mostLevels && halved(blocks) >= coarsest) {
        blocks = halved(blocks);
        ++levels;
    }
    return levels;
}

} // namespace

std::vector<std::string> obstaclesToLevels(const Scene& scene, const Settings& settings) {
    std::vector<std::string> obstacles;
    const double most = mostOmegaOfLevels * ranges::omegaBound(double{settings.theta});
    if (double{settings.omega} >= most)
        obstacles.push_back("levels are stable only with an omega below " + number(static_cast<float>(most)));
    if (scene.dampingTime > 0)
        obstacles.emplace_back("levels have no internal damping: use levels 0, or a dampingTime of 0");
    if (settings.keepsForces)
        obstacles.emplace_back(
            "impulses of levels on fixed particles are not kept: use levels 0, or keep no forces");
    return obstacles;
}

std::uint32_t levelsFor(const Scene& scene, const Settings& settings, const Load& load) {
    if (settings.solver != Solver::split || !obstaclesToLevels(scene, settings).empty()) return 0;
    const Terms terms{scene, settings, load};
    std::array<std::size_t, mostLevels + 1> particles{}; // by the number of levels of their body
    for (const Grid& grid : scene.grids) particles[levelsFor(terms, grid)] += grid.node.size();
    return static_cast<std::uint32_t>(std::ranges::max_element(particles) - particles.begin());
}

} // namespace sinew::sim::stiffness
