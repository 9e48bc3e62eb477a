// `split` in double: springs evaluated at y = x + theta h v, stiffness clamped by mass splitting with uniform
// shares, then kick and drift (methods: D, theta form; the clamp min(k h^2, omega / (2 n_i w_i), omega / (2
// n_j w_j))).
#include "sim/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::reference {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The largest k h^2 of a link that its end `particle` allows [kg].
double clampOf(const Problem& problem, double omega, std::uint32_t particle) {
    const double w = problem.inverseMass[particle];
    return w > 0 ? omega / (2 * problem.linkCount[particle] * w) : infinite;
}

// Force on every particle [N] from its links, with their ends at y, clamped for kicks as long as h.
std::vector<Eigen::Vector3d> forces(const Problem& problem, double omega, double h,
                                    const std::vector<Eigen::Vector3d>& y) {
    std::vector<Eigen::Vector3d> force(problem.size(), Eigen::Vector3d::Zero());
    for (const Link& link : problem.links) {
        const Eigen::Vector3d d = y[link.b] - y[link.a];
        const double length = d.norm();
        if (length == 0) continue; // no direction, no force
        const double stiffness = link.compliance > 0 ? 1 / link.compliance : infinite;
        const double clamp = std::min(clampOf(problem, omega, link.a), clampOf(problem, omega, link.b));
        const Eigen::Vector3d pull =
            std::min(stiffness, clamp / (h * h)) * (length - link.restLength) / length * d;
        force[link.a] += pull;
        force[link.b] -= pull;
    }
    return force;
}

} // namespace

void stepSplit(const Scene& scene, const Settings& settings, double dt, State& state) {
    const Problem problem(scene);
    const double h = dt / settings.substeps, theta = double{settings.theta}, omega = double{settings.omega};
    const double kept = std::exp(-problem.damping * h);
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        // v comes from the middle of the substep before, which had this length.
        const double hBefore = substep == 0 ? state.previousH : h;
        std::vector<Eigen::Vector3d> y(state.x);
        for (std::size_t i = 0; i < problem.size(); ++i) y[i] += theta * hBefore * state.v[i];
        const std::vector<Eigen::Vector3d> force = forces(problem, omega, std::max(hBefore, h), y);
        for (std::size_t i = 0; i < problem.size(); ++i) {
            const double w = problem.inverseMass[i];
            if (w == 0) continue;
            const Eigen::Vector3d xBefore = state.x[i], vBefore = state.v[i];
            state.v[i] = kept * (vBefore + (hBefore + h) / 2 * (problem.gravity + w * force[i]));
            state.x[i] += h * state.v[i];
            const Eigen::Vector3d xFree = state.x[i];
            const Touched touched = projectOntoWalls(problem, i, xBefore, state.x[i]);
            state.v[i] += (state.x[i] - xFree) / h;
            rebound(problem, touched, h, vBefore, state.v[i]);
        }
    }
    state.previousH = h;
}

} // namespace sinew::sim::reference
