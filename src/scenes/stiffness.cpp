// k_eff = min(k, kappa_a / h^2, kappa_b / h^2) with kappa_i = omega / (2 n_i w_i): the clamp of the gather
// kernel.
#include "scenes/stiffness.hpp"

#include "sim/compile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::scenes {

StiffnessReport inspectStiffness(const sim::Scene& scene, const sim::Settings& settings) {
    StiffnessReport report;
    if (settings.solver != sim::Solver::split) return report;
    const std::vector<float> inverseMass = sim::inverseMasses(scene);
    std::vector<std::uint32_t> links(inverseMass.size(), 0);
    const auto canMove = [&](const sim::DistanceConstraint& d) {
        return inverseMass[d.a] + inverseMass[d.b] > 0;
    };
    for (const sim::DistanceConstraint& d : scene.distances)
        if (canMove(d)) ++links[d.a], ++links[d.b];

    const auto clamp = [&](std::uint32_t i) {
        return inverseMass[i] == 0 ? std::numeric_limits<double>::infinity()
                                   : double{settings.omega} / (2.0 * links[i] * double{inverseMass[i]});
    };
    const double h = double{scene.dt} / settings.substeps;
    double smallest = std::numeric_limits<double>::infinity();
    for (const sim::DistanceConstraint& d : scene.distances) {
        if (!canMove(d) || d.compliance == 0) continue;
        const double stiffness = 1 / double{d.compliance}, limit = std::min(clamp(d.a), clamp(d.b));
        ++report.elasticLinks;
        const double share = limit / (stiffness * h * h);
        if (share < 1) ++report.clampedLinks;
        smallest = std::min(smallest, share);
    }
    report.softest = std::min(1.0, smallest);
    const double needed = std::ceil(settings.substeps / std::sqrt(smallest));
    report.neededSubsteps = static_cast<std::uint32_t>(std::clamp(needed, 1.0, 4e9));
    return report;
}

} // namespace sinew::scenes
