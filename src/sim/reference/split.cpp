// `split` in double: springs evaluated at y = x + theta h v, stiffness clamped by mass splitting, then kick
// and drift. Constraint c has the share k~_c / sum k~ of each of its ends, k~_c = k_c / (1 + 2 w h^2 K_c),
// with K_c = k_c (in a grid, the stiffest of its rest length) and w the mean inverse mass; it is clamped to
// k~_c min(tau_i, tau_j), tau_i = omega / (2 w_i sum k~). The volume of a cell has a share by the same rule,
// k_c = 0.75 lambda_v a at full fill, and is clamped to 2 k~_c min tau_i / (sum |g_i|^2 + |C| a (|A|^2 / (6
// a^2) + 1/2)), C = V - V0, A its mean edges. Pressure that unfolds cells has a share in addition to those
// (sim/stiffness/shares.hpp). With a sharp clamp the sum of k~ in tau_i is the largest eigenvalue of sum k~ n
// n^T in the directions at rest, and what the present directions allow is found every eighth substep
// (docs/clamp.md).
#include "sim/reference/attached.hpp"
#include "sim/reference/levels.hpp"
#include "sim/reference/reference.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sinew::sim::reference {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The largest eigenvalue of a matrix without negative ones, at most 0.5 % too large: q + p (1 + x) with x
// from one step of Newton's at 3 x^2 + x^3 = 2 + 2 r.
double largestEigenvalue(const Matrix3d& matrix) {
    const double q = matrix.trace() / 3;
    const Matrix3d deviation = matrix - q * Matrix3d::Identity();
    const double p = std::sqrt(deviation.squaredNorm() / 6);
    const double r = p > 0 ? std::clamp(deviation.determinant() / (2 * p * p * p), -1.0, 1.0) : 0;
    const double x = std::sqrt((2 + 2 * r) / 3);
    return q + p * (1 + x - x * x / (6 + 3 * x));
}

// The direction of each link at rest: that in its grid, else that of the scene.
std::vector<Vector3d> restDirections(const Scene& scene, const Problem& problem) {
    std::vector<std::size_t> grid(problem.size(), scene.grids.size());
    std::vector<Vector3d> place(problem.size());
    for (std::size_t g = 0; g < scene.grids.size(); ++g)
        for (std::size_t i = 0; i < scene.grids[g].node.size(); ++i) {
            const auto [x, y, z] = scene.grids[g].nodes;
            const std::uint32_t node = scene.grids[g].node[i];
            grid[scene.grids[g].firstParticle + i] = g;
            place[scene.grids[g].firstParticle + i] = Vector3d(node % x, node / x % y, node / x / y);
        }
    std::vector<Vector3d> directions;
    for (const Link& link : problem.links) {
        const bool isOfGrid = grid[link.a] < scene.grids.size() && grid[link.a] == grid[link.b];
        const Vector3d d = isOfGrid ? Vector3d(place[link.b] - place[link.a])
                                    : Vector3d(toEigen(scene.particles[link.b].position) -
                                               toEigen(scene.particles[link.a].position));
        directions.push_back(d.stableNormalized());
    }
    return directions;
}

// Shares and clamps of a scene, constant in time.
struct Split {
    std::vector<double> stiffness, share;         // of each link: k and k~ [N/m]
    std::vector<double> clampTime;                // of each particle: tau at rest [s^2]
    std::vector<double> cellShare, recoveryShare; // of each cell: k~ [N/m]

    // `spare`: share of a particle by which recovery may exceed it.
    Split(const Scene& scene, const Problem& problem, double omega, double h, double spare, bool isSharp) {
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
        for (const Cell& cell : problem.cells) {
            const double full = 0.75 * cell.stiffness * cell.spacing;
            cellShare.push_back(cell.fill * full / (1 + softening * full));
            recoveryShare.push_back(0);
            for (const std::uint32_t corner : cell.corners) sums[corner] += cellShare.back();
        }
        if (spare > 0) addRecovery(problem, isSharp ? spare / 3 : spare, spare, softening);
        if (isSharp) {
            std::vector<Matrix3d> borne(problem.size(), Matrix3d::Zero());
            const std::vector<Vector3d> directions = restDirections(scene, problem);
            for (std::size_t c = 0; c < problem.links.size(); ++c)
                for (const std::uint32_t end : {problem.links[c].a, problem.links[c].b})
                    borne[end] += share[c] * directions[c] * directions[c].transpose();
            for (std::size_t c = 0; c < problem.cells.size(); ++c)
                for (const std::uint32_t corner : problem.cells[c].corners)
                    borne[corner] += cellShare[c] * Matrix3d::Identity();
            for (std::size_t i = 0; i < problem.size(); ++i) sums[i] = largestEigenvalue(borne[i]);
        }
        for (std::size_t i = 0; i < problem.size(); ++i)
            clampTime.push_back(problem.inverseMass[i] > 0 && sums[i] > 0
                                    ? omega / (2 * problem.inverseMass[i] * sums[i])
                                    : infinite);
    }

