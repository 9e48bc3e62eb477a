// Sequential constraint solving in place: each constraint sees the corrections of those before it. XPBD
// [Macklin 2016], eq. 18. Cold and in scene order it is the classic sequential version; in the order of the
// colors and with a warm start it is the method of `gauss_seidel` on the device.
#include "sim/reference/attached.hpp"
#include "sim/reference/reference.hpp"

#include <algorithm>

namespace sinew::sim::reference {

namespace {

// The items in the order of their indices in the scene; unchanged if `order` is empty.
template <typename Item>
std::vector<Item> sorted(std::vector<Item> items, std::span<const std::uint32_t> order, std::size_t count) {
    if (order.empty()) return items;
    std::vector<Item> result, byConstraint(count);
    for (const Item& item : items) byConstraint[item.constraint] = item;
    for (const std::uint32_t constraint : order) result.push_back(byConstraint[constraint]);
    return result;
}

} // namespace

GaussSeidel::GaussSeidel(const Scene& scene, const Settings& settings, std::span<const std::uint32_t> order,
                         std::span<const std::uint32_t> bendOrder)
    : problem_(scene), substeps_(settings.substeps),
      iterations_(problem_.links.empty() && problem_.bends.empty() ? 1 : settings.iterations),
      warmStart_(double{settings.warmStart}), bendMultipliers_(problem_.bends.size()) {
    requireNoCells(scene, "gauss_seidel");
    problem_.bends = sorted(problem_.bends, bendOrder, scene.bends.size());
    std::vector<std::uint32_t> linkOf(scene.distances.size());
    for (std::uint32_t index = 0; index < problem_.links.size(); ++index)
        linkOf[problem_.links[index].constraint] = index;
    rows_.reserve(problem_.links.size());
    if (warmStart_ > 0) directions_.assign(problem_.links.size(), Eigen::Vector3d::Zero());
    for (std::size_t entry = 0; entry < problem_.links.size(); ++entry) {
        const auto index = order.empty() ? static_cast<std::uint32_t>(entry) : linkOf[order[entry]];
        const Link& link = problem_.links[index];
        rows_.push_back({.a = link.a,
                         .b = link.b,
                         .inverseMassA = problem_.inverseMass[link.a],
                         .inverseMassB = problem_.inverseMass[link.b],
                         .restLength = link.restLength});
        linkOfRow_.push_back(index);
    }
}

void GaussSeidel::step(double dt, State& state) {
    const double h = dt / substeps_;
    beginStep(h, state);
    for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
        HalfKickSubstep phases(problem_, h, state);
        if (warmStart_ > 0) startWarm(state);
        std::ranges::fill(bendMultipliers_, Eigen::Vector3d::Zero());
        for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
            sweep(state);
            sweepBends(h, state);
            if (iteration + 1 == iterations_) // walls come last
                pullAttached(problem_, h, dt, (substep + 1.0) / substeps_, state);
            phases.projectWalls();
        }
        phases.finish();
        if (problem_.dampingTime > 0) damp(h, state);
        keepMultipliers();
    }
    if (warmStart_ > 0) {
        state.multipliers.resize(problem_.links.size());
        for (std::size_t r = 0; r < rows_.size(); ++r)
            state.multipliers[linkOfRow_[r]] = {rows_[r].lambda, directions_[r]};
    }
    settleAnchors(problem_, dt, state);
    state.previousH = h;
}

void GaussSeidel::beginStep(double h, const State& state) {
    // Multipliers scale with h^2; they are never scaled up, or the guard would not hold.
    const double ratio = state.previousH > 0 ? std::min(1.0, h / state.previousH) : 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        Row& row = rows_[r];
        row.alpha = problem_.links[linkOfRow_[r]].compliance / (h * h);
        row.inverseDenominator = 1 / (row.inverseMassA + row.inverseMassB + row.alpha);
        row.lambda = 0;
        if (state.multipliers.empty()) continue;
        row.lambda = ratio * ratio * state.multipliers[linkOfRow_[r]].lambda;
        directions_[r] = state.multipliers[linkOfRow_[r]].direction;
    }
}

// Applies all multipliers at once, along the directions in which they were found.
void GaussSeidel::startWarm(State& state) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const Row& row = rows_[r];
        state.x[row.a] -= row.inverseMassA * row.lambda * directions_[r];
        state.x[row.b] += row.inverseMassB * row.lambda * directions_[r];
    }
}

void GaussSeidel::sweep(State& state) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        Row& row = rows_[r];
        Eigen::Vector3d &a = state.x[row.a], &b = state.x[row.b];
        const Eigen::Vector3d d = b - a;
        const double length = d.norm();
        const double change = -(length - row.restLength + row.alpha * row.lambda) * row.inverseDenominator;
        row.lambda += change;
        if (warmStart_ > 0) directions_[r] = d.stableNormalized();
        if (length == 0) continue; // no direction, no correction
        const Eigen::Vector3d impulse = change / length * d;
        a -= row.inverseMassA * impulse;
        b += row.inverseMassB * impulse;
    }
}

// Internal damping, c = dampingTime / compliance along a link, implicit for each link, on the velocities at
// the end of a substep. If it were a term of the constraint (XPBD, eq. 26), it would multiply the compliance
// that a sweep adds by 1 + dampingTime / h.
void GaussSeidel::damp(double h, State& state) const {
    const Eigen::Vector3d halfKick = h / 2 * problem_.gravity; // of moving ends; static ones have none
    for (const Row& row : rows_) {
        if (row.alpha == 0) continue;
        Eigen::Vector3d &a = state.v[row.a], &b = state.v[row.b];
        Eigen::Vector3d slip = b - a;
        if (row.inverseMassA == 0) slip -= halfKick;
        if (row.inverseMassB == 0) slip += halfKick;
        const Eigen::Vector3d n = (state.x[row.b] - state.x[row.a]).stableNormalized();
        const double give = row.alpha * h / problem_.dampingTime; // 1 / (c h)
        const Eigen::Vector3d impulse = slip.dot(n) / (row.inverseMassA + row.inverseMassB + give) * n;
        a += row.inverseMassA * impulse;
        b -= row.inverseMassB * impulse;
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

// The part of a multiplier that the next substep starts with: less if a substep does not resolve the
// constraint, whose pull would lag behind its motion; and never so much that the start moves the ends of a
// link by more than a twentieth of its length against each other.
void GaussSeidel::keepMultipliers() {
    for (Row& row : rows_) {
        if (warmStart_ == 0) {
            row.lambda = 0;
            continue;
        }
        const double w = row.inverseMassA + row.inverseMassB;
        const double share = std::min(warmStart_, 0.3 + 0.6 * row.alpha / w);
        row.lambda = std::clamp(share * row.lambda, -0.05 * row.restLength / w, 0.05 * row.restLength / w);
    }
}

void stepGaussSeidel(const Scene& scene, const Settings& settings, double dt, State& state) {
    GaussSeidel(scene, settings).step(dt, state);
}

} // namespace sinew::sim::reference
