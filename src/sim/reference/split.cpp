// `split` in double: springs evaluated at y = x + theta h v, stiffness clamped by mass splitting, then kick
// and drift (methods: D, theta form). Constraint c has the share k~_c / sum k~ of each of its ends, k~_c =
// k_c / (1 + 2 w h^2 K_c), with K_c = k_c (in a grid, the stiffest of its rest length) and w the mean inverse
// mass; it is clamped to k~_c min(tau_i, tau_j), tau_i = omega / (2 w_i sum k~).
#include "sim/reference/attached.hpp"
#include "sim/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::reference {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// What shares and clamp of a scene come to: constant in time.
struct Split {
    std::vector<double> stiffness, share; // of each link: k and k~ [N/m]
    std::vector<double> clampTime;        // of each particle: tau [s^2]

    Split(const Problem& problem, double omega, double h) {
        double massSum = 0, moving = 0;
        for (const double w : problem.inverseMass) {
            massSum += w;
            moving += w > 0 ? 1 : 0;
        }
        const double softening = moving > 0 ? 2 * massSum / moving * h * h : 0;
        for (const Link& link : problem.links)
            stiffness.push_back(link.compliance > 0 ? std::min(1 / link.compliance, 1e20) : 1e20);
        std::vector<double> sums(problem.size(), 0);
        for (std::size_t c = 0; c < problem.links.size(); ++c) {
            share.push_back(stiffness[c] / (1 + softening * problem.links[c].level));
            sums[problem.links[c].a] += share[c];
            sums[problem.links[c].b] += share[c];
        }
        for (std::size_t i = 0; i < problem.size(); ++i)
            clampTime.push_back(problem.inverseMass[i] > 0 && sums[i] > 0
                                    ? omega / (2 * problem.inverseMass[i] * sums[i])
                                    : infinite);
    }

    // The largest k_c D_c / omega of the links, D_c at most omega / (k~_c min(tau)) [1/s^2].
    double most(const Problem& problem) const {
        double most = 0;
        for (std::size_t c = 0; c < problem.links.size(); ++c) {
            const Link& link = problem.links[c];
            const double clamp = share[c] * std::min(clampTime[link.a], clampTime[link.b]);
            most = std::max(most, link.compliance > 0 ? stiffness[c] / clamp : infinite);
        }
        return most;
    }
};

// Force on every particle [N] from its links, with their ends at y and moving with v, stiffness and damping
// clamped for kicks as long as h.
std::vector<Eigen::Vector3d> forces(const Problem& problem, const Split& split, double h, double dampingShare,
                                    const std::vector<Eigen::Vector3d>& y,
                                    const std::vector<Eigen::Vector3d>& v) {
    std::vector<Eigen::Vector3d> force(problem.size(), Eigen::Vector3d::Zero());
    for (std::size_t c = 0; c < problem.links.size(); ++c) {
        const Link& link = problem.links[c];
        const Eigen::Vector3d d = y[link.b] - y[link.a];
        const double length = d.norm();
        if (length == 0) continue; // no direction, no force
        const double clamp = split.share[c] * std::min(split.clampTime[link.a], split.clampTime[link.b]);
        Eigen::Vector3d pull =
            std::min(split.stiffness[c], clamp / (h * h)) * (length - link.restLength) / length * d;
        if (problem.dampingTime > 0) {
            const double coefficient =
                std::min(problem.dampingTime * split.stiffness[c], dampingShare * clamp / h);
            pull += coefficient * (v[link.b] - v[link.a]).dot(d) / (length * length) * d;
        }
        force[link.a] += pull;
        force[link.b] -= pull;
    }
    return force;
}

} // namespace

void stepSplit(const Scene& scene, const Settings& settings, double dt, State& state) {
    const Problem problem(scene);
    const double h = dt / settings.substeps, theta = double{settings.theta}, omega = double{settings.omega};
    const Split split(problem, omega, double{scene.dt} / settings.substeps); // shares do not follow dt
    const double kept = std::exp(-problem.damping * h);
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        // v comes from the middle of the substep before, which had this length.
        const double hBefore = substep == 0 ? state.previousH : h;
        std::vector<Eigen::Vector3d> y(state.x);
        for (std::size_t i = 0; i < problem.size(); ++i) y[i] += theta * hBefore * state.v[i];
        const double longest = std::max(hBefore, h);
        const double share =
            dampingShare(problem, split.most(problem), omega, theta, std::max(state.previousH, h));
        std::vector<Eigen::Vector3d> force = forces(problem, split, longest, share, y, state.v);
        addBendForces(problem, omega, theta, longest, y, force);
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
        if (problem.springs.empty() && problem.ropes.empty()) continue;
        const std::vector<Eigen::Vector3d> free = state.x;
        pullAttached(problem, h, dt, (substep + 1.0) / settings.substeps, state);
        for (std::size_t i = 0; i < problem.size(); ++i) state.v[i] += (state.x[i] - free[i]) / h;
    }
    settleAnchors(problem, dt, state);
    state.previousH = h;
}

} // namespace sinew::sim::reference