    // Whether a link or a cell at rest is softer than asked in a substep of this length, by more than float32
    // rounds.
    bool clamps(const Problem& problem, double h) const {
        constexpr double most = 1 + 1e-6;
        for (std::size_t c = 0; c < problem.links.size(); ++c) {
            const double time = std::min(clampTime[problem.links[c].a], clampTime[problem.links[c].b]);
            if (stiffness[c] * h * h > most * share[c] * time) return true;
        }
        for (std::size_t c = 0; c < problem.cells.size(); ++c) {
            const Cell& cell = problem.cells[c];
            double time = infinite;
            for (const std::uint32_t corner : cell.corners) time = std::min(time, clampTime[corner]);
            if (cell.fill * 0.75 * cell.stiffness * cell.spacing * h * h > most * cellShare[c] * time)
                return true;
        }
        return false;
    }

    // tau of each particle that the directions of links between ends at y allow, with `most` for 2 w tau
    // times what meets in a particle.
    std::vector<double> allowedTimes(const Problem& problem, const std::vector<Vector3d>& y,
                                     double most) const {
        std::vector<Matrix3d> borne(problem.size(), Matrix3d::Zero());
        for (std::size_t c = 0; c < problem.links.size(); ++c) {
            const Link& link = problem.links[c];
            const Vector3d d = y[link.b] - y[link.a], n = d.stableNormalized();
            const double along = d.norm() > link.restLength ? link.restLength / d.norm() : 1;
            for (const std::uint32_t end : {link.a, link.b})
                borne[end] += share[c] * (along * n * n.transpose() + (1 - along) * Matrix3d::Identity());
        }
        for (std::size_t c = 0; c < problem.cells.size(); ++c)
            for (const std::uint32_t corner : problem.cells[c].corners)
                borne[corner] += (cellShare[c] + recoveryShare[c]) * Matrix3d::Identity();
        std::vector<double> times;
        for (std::size_t i = 0; i < problem.size(); ++i) {
            const double bound = 2 * problem.inverseMass[i] * largestEigenvalue(borne[i]);
            times.push_back(bound > 0 ? std::min(clampTime[i], most / bound) : clampTime[i]);
        }
        return times;
    }

    std::vector<ClampedLink> links(const Problem& problem) const {
        std::vector<ClampedLink> links;
        for (std::size_t c = 0; c < problem.links.size(); ++c)
            links.push_back({stiffness[c], share[c] * std::min(clampTime[problem.links[c].a],
                                                               clampTime[problem.links[c].b])});
        return links;
    }

    // The largest k_c D_c / omega of the links, with D_c at most omega / (k~_c min(tau)) [1/s^2].
    double most(const Problem& problem) const {
        double most = 0;
        for (std::size_t c = 0; c < problem.links.size(); ++c) {
            const Link& link = problem.links[c];
            const double clamp = share[c] * std::min(clampTime[link.a], clampTime[link.b]);
            most = std::max(most, link.compliance > 0 ? stiffness[c] / clamp : infinite);
        }
        return most;
    }

private:
    // A cell's own part of what its links and its volume take of a corner: for each kind of link, the cell's
    // share in a whole one times the number of them that meet in a corner.
    // `ofLinks` and `ofCells`: the shares of both by which recovery may exceed them.
    void addRecovery(const Problem& problem, double ofLinks, double ofCells, double softening) {
        std::map<std::size_t, double> cornerSums; // of a full cell, by grid
        for (const auto& [grid, compliances, levels] : problem.lattices) {
            constexpr double parts[] = {3 / 4.0, 3 / 2.0, 1};
            for (std::size_t kind = 0; kind < compliances.size(); ++kind)
                if (compliances[kind] > 0)
                    cornerSums[grid] += parts[kind] / compliances[kind] / (1 + softening * levels[kind]);
        }
        for (std::size_t c = 0; c < problem.cells.size(); ++c) {
            const Cell& cell = problem.cells[c];
            if (cell.recovery > 0)
                recoveryShare[c] = ofLinks * cell.fill * cornerSums[cell.grid] + ofCells * cellShare[c];
        }
    }
};

