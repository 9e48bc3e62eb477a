// Incremental potential of springs. The Hessian block of a spring of direction n, length l and rest length L
// is k (n n^T + (1 - L/l) (1 - n n^T)), that of a cell b g_i g_j^T - p d2V / dx_i dx_j.
#include "sim/reference/potential.hpp"

#include "sim/reference/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::reference {

Potential::Potential(const Problem& problem) : problem_(problem), row_(problem.size(), -1) {
    for (std::size_t i = 0; i < problem.size(); ++i) {
        if (problem.inverseMass[i] > 0) row_[i] = 3 * movable_++;
    }
}

Potential::Potential(const Problem& problem, double h, const State& start) : Potential(problem) {
    inertia_ = 1 / (h * h);
    target_ = start.x;
    for (std::size_t i = 0; i < problem.size(); ++i) target_[i] += h * start.v[i];
}

double Potential::value(const std::vector<Eigen::Vector3d>& x) const {
    double sum = elasticEnergy(problem_, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (row_[i] < 0) continue;
        const double mass = 1 / problem_.inverseMass[i];
        sum -= mass * problem_.gravity.dot(x[i]);
        if (inertia_ > 0) sum += inertia_ * mass / 2 * (x[i] - target_[i]).squaredNorm();
    }
    return sum;
}

Eigen::VectorXd Potential::gradient(const std::vector<Eigen::Vector3d>& x) const {
    std::vector<Eigen::Vector3d> force(x.size(), Eigen::Vector3d::Zero());
    addElasticForces(problem_, x, force);
    Eigen::VectorXd result(size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (row_[i] < 0) continue;
        const double mass = 1 / problem_.inverseMass[i];
        Eigen::Vector3d sum = -force[i] - mass * problem_.gravity;
        if (inertia_ > 0) sum += inertia_ * mass * (x[i] - target_[i]);
        result.segment<3>(row_[i]) = sum;
    }
    return result;
}

double Potential::gradientNoise(const std::vector<Eigen::Vector3d>& x) const {
    std::vector<double> stiffness(x.size(), 0);
    for (const Link& link : problem_.links) {
        stiffness[link.a] += 1 / link.compliance;
        stiffness[link.b] += 1 / link.compliance;
    }
    for (const Cell& cell : problem_.cells) {
        const Corners gradient = volumeGradient(cornersOf(cell, x));
        double lengths = 0;
        for (const Eigen::Vector3d& g : gradient) lengths += g.norm();
        for (std::size_t k = 0; k < 8; ++k)
            stiffness[cell.corners[k]] += bulkStiffness(cell, 1) * gradient[k].norm() * lengths;
    }
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (row_[i] < 0) continue;
        const double noise = (stiffness[i] + inertia_ / problem_.inverseMass[i]) * x[i].norm();
        sum += noise * noise;
    }
    return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

Eigen::SparseMatrix<double> Potential::hessian(const std::vector<Eigen::Vector3d>& x, Hessian kind) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&entries](Eigen::Index row, Eigen::Index column, const Eigen::Matrix3d& block) {
        if (row < 0 || column < 0) return;
        for (Eigen::Index r = 0; r < 3; ++r)
            for (Eigen::Index c = 0; c < 3; ++c) entries.emplace_back(row + r, column + c, block(r, c));
    };
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (row_[i] >= 0)
            add(row_[i], row_[i], inertia_ / problem_.inverseMass[i] * Eigen::Matrix3d::Identity());
    }
    for (const Link& link : problem_.links) {
        const Eigen::Vector3d d = x[link.b] - x[link.a];
        const double length = d.norm();
        if (length == 0) continue; // no direction, no stiffness
        const Eigen::Matrix3d along = d * d.transpose() / (length * length);
        const double across = 1 - link.restLength / length;
        const Eigen::Matrix3d block = (along + (kind == Hessian::exact ? across : std::max(across, 0.0)) *
                                                   (Eigen::Matrix3d::Identity() - along)) /
                                      link.compliance;
        add(row_[link.a], row_[link.a], block);
        add(row_[link.b], row_[link.b], block);
        add(row_[link.a], row_[link.b], -block);
        add(row_[link.b], row_[link.a], -block);
    }
    for (const Cell& cell : problem_.cells) {
        const Corners corners = cornersOf(cell, x), gradient = volumeGradient(corners);
        const Eigen::Matrix3d edges = meanEdges(corners);
        const double ratio = volumeRatio(cell, corners), stiffness = bulkStiffness(cell, ratio),
                     pressure = kind == Hessian::exact ? pressureOf(cell, ratio) : 0;
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t j = 0; j < 8; ++j)
                add(row_[cell.corners[i]], row_[cell.corners[j]],
                    stiffness * gradient[i] * gradient[j].transpose() -
                        pressure * volumeHessian(edges, i, j));
    }
    Eigen::SparseMatrix<double> result(size(), size());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

std::vector<Eigen::Vector3d> Potential::moved(std::vector<Eigen::Vector3d> x, double factor,
                                              const Eigen::VectorXd& step) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (row_[i] >= 0) x[i] += factor * step.segment<3>(row_[i]);
    }
    return x;
}

} // namespace sinew::sim::reference
