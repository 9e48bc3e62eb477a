// `jacobi` in double: all corrections of an iteration from the same positions, then every particle takes its
// weighted sum (methods: D).
#include "sim/reference/reference.hpp"

#include <algorithm>

namespace sinew::sim::reference {

namespace {

// What a particle's summed corrections are multiplied with.
std::vector<double> weights(const Problem& problem, const Settings& settings) {
    std::vector<double> result(problem.size(), 0);
    for (std::size_t i = 0; i < problem.size(); ++i) {
        if (problem.linkCount[i] == 0) continue;
        const double weight = settings.weight > 0 ? double{settings.weight} : 1.0 / problem.linkCount[i];
        result[i] = double{settings.overRelaxation} * weight;
    }
    return result;
}

void iterate(const Problem& problem, const std::vector<double>& weight, double h,
             std::vector<double>& lambdas, State& state) {
    std::vector<Eigen::Vector3d> sum(problem.size(), Eigen::Vector3d::Zero());
    for (std::size_t c = 0; c < problem.links.size(); ++c) {
        const Link& link = problem.links[c];
        const double wA = problem.inverseMass[link.a], wB = problem.inverseMass[link.b];
        const double alpha = link.compliance / (h * h);
        const Eigen::Vector3d d = state.x[link.b] - state.x[link.a];
        const double length = d.norm();
        const double change = -(length - link.restLength + alpha * lambdas[c]) / (wA + wB + alpha);
        lambdas[c] += change * std::min(weight[link.a], weight[link.b]);
        if (length == 0) continue; // no direction, no correction
        sum[link.a] -= wA * change / length * d;
        sum[link.b] += wB * change / length * d;
    }
    for (std::size_t i = 0; i < problem.size(); ++i) state.x[i] += weight[i] * sum[i];
}

} // namespace

void stepJacobi(const Scene& scene, const Settings& settings, double dt, State& state) {
    const Problem problem(scene);
    const std::vector<double> weight = weights(problem, settings);
    const double h = dt / settings.substeps;
    const std::uint32_t iterations = problem.links.empty() ? 1 : settings.iterations;
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        HalfKickSubstep phases(problem, h, state);
        std::vector<double> lambdas(problem.links.size(), 0);
        for (std::uint32_t iteration = 0; iteration < iterations; ++iteration) {
            iterate(problem, weight, h, lambdas, state);
            phases.projectWalls();
        }
        phases.finish();
    }
    state.previousH = h;
}

} // namespace sinew::sim::reference