// Pressure on a cell's corners [Pa], clamped for kicks of length h.
double clampedPressure(const Cell& cell, const Corners& y, double clampTime, double share,
                       double recoveryShare, double h) {
    const double ratio = volumeRatio(cell, y), volume = cell.restVolume(), a = cell.spacing;
    double gradients = 0;
    for (const Eigen::Vector3d& g : volumeGradient(y)) gradients += g.squaredNorm();
    const double turning = a * (meanEdges(y).squaredNorm() / (6 * a * a) + 0.5);
    const auto limit = [&](double k, double missing) { // largest -pressure / C [Pa / m^3]
        const double bound = gradients + std::abs(missing) * volume * turning;
        return bound > 0 ? 2 * k * clampTime / (h * h * bound) : infinite;
    };
    const double missing = 1 - ratio;
    double pressure = missing * volume * std::min(cell.fill * cell.stiffness / volume, limit(share, missing));
    const double unfolding = std::max(0.5 - ratio, 0.0);
    if (unfolding > 0)
        pressure += std::min(cell.fill * cell.recovery * std::min(unfolding / 0.5, 1.0),
                             unfolding * volume * limit(recoveryShare, unfolding));
    return pressure;
}

// Forces on all particles [N] of links whose ends are at y and move with v; stiffness and damping are clamped
// for kicks of length h with `times` of the particles.
std::vector<Eigen::Vector3d> forces(const Problem& problem, const Split& split,
                                    const std::vector<double>& times, double h, double dampingShare,
                                    const std::vector<Eigen::Vector3d>& y,
                                    const std::vector<Eigen::Vector3d>& v) {
    std::vector<Eigen::Vector3d> force(problem.size(), Eigen::Vector3d::Zero());
    for (std::size_t c = 0; c < problem.links.size(); ++c) {
        const Link& link = problem.links[c];
        const Eigen::Vector3d d = y[link.b] - y[link.a];
        const double length = d.norm();
        if (length == 0) continue; // no direction, no force
        const double clamp = split.share[c] * std::min(times[link.a], times[link.b]);
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
    for (std::size_t c = 0; c < problem.cells.size(); ++c) {
        const Cell& cell = problem.cells[c];
        double clampTime = infinite;
        for (const std::uint32_t corner : cell.corners) clampTime = std::min(clampTime, times[corner]);
        const Corners corners = cornersOf(cell, y), gradient = volumeGradient(corners);
        const double pressure =
            clampedPressure(cell, corners, clampTime, split.cellShare[c], split.recoveryShare[c], h);
        for (std::size_t k = 0; k < 8; ++k) force[cell.corners[k]] += pressure * gradient[k];
    }
    return force;
}

} // namespace

constexpr double clampMemory = 2;          // [s]
constexpr std::uint32_t clampInterval = 8; // substeps

void stepSplit(const Scene& scene, const Settings& settings, double dt, State& state) {
    const Problem problem(scene);
    const double h = dt / settings.substeps, theta = double{settings.theta}, omega = double{settings.omega};
    const double spare = 0.9 * 4 / (1 + 2 * theta) / omega - 1;
    const double hOfScene = double{scene.dt} / settings.substeps; // shares ignore dt
    const Split bySum(scene, problem, omega, hOfScene, spare, false);
    const bool isSharp = settings.hasSharpClamp && settings.levels == 0 && problem.dampingTime == 0 &&
                         bySum.clamps(problem, hOfScene);
    const Split split = isSharp ? Split(scene, problem, omega, hOfScene, spare, true) : bySum;
    const double bends = problem.bends.empty() ? 0 : std::min(0.9 * (4 / (1 + 2 * theta) - omega), omega / 2);
    const double most = 0.95 * 4 / (1 + 2 * theta) - bends;
    if (isSharp && state.clampTimes.empty()) {
        std::vector<Vector3d> start;
        for (const Particle& particle : scene.particles) start.push_back(toEigen(particle.position));
        state.clampTimes = split.allowedTimes(problem, start, most);
    }
    const Levels levels(scene, settings, problem, split.links(problem), double{scene.dt} / settings.substeps);
    const double kept = std::exp(-problem.damping * h);
    const double longest = std::max({h, state.previousH, state.longestH * std::exp(-dt / clampMemory)});
    const double share = dampingShare(problem, split.most(problem), omega, theta, longest);
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        // v belongs to the middle of the last substep, which had this length.
        const double hBefore = substep == 0 ? state.previousH : h;
        std::vector<Eigen::Vector3d> y(state.x);
        for (std::size_t i = 0; i < problem.size(); ++i) y[i] += theta * hBefore * state.v[i];
        std::vector<Eigen::Vector3d> force =
            forces(problem, split, isSharp ? state.clampTimes : split.clampTime, longest, share, y, state.v);
        levels.addForces(longest, y, force);
        addBendForces(problem, omega, theta, longest, y, force);
        if (isSharp && substep % clampInterval == 0) {
            const std::vector<double> allowed = split.allowedTimes(problem, y, most);
            const std::uint32_t untilNext = std::min(clampInterval, settings.substeps - substep);
            for (std::size_t i = 0; i < problem.size(); ++i)
                if (problem.inverseMass[i] > 0)
                    state.clampTimes[i] =
                        std::min(allowed[i], state.clampTimes[i] * (1 + untilNext * h / clampMemory));
        }
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
    state.longestH = longest;
}

} // namespace sinew::sim::reference
