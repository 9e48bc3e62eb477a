// Sums in double: a particle may have many constraints of very different stiffness.
#include "sim/stiffness/shares.hpp"

#include "sim/constraints/distance.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/stiffness/bearing.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <array>

namespace sinew::sim::stiffness {

namespace {

double meanInverseMass(std::span<const float> inverseMass) {
    double sum = 0;
    std::size_t moving = 0;
    for (const float w : inverseMass) {
        sum += double{w};
        moving += w > 0 ? 1 : 0;
    }
    return moving > 0 ? sum / static_cast<double>(moving) : 0;
}

// The kind of a link by its rest length: all links of a grid have one of its three.
std::size_t kindOf(const Grid& grid, const DistanceConstraint& link) {
    return link.restLength == grid.restLength[0] ? 0 : link.restLength == grid.restLength[1] ? 1 : 2;
}

// K_c: the stiffness at which the share of a constraint levels off.
std::vector<float> levelStiffness(const Scene& scene) {
    std::vector<float> levels;
    levels.reserve(scene.distances.size());
    for (const DistanceConstraint& c : scene.distances) levels.push_back(stiffnessOf(c.compliance));
    for (const Grid& grid : scene.grids) {
        std::array<float, 3> stiffest{};
        const std::size_t end = std::size_t{grid.firstDistance} + grid.distanceCount;
        for (std::size_t c = grid.firstDistance; c < end; ++c) {
            float& most = stiffest[kindOf(grid, scene.distances[c])];
            most = std::max(most, levels[c]);
        }
        for (std::size_t c = grid.firstDistance; c < end; ++c)
            levels[c] = stiffest[kindOf(grid, scene.distances[c])];
    }
    return levels;
}

// The coefficient that levels off stiffness that a substep cannot follow [m/N].
double softeningOf(const Scene& scene, const Settings& settings, std::span<const float> inverseMass) {
    const double h = double{scene.dt} / settings.substeps;
    return 2 * meanInverseMass(inverseMass) * h * h;
}

std::vector<float> shareStiffness(const Scene& scene, const Settings& settings,
                                  std::span<const float> inverseMass) {
    std::vector<float> shares = levelStiffness(scene);
    const double softening = softeningOf(scene, settings, inverseMass);
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& constraint = scene.distances[c];
        const bool moves = constraints::distance::canMove(constraint, inverseMass);
        const double ratio = moves ? 1 / (1 + softening * double{shares[c]}) : 0;
        shares[c] = static_cast<float>(double{stiffnessOf(constraint.compliance)} * ratio);
    }
    return shares;
}

// The clamp that the settings and the scene allow. Dampers take what the sum leaves of the stability bound
// (dampingBudget): links that a sharp clamp leaves stiffer would take it twice once their directions line up.
Clamp allowedClamp(const Scene& scene, const Settings& settings) {
    if (settings.solver != Solver::split) return Clamp::none;
    if (!settings.hasSharpClamp) return Clamp::sumAsked;
    if (settings.levels > 0) return Clamp::sumLevels;
    return scene.dampingTime > 0 ? Clamp::sumDamping : Clamp::sharp;
}

// The share of each corner of a full cell that its links take: a quarter of each of three edges, half of
// three face diagonals, a whole body diagonal.
double linksOfACorner(const Scene& scene, const Grid& grid, std::span<const float> shares) {
    constexpr double parts[3] = {0.75, 1.5, 1};
    double sum = 0;
    for (std::uint32_t kind = 0; kind < grid.kinds; ++kind)
        sum += parts[kind] * double{wholeShare(scene, grid, kind, shares)};
    return sum;
}

// The part of what meets in a particle that it bears in every direction: the largest eigenvalue of links is
// at least a third of their sum.
double dimensionsOf(const Scene& scene, const Settings& settings) {
    return allowedClamp(scene, settings) == Clamp::sharp ? 3 : 1;
}

// Stiffness of the volume of a full cell in its share's terms [N/m]: it meets its clamp with links of the
// same.
double volumeStiffness(const Grid& grid) {
    return 0.75 * double{grid.volumeStiffness} * double{grid.restLength[0]};
}

std::vector<CellShares> cellShares(const Scene& scene, const Settings& settings,
                                   std::span<const float> inverseMass, std::span<const float> shares) {
    const double softening = softeningOf(scene, settings, inverseMass);
    std::vector<CellShares> result(scene.grids.size());
    for (std::size_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        const double stiffness = volumeStiffness(grid);
        const double volume = stiffness / (1 + softening * stiffness);
        result[g].volume = static_cast<float>(volume);
        if (grid.recoveryPressure > 0)
            result[g].recovery = static_cast<float>(
                recoveryBudget(settings) *
                (linksOfACorner(scene, grid, shares) / dimensionsOf(scene, settings) + volume));
    }
    return result;
}

// Sums of shares at each particle [N/m], for any directions of links.
std::vector<double> sumsOf(const Scene& scene, std::span<const float> shares,
                           std::span<const CellShares> cells) {
    std::vector<double> sums(scene.particles.size(), 0);
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        sums[scene.distances[c].a] += double{shares[c]};
        sums[scene.distances[c].b] += double{shares[c]};
    }
    for (std::size_t g = 0; g < cells.size(); ++g) {
        if (cells[g].volume == 0) continue;
        lattice::forEachCell(scene.grids[g], [&](const lattice::Cell& cell) {
            for (const std::uint32_t corner : cell.corners)
                sums[corner] += double{cells[g].volume} * cell.fill;
        });
    }
    return sums;
}

