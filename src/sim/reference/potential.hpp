// The function that an implicit Euler step, or a body at rest, minimises: its value, gradient and Hessian in
// the coordinates of the movable particles.
//
//   Phi(x) = |x - y|_M^2 / (2 h^2) + sum of spring and cell energies - sum m g . x,   y = x_n + h v_n;  at
//   rest h is infinite
#pragma once

#include "sim/reference/reference.hpp"

#include <Eigen/SparseCore>

namespace sinew::sim::reference {

class Potential {
public:
    /// The potential at rest. `problem` must outlive the potential; its links must not be rigid.
    explicit Potential(const Problem& problem);
    /// The potential of the step of length h [s] that starts at `start`.
    Potential(const Problem& problem, double h, const State& start);

    /// Entries of gradient() and rows of hessian(): three for each movable particle, in order of index.
    Eigen::Index size() const { return 3 * movable_; }

    double value(const std::vector<Eigen::Vector3d>& x) const;             ///< [J]
    Eigen::VectorXd gradient(const std::vector<Eigen::Vector3d>& x) const; ///< [N]
    /// Bound of the norm of gradient() at the minimum, from rounding of the positions alone [N].
    double gradientNoise(const std::vector<Eigen::Vector3d>& x) const;

    enum class Hessian {
        exact,
        convex ///< without negative terms, of compressed springs across their direction and of pressure as
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
    std::vector<Eigen::Index> row_;       // the first row of a particle; -1 = never moves
    Eigen::Index movable_ = 0;
};

} // namespace sinew::sim::reference
