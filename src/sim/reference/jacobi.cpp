// `jacobi` in double: all corrections of an iteration start from the same positions, then every particle
// applies its weighted sum.
#include "sim/reference/attached.hpp"
#include "sim/reference/reference.hpp"

#include <algorithm>

namespace sinew::sim::reference {

namespace {

// The factor of a particle's summed corrections.
std::vector<double> weights(const Problem& problem, const Settings& settings) {
    std::vector<double> result(problem.size(), 0);
    for (std::size_t i = 0; i < problem.size(); ++i) {
        const std::uint32_t count = problem.linkCount[i] + problem.bendCount[i];
        if (count == 0) continue;
        const double weight = settings.weight > 0 ? double{settings.weight} : 1.0 / count;
        result[i] = double{settings.overRelaxation} * weight;
    }
    return result;
}

struct Multipliers {
    std::vector<double> links;
    std::vector<Eigen::Vector3d> bends;
};

void addBends(const Problem& problem, const std::vector<double>& weight, double h, Multipliers& multipliers,
              const State& state, std::vector<Eigen::Vector3d>& sum) {
    for (std::size_t c = 0; c < problem.bends.size(); ++c) {
        const Bend& bend = problem.bends[c];
        const double wA = problem.inverseMass[bend.a], wB = problem.inverseMass[bend.b],
                     wC = problem.inverseMass[bend.c], alpha = bend.compliance / (h * h);
        const Eigen::Vector3d change =
            -(bendOf(bend, state.x) + alpha * multipliers.bends[c]) / (wA + 4 * wB + wC + alpha);
        multipliers.bends[c] += std::min({weight[bend.a], weight[bend.b], weight[bend.c]}) * change;
        sum[bend.a] += wA * change;
        sum[bend.b] -= 2 * wB * change;
        sum[bend.c] += wC * change;
    }
}

void iterate(const Problem& problem, const std::vector<double>& weight, double h,
             const std::vector<Eigen::Vector3d>& before, Multipliers& multipliers, State& state) {
    std::vector<Eigen::Vector3d> sum(problem.size(), Eigen::Vector3d::Zero());
    for (std::size_t c = 0; c < problem.links.size(); ++c) {
        const Link& link = problem.links[c];
        const double wA = problem.inverseMass[link.a], wB = problem.inverseMass[link.b];
        const double alpha = link.compliance / (h * h);
        const Eigen::Vector3d d = state.x[link.b] - state.x[link.a];
        const double length = d.norm();
        double& lambda = multipliers.links[c];
        // XPBD, eq. 26, with the damping coefficient dampingTime / compliance
        const double gamma = link.compliance > 0 && length > 0 ? problem.dampingTime / h : 0;
        const Eigen::Vector3d moved = d - (before[link.b] - before[link.a]);
        const double slip = gamma > 0 ? gamma * moved.dot(d) / length : 0;
        const double change =
            -(length - link.restLength + alpha * lambda + slip) / ((1 + gamma) * (wA + wB) + alpha);
        lambda += change * std::min(weight[link.a], weight[link.b]);
        if (length == 0) continue; // no direction, no correction
        sum[link.a] -= wA * change / length * d;
        sum[link.b] += wB * change / length * d;
    }
    addBends(problem, weight, h, multipliers, state, sum);
    for (std::size_t i = 0; i < problem.size(); ++i) state.x[i] += weight[i] * sum[i];
}

} // namespace

void stepJacobi(const Scene& scene, const Settings& settings, double dt, State& state) {
    requireNoCells(scene, "jacobi");
    const Problem problem(scene);
    const std::vector<double> weight = weights(problem, settings);
    const double h = dt / settings.substeps;
    const bool hasConstraints = !problem.links.empty() || !problem.bends.empty();
    const std::uint32_t iterations = hasConstraints ? settings.iterations : 1;
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        HalfKickSubstep phases(problem, h, state);
        const std::vector<Eigen::Vector3d>& before = phases.before();
        Multipliers multipliers{std::vector<double>(problem.links.size(), 0),
                                std::vector<Eigen::Vector3d>(problem.bends.size(), Eigen::Vector3d::Zero())};
        for (std::uint32_t iteration = 0; iteration < iterations; ++iteration) {
            iterate(problem, weight, h, before, multipliers, state);
            phases.projectWalls();
        }
        pullAttached(problem, h, dt, (substep + 1.0) / settings.substeps, state);
        phases.finish();
    }
    settleAnchors(problem, dt, state);
    state.previousH = h;
}

} // namespace sinew::sim::reference
