// The slides' sequential version: every constraint in scene order, in place, each seeing what the one before
// it did. XPBD [Macklin 2016], eq. 18, with the multipliers reset every substep.
#include "sim/reference/attached.hpp"
#include "sim/reference/reference.hpp"

#include <algorithm>

namespace sinew::sim::reference {

GaussSeidel::GaussSeidel(const Scene& scene, const Settings& settings)
    : problem_(scene), substeps_(settings.substeps),
      iterations_(problem_.links.empty() && problem_.bends.empty() ? 1 : settings.iterations),
      bendMultipliers_(problem_.bends.size()) {
    requireNoCells(scene, "gauss_seidel");
    rows_.reserve(problem_.links.size());
    for (const Link& link : problem_.links) {
        rows_.push_back({.a = link.a,
                         .b = link.b,
                         .inverseMassA = problem_.inverseMass[link.a],
                         .inverseMassB = problem_.inverseMass[link.b],
                         .restLength = link.restLength});
    }
}

void GaussSeidel::step(double dt, State& state) {
    const double h = dt / substeps_;
    for (std::size_t c = 0; c < rows_.size(); ++c) {
        Row& row = rows_[c];
        row.alpha = problem_.links[c].compliance / (h * h);
        row.gamma = row.alpha > 0 ? problem_.dampingTime / h : 0; // XPBD, eq. 26
        row.inverseDenominator = 1 / ((1 + row.gamma) * (row.inverseMassA + row.inverseMassB) + row.alpha);
    }
    for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
        HalfKickSubstep phases(problem_, h, state);
        for (Row& row : rows_) row.lambda = 0;
        std::ranges::fill(bendMultipliers_, Eigen::Vector3d::Zero());
        for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
            if (problem_.dampingTime > 0)
                sweepDamped(phases.before(), state);
            else
                sweep(state);
            sweepBends(h, state);
            phases.projectWalls();
        }
        pullAttached(problem_, h, dt, (substep + 1.0) / substeps_, state);
        phases.finish();
    }
    settleAnchors(problem_, dt, state);
    state.previousH = h;
}

void GaussSeidel::sweep(State& state) {
    for (Row& row : rows_) {
        Eigen::Vector3d &a = state.x[row.a], &b = state.x[row.b];
        const Eigen::Vector3d d = b - a;
        const double length = d.norm();
        if (length == 0) continue; // no direction, no correction
        const double change = -(length - row.restLength + row.alpha * row.lambda) * row.inverseDenominator;
        row.lambda += change;
        const Eigen::Vector3d impulse = change / length * d;
        a -= row.inverseMassA * impulse;
        b += row.inverseMassB * impulse;
    }
}

void GaussSeidel::sweepDamped(const std::vector<Eigen::Vector3d>& before, State& state) {
    for (Row& row : rows_) {
        Eigen::Vector3d &a = state.x[row.a], &b = state.x[row.b];
        const Eigen::Vector3d d = b - a;
        const double length = d.norm();
        if (length == 0) continue; // no direction, no correction
        const double slip = row.gamma * (d - (before[row.b] - before[row.a])).dot(d) / length;
        const double change =
            -(length - row.restLength + row.alpha * row.lambda + slip) * row.inverseDenominator;
        row.lambda += change;
        const Eigen::Vector3d impulse = change / length * d;
        a -= row.inverseMassA * impulse;
        b += row.inverseMassB * impulse;
    }
}

void GaussSeidel::sweepBends(double h, State& state) {
    for (std::size_t c = 0; c < problem_.bends.size(); ++c) {
        const Bend& bend = problem_.bends[c];
        const double wA = problem_.inverseMass[bend.a], wB = problem_.inverseMass[bend.b],
                     wC = problem_.inverseMass[bend.c], alpha = bend.compliance / (h * h);
        const Eigen::Vector3d change =
            -(bendOf(bend, state.x) + alpha * bendMultipliers_[c]) / (wA + 4 * wB + wC + alpha);
        bendMultipliers_[c] += change;
        state.x[bend.a] += wA * change;
        state.x[bend.b] -= 2 * wB * change;
        state.x[bend.c] += wC * change;
    }
}

void stepGaussSeidel(const Scene& scene, const Settings& settings, double dt, State& state) {
    GaussSeidel(scene, settings).step(dt, state);
}

} // namespace sinew::sim::reference
