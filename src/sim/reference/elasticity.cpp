// Springs: energy, forces and the Gershgorin bound of the mass-scaled stiffness.
#include "sim/reference/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew::sim::reference {

namespace {

[[noreturn]] void refuse(const Scene& scene, const char* what, const std::string& why) {
    throw std::invalid_argument("scene \"" + scene.name + "\": " + what + " needs springs alone, but " + why);
}

} // namespace

void requireSprings(const Scene& scene, const char* what) {
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        if (!(scene.distances[c].compliance > 0))
            refuse(scene, what, "distance[" + std::to_string(c) + "] is rigid");
    }
    if (!scene.bends.empty()) refuse(scene, what, "the scene has bends");
    if (!scene.attachments.empty()) refuse(scene, what, "the scene has attachments");
    if (!scene.tethers.empty()) refuse(scene, what, "the scene has tethers");
    if (!scene.driven.empty()) refuse(scene, what, "the scene has driven bodies");
    if (!scene.colliders.empty()) refuse(scene, what, "the scene has colliders");
    if (!scene.planes.empty()) refuse(scene, what, "the scene has boundary planes");
}

void requireUndamped(const Scene& scene, const char* what) {
    if (scene.damping != 0) refuse(scene, what, "the scene has damping");
    if (scene.dampingTime != 0) refuse(scene, what, "the scene has internal damping");
}

double elasticEnergy(const Problem& problem, const std::vector<Eigen::Vector3d>& x) {
    double sum = 0;
    for (const Link& link : problem.links) {
        const double stretch = (x[link.b] - x[link.a]).norm() - link.restLength;
        sum += stretch * stretch / (2 * link.compliance);
    }
    for (const Cell& cell : problem.cells) sum += energyOf(cell, volumeRatio(cell, cornersOf(cell, x)));
    return sum;
}

void addElasticForces(const Problem& problem, const std::vector<Eigen::Vector3d>& x,
                      std::vector<Eigen::Vector3d>& force) {
    for (const Link& link : problem.links) {
        const Eigen::Vector3d d = x[link.b] - x[link.a];
        const double length = d.norm();
        if (length == 0) continue; // no direction, no force
        const Eigen::Vector3d pull = (length - link.restLength) / (link.compliance * length) * d;
        force[link.a] += pull;
        force[link.b] -= pull;
    }
    for (const Cell& cell : problem.cells) {
        const Corners corners = cornersOf(cell, x), gradient = volumeGradient(corners);
        const double pressure = pressureOf(cell, volumeRatio(cell, corners));
        for (std::size_t k = 0; k < 8; ++k) force[cell.corners[k]] += pressure * gradient[k];
    }
}

// A spring's Hessian block has norm at most k, so block row i of M^-1/2 K M^-1/2 sums to at most sum_c k_c
// (w_i + sqrt(w_i w_j)). A cell of edge a has gradients of length sqrt(3) a^2 / 4.
double largestFrequency(const Problem& problem) {
    std::vector<double> rows(problem.size(), 0);
    for (const Link& link : problem.links) {
        const double wA = problem.inverseMass[link.a], wB = problem.inverseMass[link.b];
        const double coupling = std::sqrt(wA * wB);
        rows[link.a] += (wA + coupling) / link.compliance;
        rows[link.b] += (wB + coupling) / link.compliance;
    }
    for (const Cell& cell : problem.cells) {
        const double stiffness = bulkStiffness(cell, 1) * 3.0 / 16 * std::pow(cell.spacing, 4);
        double roots = 0;
        for (const std::uint32_t corner : cell.corners) roots += std::sqrt(problem.inverseMass[corner]);
        for (const std::uint32_t corner : cell.corners)
            rows[corner] += stiffness * std::sqrt(problem.inverseMass[corner]) * roots;
    }
    return rows.empty() ? 0 : std::sqrt(*std::ranges::max_element(rows));
}

} // namespace sinew::sim::reference
