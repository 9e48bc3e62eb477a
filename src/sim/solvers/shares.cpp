// Sums in double: a particle may have many constraints of very different stiffness.
#include "sim/solvers/shares.hpp"

#include "sim/constraints/distance.hpp"

#include <algorithm>
#include <unordered_map>

namespace sinew::sim::solvers {

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

// K_c: at which stiffness the share of a constraint levels off.
std::vector<double> levelStiffness(const Scene& scene) {
    std::vector<double> levels;
    levels.reserve(scene.distances.size());
    for (const DistanceConstraint& c : scene.distances) levels.push_back(double{stiffnessOf(c.compliance)});
    for (const Grid& grid : scene.grids) {
        std::unordered_map<float, double> stiffest; // by rest length
        const std::size_t end = std::size_t{grid.firstDistance} + grid.distanceCount;
        for (std::size_t c = grid.firstDistance; c < end; ++c) {
            double& most = stiffest[scene.distances[c].restLength];
            most = std::max(most, levels[c]);
        }
        for (std::size_t c = grid.firstDistance; c < end; ++c)
            levels[c] = stiffest.at(scene.distances[c].restLength);
    }
    return levels;
}

} // namespace

float stiffnessOf(float compliance) {
    constexpr float stiffest = 1e20f; // [N/m]
    return compliance > 0 ? std::min(1 / compliance, stiffest) : stiffest;
}

std::vector<float> shareStiffness(const Scene& scene, const Settings& settings,
                                  std::span<const float> inverseMass) {
    const std::vector<double> levels = levelStiffness(scene);
    const double h = double{scene.dt} / settings.substeps;
    const double softening = 2 * meanInverseMass(inverseMass) * h * h;
    std::vector<float> shares;
    shares.reserve(scene.distances.size());
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& constraint = scene.distances[c];
        const bool moves = constraints::distance::canMove(constraint, inverseMass);
        const double ratio = moves ? 1 / (1 + softening * levels[c]) : 0;
        shares.push_back(static_cast<float>(double{stiffnessOf(constraint.compliance)} * ratio));
    }
    return shares;
}

std::vector<float> clampTimes(const Scene& scene, const Settings& settings,
                              std::span<const float> inverseMass, std::span<const float> shares) {
    constexpr float never = 1e30f; // [s^2]
    std::vector<double> sums(inverseMass.size(), 0);
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        sums[scene.distances[c].a] += double{shares[c]};
        sums[scene.distances[c].b] += double{shares[c]};
    }
    std::vector<float> times;
    times.reserve(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double bound = 2 * double{inverseMass[i]} * sums[i];
        times.push_back(
            bound > 0 ? static_cast<float>(std::min(double{settings.omega} / bound, double{never})) : never);
    }
    return times;
}

} // namespace sinew::sim::solvers
