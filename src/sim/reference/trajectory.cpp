// Velocity Verlet [Swope 1982] at ever shorter steps, until two answers agree.
#include "sim/reference/trajectory.hpp"

#include "sim/reference/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew::sim::reference {

namespace {

using Positions = std::vector<Eigen::Vector3d>;

// Each halving doubles the time and reduces the error by a factor of 4, so after the first one it is known
// whether they suffice: chaotic motion is refused before it has cost minutes.
constexpr int mostHalvings = 6;

class Verlet {
public:
    explicit Verlet(const Problem& problem) : problem_(problem), force_(problem.size()) {}

    void advance(double h, std::uint64_t steps, State& state) {
        findForces(state.x);
        for (std::uint64_t step = 0; step < steps; ++step) {
            kick(h / 2, state);
            for (std::size_t i = 0; i < problem_.size(); ++i) state.x[i] += h * state.v[i];
            findForces(state.x);
            kick(h / 2, state);
        }
    }

private:
    void findForces(const Positions& x) {
        std::ranges::fill(force_, Eigen::Vector3d::Zero());
        addElasticForces(problem_, x, force_);
    }

    void kick(double time, State& state) const {
        for (std::size_t i = 0; i < problem_.size(); ++i) {
            const double w = problem_.inverseMass[i];
            if (w > 0) state.v[i] += time * (problem_.gravity + w * force_[i]);
        }
    }

    const Problem& problem_;
    std::vector<Eigen::Vector3d> force_; // [N]
};

// A hash in [-1, 1], equal on every machine (splitmix64).
double hashed(std::uint64_t index) {
    std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

void perturb(const Problem& problem, double distance, State& state) {
    for (std::size_t i = 0; i < problem.size(); ++i) {
        if (problem.inverseMass[i] == 0) continue;
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            state.x[i][axis] += distance * hashed(3 * i + static_cast<std::uint64_t>(axis));
    }
}

std::vector<Positions> record(const Problem& problem, State state, const TrajectoryOptions& options,
                              std::uint64_t stepsPerFrame) {
    std::vector<Positions> frames;
    Verlet verlet(problem);
    for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
        verlet.advance(options.dt / static_cast<double>(stepsPerFrame), stepsPerFrame, state);
        frames.push_back(state.x);
    }
    return frames;
}

// The largest distance [m]; infinite if either is not finite.
double difference(const std::vector<Positions>& a, const std::vector<Positions>& b) {
    double largest = 0;
    for (std::size_t frame = 0; frame < a.size(); ++frame) {
        for (std::size_t i = 0; i < a[frame].size(); ++i) {
            const double distance = (a[frame][i] - b[frame][i]).norm();
            if (!std::isfinite(distance)) return HUGE_VAL;
            largest = std::max(largest, distance);
        }
    }
    return largest;
}

void check(const Scene& scene, const TrajectoryOptions& options) {
    requireSprings(scene, "a trajectory truth");
    requireUndamped(scene, "a trajectory truth");
    const auto refuse = [](const char* sentence) { throw std::invalid_argument(sentence); };
    if (!(options.dt > 0 && std::isfinite(options.dt))) refuse("trajectory: dt must be above 0");
    if (!(options.tolerance > 0)) refuse("trajectory: tolerance must be above 0");
    if (!(options.perturbation >= 0 && std::isfinite(options.perturbation)))
        refuse("trajectory: perturbation must be at least 0");
}

} // namespace

Trajectory trueTrajectory(const Scene& scene, const TrajectoryOptions& options) {
    check(scene, options);
    const Problem problem(scene);
    const double size = bodySize(scene) > 0 ? bodySize(scene) : 1;
    State start = initialState(scene);
    perturb(problem, options.perturbation * size, start);

    auto steps =
        static_cast<std::uint64_t>(std::ceil(std::max(1.0, options.dt * largestFrequency(problem) / 0.1)));
    std::vector<Positions> coarse = record(problem, start, options, steps);
    for (int left = mostHalvings - 1;; --left) {
        steps *= 2;
        std::vector<Positions> fine = record(problem, start, options, steps);
        const double moved = difference(coarse, fine) / size, h = options.dt / static_cast<double>(steps);
        if (moved < options.tolerance) return {std::move(fine), h, moved};
        if (!(moved < options.tolerance * std::pow(4, left))) {
            throw std::runtime_error("scene \"" + scene.name + "\": halving h to " + std::to_string(1e6 * h) +
                                     " us still changes the motion by " + std::to_string(moved) +
                                     " of body size; ask for fewer frames or a larger tolerance");
        }
        coarse = std::move(fine);
    }
}

void stepVerlet(const Scene& scene, double h, std::uint64_t steps, State& state) {
    requireSprings(scene, "a Verlet step");
    requireUndamped(scene, "a Verlet step");
    const Problem problem(scene);
    Verlet(problem).advance(h, steps, state);
}

double bodySize(const Scene& scene) {
    if (scene.particles.empty()) return 0;
    Eigen::Vector3d low = toEigen(scene.particles[0].position), high = low;
    for (const Particle& particle : scene.particles) {
        low = low.cwiseMin(toEigen(particle.position));
        high = high.cwiseMax(toEigen(particle.position));
    }
    return (high - low).norm();
}

Energy energy(const Scene& scene, const State& state) {
    const auto refuse = [&](const char* why) {
        throw std::invalid_argument("scene \"" + scene.name + "\": " + why);
    };
    const Problem problem(scene);
    for (const Link& link : problem.links)
        if (link.compliance == 0) refuse("a rigid link has no energy");
    if (!scene.bends.empty()) refuse("the energy of bends is not counted");
    if (!scene.attachments.empty()) refuse("the energy of attachments is not counted");
    Energy result{.elastic = elasticEnergy(problem, state.x)};
    for (std::size_t i = 0; i < problem.size(); ++i) {
        const double w = problem.inverseMass[i];
        if (w == 0) continue;
        result.kinetic += state.v[i].squaredNorm() / (2 * w);
        result.gravitational -= problem.gravity.dot(state.x[i]) / w;
    }
    return result;
}

} // namespace sinew::sim::reference
