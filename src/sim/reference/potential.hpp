// What an implicit Euler step minimises, and what a body at rest minimises: a value, its gradient and its
// Hessian over the coordinates of the movable particles.
//
//   Phi(x) = |x - y|_M^2 / (2 h^2) + sum of spring and cell energies - sum m g . x,   y = x_n + h v_n;  at
//   rest h is infinite
#pragma once

#include "sim/reference/reference.hpp"

#include <Eigen/SparseCore>

namespace sinew::sim::reference {

class Potential {
public:
    /// At rest. `problem` must outlive the potential; its links must not be rigid.
    explicit Potential(const Problem& problem);
    /// Of the step of length h [s] that starts at `start`.
    Potential(const Problem& problem, double h, const State& start);

    /// Entries of gradient() and rows of hessian(): three for each movable particle, in order of index.
    Eigen::Index size() const { return 3 * movable_; }

    double value(const std::vector<Eigen::Vector3d>& x) const;             ///< [J]
    Eigen::VectorXd gradient(const std::vector<Eigen::Vector3d>& x) const; ///< [N]
    /// How far rounding of the positions alone keeps the norm of gradient() from 0 [N].
    double gradientNoise(const std::vector<Eigen::Vector3d>& x) const;

    enum class Hessian {
        exact,
        convex ///< without what compressed springs take away across their direction and what pressure does as
               ///< cells turn: never indefinite
    };
    Eigen::SparseMatrix<double> hessian(const std::vector<Eigen::Vector3d>& x, Hessian kind) const; ///< [N/m]

    /// x + factor * step, where `step` has size() entries.
    std::vector<Eigen::Vector3d> moved(std::vector<Eigen::Vector3d> x, double factor,
                                       const Eigen::VectorXd& step) const;

private:
    const Problem& problem_;
    double inertia_ = 0;                  // 1 / h^2 [1/s^2]
    std::vector<Eigen::Vector3d> target_; // y [m]; empty at rest
    std::vector<Eigen::Index> row_;       // the first of a particle's rows; -1 = never moves
    Eigen::Index movable_ = 0;
};

} // namespace sinew::sim::reference
