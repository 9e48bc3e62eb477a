// Written from the formulas, independently of the kernels.
#include "sim/reference/attached.hpp"

#include "sim/reference/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew::sim::reference {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double stiffnessOf(double compliance) {
    return compliance > 0 ? 1 / compliance : infinite;
}

// sum of n w |grad|^2 of a bend, n bends on each particle.
double bendSplit(const Problem& problem, const std::vector<std::uint32_t>& count, const Bend& bend) {
    const auto end = [&](std::uint32_t i) { return count[i] * problem.inverseMass[i]; };
    return end(bend.a) + 4 * end(bend.b) + end(bend.c);
}

double bendOmega(double omega, double theta) {
    return std::min(omega / 2, 0.9 * (4 / (1 + 2 * theta) - omega));
}

Eigen::Vector3d reachedAnchor(const Problem& problem, std::size_t a, double dt, const State& state) {
    if (a >= state.targets.size()) return state.anchors[a];
    const Eigen::Vector3d way = state.targets[a] - state.anchors[a];
    const double reach = problem.springs[a].maxSpeed * dt;
    return way.norm() <= reach ? state.targets[a]
                               : Eigen::Vector3d(state.anchors[a] + reach * way.normalized());
}

} // namespace

Eigen::Vector3d bendOf(const Bend& bend, const std::vector<Eigen::Vector3d>& x) {
    return x[bend.a] - 2 * x[bend.b] + x[bend.c];
}

void addBendForces(const Problem& problem, double omega, double theta, double h,
                   const std::vector<Eigen::Vector3d>& y, std::vector<Eigen::Vector3d>& force) {
    for (const Bend& bend : problem.bends) {
        const double most = bendOmega(omega, theta) / bendSplit(problem, problem.bendCount, bend) / (h * h);
        const Eigen::Vector3d pull = std::min(stiffnessOf(bend.compliance), most) * bendOf(bend, y);
        force[bend.a] -= pull;
        force[bend.b] += 2 * pull;
        force[bend.c] -= pull;
    }
}

double dampingShare(const Problem& problem, double mostOfLinks, double omega, double theta, double h) {
    double bends = 0; // h^2 k D, the largest
    for (const Bend& bend : problem.bends)
        bends = std::max(bends,
                         h * h * stiffnessOf(bend.compliance) * bendSplit(problem, problem.bendCount, bend));
    const double s = omega * std::min(h * h * mostOfLinks, 1.0) + std::min(bends, bendOmega(omega, theta));
    return std::max(0.0, 0.95 * (4 - s * (1 + 2 * theta)) / 2) / omega;
}

void pullAttached(const Problem& problem, double h, double dt, double fraction, State& state) {
    for (std::size_t a = 0; a < problem.springs.size(); ++a) {
        const Spring& spring = problem.springs[a];
        const double w = problem.inverseMass[spring.particle];
        if (w == 0) continue;
        const Eigen::Vector3d to = reachedAnchor(problem, a, dt, state);
        const Eigen::Vector3d point = state.anchors[a] + fraction * (to - state.anchors[a]);
        Eigen::Vector3d force = (point - state.x[spring.particle]) / (spring.compliance + h * h * w);
        if (force.norm() > spring.maxForce) force *= spring.maxForce / force.norm();
        state.x[spring.particle] += h * h * w * force;
    }
    for (const Rope& rope : problem.ropes) {
        if (problem.inverseMass[rope.particle] == 0) continue;
        const Eigen::Vector3d d = state.x[rope.particle] - state.x[rope.anchor];
        if (d.norm() > rope.length) state.x[rope.particle] += (rope.length / d.norm() - 1) * d;
    }
}

void settleAnchors(const Problem& problem, double dt, State& state) {
    for (std::size_t a = 0; a < problem.springs.size(); ++a)
        state.anchors[a] = reachedAnchor(problem, a, dt, state);
}

} // namespace sinew::sim::reference
