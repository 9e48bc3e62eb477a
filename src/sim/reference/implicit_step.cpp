// Newton's method with a sparse LDL^T and a line search. If the Hessian is indefinite (compressed springs) it
// uses the convex part, and if that is singular (a chain before it hangs) it adds a multiple of the identity.
#include "sim/reference/implicit_step.hpp"

#include "sim/reference/elasticity.hpp"
#include "sim/reference/potential.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace sinew::sim::reference {

namespace {

using Positions = std::vector<Eigen::Vector3d>;
using Matrix = Eigen::SparseMatrix<double>;

class Newton {
public:
    Newton(const Scene& scene, const Potential& potential, const NewtonOptions& options)
        : scene_(scene), potential_(potential), options_(options) {}

    NewtonReport minimise(Positions& x) {
        Eigen::VectorXd gradient = potential_.gradient(x);
        NewtonReport report{{gradient.norm()}};
        while (!isDone(report, x)) {
            if (report.gradients.size() > options_.mostIterations || !std::isfinite(report.gradients.back()))
                fail("does not converge");
            x = searchAlong(direction(x, gradient), x, gradient);
            gradient = potential_.gradient(x);
            report.gradients.push_back(gradient.norm());
        }
        return report;
    }

private:
    bool isDone(const NewtonReport& report, const Positions& x) const {
        return report.gradients.back() <= options_.tolerance * report.gradients.front() ||
               report.gradients.back() <= potential_.gradientNoise(x);
    }

    // A descent direction: minus the inverse of the Hessian, or of a nearby positive definite matrix, times
    // the gradient.
    Eigen::VectorXd direction(const Positions& x, const Eigen::VectorXd& gradient) {
        if (const auto step = solve(potential_.hessian(x, Potential::Hessian::exact), gradient)) return *step;
        Matrix hessian = potential_.hessian(x, Potential::Hessian::convex);
        const double mean = hessian.diagonal().mean();
        Matrix unit(hessian.rows(), hessian.cols());
        unit.setIdentity();
        for (double shift = 0; shift < 1e3; shift = shift == 0 ? 1e-6 : 10 * shift) {
            if (const auto step = solve(hessian + shift * mean * unit, gradient)) return *step;
        }
        fail("finds no descent direction");
    }

    // Empty if the matrix is not safely positive definite.
    std::optional<Eigen::VectorXd> solve(const Matrix& hessian, const Eigen::VectorXd& gradient) {
        constexpr double singular = 1e-13; // of the largest pivot
        factors_.compute(hessian);
        if (factors_.info() != Eigen::Success) return {};
        const Eigen::VectorXd pivots = factors_.vectorD();
        if (!(pivots.minCoeff() > singular * pivots.maxCoeff())) return {};
        return -factors_.solve(gradient);
    }

    // Halves the step until the value falls enough [Armijo 1966]. Near the minimum rounding hides the fall of
    // the value: there a gradient that halves is accepted instead.
    Positions searchAlong(const Eigen::VectorXd& step, const Positions& x,
                          const Eigen::VectorXd& gradient) const {
        const double value = potential_.value(x), slope = gradient.dot(step);
        for (double factor = 1; factor > 1e-12; factor /= 2) {
            Positions candidate = potential_.moved(x, factor, step);
            if (potential_.value(candidate) <= value + 1e-4 * factor * slope) return candidate;
            if (factor == 1 && potential_.gradient(candidate).norm() <= gradient.norm() / 2) return candidate;
        }
        fail("finds no descent step");
    }

    [[noreturn]] void fail(const char* what) const {
        throw std::runtime_error("scene \"" + scene_.name + "\": Newton's method " + what +
                                 " (is any particle fixed?)");
    }

    const Scene& scene_;
    const Potential& potential_;
    NewtonOptions options_;
    Eigen::SimplicialLDLT<Matrix> factors_;
};

NewtonReport minimise(const Scene& scene, const Potential& potential, const NewtonOptions& options,
                      Positions& x) {
    return potential.size() == 0 ? NewtonReport{{0}} : Newton(scene, potential, options).minimise(x);
}

} // namespace

double NewtonReport::residual() const {
    return gradients.front() > 0 ? gradients.back() / gradients.front() : 0;
}

NewtonReport stepImplicitEuler(const Scene& scene, double h, State& state, const NewtonOptions& options) {
    requireSprings(scene, "an implicit step");
    requireUndamped(scene, "an implicit step");
    if (!(h > 0 && std::isfinite(h))) throw std::invalid_argument("an implicit step: h must be above 0");
    const Problem problem(scene);
    const Positions before = state.x;
    const NewtonReport report = minimise(scene, Potential(problem, h, state), options, state.x);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (problem.inverseMass[i] > 0) state.v[i] = (state.x[i] - before[i]) / h;
    }
    return report;
}

NewtonReport findEquilibrium(const Scene& scene, State& state, const NewtonOptions& options) {
    requireSprings(scene, "an equilibrium");
    const Problem problem(scene);
    for (Eigen::Vector3d& v : state.v) v.setZero();
    return minimise(scene, Potential(problem), options, state.x);
}

State staticEquilibrium(const Scene& scene) {
    State state = initialState(scene);
    findEquilibrium(scene, state);
    return state;
}

} // namespace sinew::sim::reference
