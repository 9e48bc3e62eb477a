// The slides' sequential version: every constraint in scene order, in place, each seeing what the one before
// it did. XPBD [Macklin 2016], eq. 18, with the multipliers reset every substep.
#include "sim/reference/reference.hpp"

namespace sinew::sim::reference {

GaussSeidel::GaussSeidel(const Scene& scene, const Settings& settings)
    : problem_(scene), substeps_(settings.substeps),
      iterations_(problem_.links.empty() ? 1 : settings.iterations) {
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
        row.inverseDenominator = 1 / (row.inverseMassA + row.inverseMassB + row.alpha);
    }
    for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
        HalfKickSubstep phases(problem_, h, state);
        for (Row& row : rows_) row.lambda = 0;
        for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
            sweep(state);
            phases.projectWalls();
        }
        phases.finish();
    }
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

void stepGaussSeidel(const Scene& scene, const Settings& settings, double dt, State& state) {
    GaussSeidel(scene, settings).step(dt, state);
}

} // namespace sinew::sim::reference
