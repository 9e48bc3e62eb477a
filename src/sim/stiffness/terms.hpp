// The constraints of a scene as one list of terms, reduced to what the rules for substeps need. Only
// src/sim/stiffness/substeps.cpp walks it.
#pragma once

#include "sim/lattice/cells.hpp"
#include "sim/lattice/placement.hpp"
#include "sim/stiffness/shares.hpp"
#include "sinew/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace sinew::sim::stiffness {

// The share of a correction that is done after `sweeps`, each of which does `share` of the rest.
inline double shareAfter(double share, double sweeps) {
    return sweeps == 1 ? share : -std::expm1(sweeps * std::log1p(-share)); // `split` always has one sweep
}

// A constraint, as the rules need it.
struct Term {
    double stiffness = 0;   // [N/m]; of a rigid one what its load requires, 0 = nothing
    double clamp = 0;       // `split`: largest k h^2 [kg]
    double inverseMass = 0; // sum of w |grad|^2 [1/kg]
    double sweepShare = 1;  // `jacobi`: share of its correction done in one sweep
    std::uint32_t sweeps = 1;
    double share() const { return shareAfter(sweepShare, sweeps); } // after all sweeps
    bool isRigid = false;
    std::uint32_t particle = 0; // one of its ends
    double own = 1;             // share of the stiffness that it must have itself; levels carry the rest
};

// The share of stiffness that a link of a grid must have itself: one level carries three quarters at twice
// the longest substep, two and more, and one in a sheet, carry eight ninths at three times it. A grid has a
// level if that has two blocks.
inline double ownShare(const Settings& settings, const Grid& grid) {
    if (settings.solver != Solver::split) return 1;
    const std::uint32_t most = std::max({grid.nodes[0], grid.nodes[1], grid.nodes[2]});
    const std::uint32_t levels = std::min(settings.levels, most > 4 ? 2u : most > 2 ? 1u : 0u);
    return levels == 0 ? 1 : levels == 1 && !lattice::isSheet(grid) ? 1 / 4.0 : 1 / 9.0;
}

// Properties of a scene that do not depend on the number of substeps; by particle.
struct Load {
    std::vector<float> inverseMass;
    std::vector<std::uint32_t> links, bends; // those that can move
    std::vector<double> tensions;            // by link, from the weight of its body [N]
    std::uint32_t mostConstraints(std::initializer_list<std::uint32_t> ends) const {
        std::uint32_t most = 0;
        for (const std::uint32_t end : ends) most = std::max(most, links[end] + bends[end]);
        return most;
    }
};

// Without a tolerance the tensions are 0, which saves a walk over the scene.
Load loadOf(const Scene& scene, double tolerance = 0);

// By particle the component that links connect it to.
std::vector<std::uint32_t> componentsOf(const Scene& scene);

inline bool canMove(const Load& load, std::initializer_list<std::uint32_t> ends) {
    return std::ranges::any_of(ends, [&](std::uint32_t end) { return load.inverseMass[end] > 0; });
}

// Largest k h^2 [kg].
double clampOfLink(const Shares& shares, const Scene& scene, std::size_t link);

double splitOfBend(const Load& load, const BendConstraint& c);

// The share of a correction that the slower end takes in one sweep.
double shareOfSweep(const Settings& settings, std::uint32_t mostConstraints);

// The mass shares of `split`; settings.substeps must be resolved. Empty for other solvers.
Shares sharesFor(const Scene& scene, const Settings& settings, const Load& load);

// The terms of a scene: there are millions, so they are visited and not stored.
struct Terms {
    const Scene& scene;
    const Settings& settings;
    const Load& load;
    Shares shares = sharesFor(scene, settings, load);

    bool isSplit() const { return settings.solver == Solver::split; }
    double shareAmong(std::initializer_list<std::uint32_t> ends) const {
        return settings.solver == Solver::jacobi ? shareOfSweep(settings, load.mostConstraints(ends)) : 1;
    }
    std::uint32_t sweeps() const { return isSplit() ? 1 : settings.iterations; }

    template <typename Visit> void forEachLink(const Visit& visit) const {
        std::size_t g = 0; // the first grid that ends after the link
        for (std::size_t i = 0; i < scene.distances.size(); ++i) {
            const DistanceConstraint& c = scene.distances[i];
            const auto endOf = [](const Grid& grid) {
                return std::size_t{grid.firstDistance} + grid.distanceCount;
            };
            while (g < scene.grids.size() && endOf(scene.grids[g]) <= i) ++g;
            const bool isOfGrid = g < scene.grids.size() && scene.grids[g].firstDistance <= i;
            if (!canMove(load, {c.a, c.b})) continue;
            Term term{.clamp = isSplit() ? clampOfLink(shares, scene, i) : 0,
                      .inverseMass = double{load.inverseMass[c.a]} + double{load.inverseMass[c.b]},
                      .sweepShare = shareAmong({c.a, c.b}),
                      .sweeps = sweeps(),
                      .isRigid = c.compliance == 0,
                      .particle = c.a,
                      .own = isOfGrid ? ownShare(settings, scene.grids[g]) : 1};
            if (!term.isRigid)
                term.stiffness = 1 / double{c.compliance};
            else if (c.restLength > 0)
                term.stiffness = load.tensions[i] / (double{settings.tolerance} * double{c.restLength});
            visit(term);
        }
    }

    template <typename Visit> void forEachBend(const Visit& visit) const {
        const double omega = omegaOfBends(settings);
        for (const BendConstraint& c : scene.bends) {
            if (c.compliance == 0 || !canMove(load, {c.a, c.b, c.c})) continue;
            visit(Term{.stiffness = 1 / double{c.compliance},
                       .clamp = omega / splitOfBend(load, c),
                       .inverseMass = double{load.inverseMass[c.a]} + 4 * double{load.inverseMass[c.b]} +
                                      double{load.inverseMass[c.c]},
                       .sweepShare = shareAmong({c.a, c.b, c.c}),
                       .sweeps = sweeps(),
                       .particle = c.b});
        }
    }

    // Cells about their rest volume: k is 0.75 lambda_v a (solvers/shares.hpp). Only `split` supports them.
    template <typename Visit> void forEachCell(const Visit& visit) const {
        for (std::size_t g = 0; isSplit() && g < scene.grids.size(); ++g) {
            const Grid& grid = scene.grids[g];
            if (grid.volumeStiffness == 0) continue;
            const double whole = 0.75 * double{grid.volumeStiffness} * double{grid.restLength[0]};
            lattice::forEachCell(grid, [&](const lattice::Cell& cell) {
                float time = shares.times[cell.corners[0]];
                for (const std::uint32_t corner : cell.corners) time = std::min(time, shares.times[corner]);
                visit(Term{.stiffness = cell.fill * whole,
                           .clamp = cell.fill * double{shares.ofCells[g].volume} * double{time},
                           .particle = cell.corners[0]});
            });
        }
    }

    template <typename Visit> void forEach(const Visit& visit) const {
        forEachLink(visit);
        forEachBend(visit);
        forEachCell(visit);
    }
};

} // namespace sinew::sim::stiffness