// tau of every particle, with which 2 w tau times what meets in it is `most`.
std::vector<float> clampTimes(double most, std::span<const float> inverseMass, std::span<const double> sums) {
    constexpr float never = 1e30f; // [s^2]
    std::vector<float> times;
    times.reserve(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double bound = 2 * double{inverseMass[i]} * sums[i];
        times.push_back(bound > 0 ? static_cast<float>(std::min(most / bound, double{never})) : never);
    }
    return times;
}

// Whether a clamp is below what is asked by more than the rounding of shares, times and compliances to
// float32: a substep that is just short enough clamps nothing.
bool isBelow(double clamp, double asked) {
    constexpr double rounding = 1e-6;
    return clamp * (1 + rounding) < asked;
}

// Whether some link or cell at rest is softer in a substep than asked.
bool clamps(const Scene& scene, const Settings& settings, std::span<const float> inverseMass,
            const Shares& shares) {
    const double h = double{scene.dt} / settings.substeps;
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& link = scene.distances[c];
        if (!constraints::distance::canMove(link, inverseMass)) continue;
        const double most =
            double{shares.ofLinks[c]} * double{std::min(shares.times[link.a], shares.times[link.b])};
        if (isBelow(most, double{stiffnessOf(link.compliance)} * h * h)) return true;
    }
    for (std::size_t g = 0; g < scene.grids.size(); ++g) {
        const double stiffness = volumeStiffness(scene.grids[g]);
        if (stiffness == 0) continue;
        bool isSoft = false;
        lattice::forEachCell(scene.grids[g], [&](const lattice::Cell& cell) {
            float time = shares.times[cell.corners[0]];
            for (const std::uint32_t corner : cell.corners) time = std::min(time, shares.times[corner]);
            isSoft = isSoft || isBelow(double{shares.ofCells[g].volume} * double{time}, stiffness * h * h);
        });
        if (isSoft) return true;
    }
    return false;
}

} // namespace

float stiffnessOf(float compliance) {
    constexpr float stiffest = 1e20f; // [N/m]
    return compliance > 0 ? std::min(1 / compliance, stiffest) : stiffest;
}

float wholeShare(const Scene& scene, const Grid& grid, std::uint32_t kind, std::span<const float> shares) {
    const float stiffness = stiffnessOf(grid.compliance[kind]);
    for (std::uint32_t c = grid.firstDistance; c < grid.firstDistance + grid.distanceCount; ++c) {
        const DistanceConstraint& link = scene.distances[c];
        if (link.restLength == grid.restLength[kind] && shares[c] > 0)
            return shares[c] / stiffnessOf(link.compliance) * stiffness;
    }
    return stiffness; // no such link can move
}

double recoveryBudget(const Settings& settings) {
    return 0.9 * ranges::omegaBound(double{settings.theta}) / double{settings.omega} - 1;
}

double omegaOfBends(const Settings& settings) {
    const double left = ranges::omegaBound(double{settings.theta}) - double{settings.omega};
    return std::min(0.9 * left, double{settings.omega} / 2);
}

double mostOfLinks(const Scene& scene, const Settings& settings) {
    const double bends = scene.bends.empty() ? 0 : omegaOfBends(settings);
    return 0.95 * ranges::omegaBound(double{settings.theta}) - bends;
}

Shares sharesOf(const Scene& scene, const Settings& settings, std::span<const float> inverseMass) {
    Shares shares{.ofLinks = shareStiffness(scene, settings, inverseMass)};
    shares.ofCells = cellShares(scene, settings, inverseMass, shares.ofLinks);
    const double omega{settings.omega};
    shares.clamp = allowedClamp(scene, settings);
    if (!shares.isSharp()) {
        shares.times = clampTimes(omega, inverseMass, sumsOf(scene, shares.ofLinks, shares.ofCells));
        shares.startTimes = shares.times;
        return shares;
    }
    const Bearing bearing = bearingOf(scene, shares.ofLinks, shares.ofCells);
    shares.times = clampTimes(omega, inverseMass, bearing.atRest);
    shares.startTimes = clampTimes(mostOfLinks(scene, settings), inverseMass, bearing.atStart);
    std::ranges::transform(shares.startTimes, shares.times, shares.startTimes.begin(),
                           [](float start, float rest) { return std::min(start, rest); });
    return shares;
}

Shares sharesOfMotion(const Scene& scene, const Settings& settings, std::span<const float> inverseMass) {
    if (allowedClamp(scene, settings) == Clamp::sharp) {
        Settings withSum = settings;
        withSum.hasSharpClamp = false;
        Shares shares = sharesOf(scene, withSum, inverseMass);
        shares.clamp = Clamp::sumWhole;
        if (!clamps(scene, withSum, inverseMass, shares)) return shares;
    }
    return sharesOf(scene, settings, inverseMass);
}

} // namespace sinew::sim::stiffness
