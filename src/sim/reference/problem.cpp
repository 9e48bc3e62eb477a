// The Scene in double precision, and the parts of a substep that the sequential solvers share.
#include "sim/reference/problem.hpp"

#include "sim/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace sinew::sim::reference {

Eigen::Vector3d toEigen(const Vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

namespace {

std::vector<double> levelsOf(const Scene& scene) {
    std::vector<double> levels;
    for (const DistanceConstraint& c : scene.distances)
        levels.push_back(c.compliance > 0 ? std::min(1 / double{c.compliance}, 1e20) : 1e20);
    for (const Grid& grid : scene.grids) {
        std::map<float, double> stiffest;
        for (std::uint32_t i = 0; i < grid.distanceCount; ++i) {
            const std::uint32_t c = grid.firstDistance + i;
            double& most = stiffest[scene.distances[c].restLength];
            most = std::max(most, levels[c]);
        }
        for (std::uint32_t i = 0; i < grid.distanceCount; ++i)
            levels[grid.firstDistance + i] = stiffest[scene.distances[grid.firstDistance + i].restLength];
    }
    return levels;
}

} // namespace

Problem::Problem(const Scene& scene)
    : linkCount(scene.particles.size(), 0), bendCount(scene.particles.size(), 0), cells(cellsOf(scene)),
      gravity(toEigen(scene.gravity)), damping(double{scene.damping}),
      dampingTime(double{scene.dampingTime}) {
    if (!scene.driven.empty())
        throw std::invalid_argument("the scene has driven bodies, which the references do not support");
    if (!scene.colliders.empty())
        throw std::invalid_argument("the scene has colliders, which the references do not support");
    for (const Particle& particle : scene.particles) {
        inverseMass.push_back(double{particle.inverseMass});
        contactOffset.push_back(double{particle.contactOffset});
    }
    for (const FixedConstraint& constraint : scene.fixed) inverseMass[constraint.particle] = 0;
    const std::vector<double> levels = levelsOf(scene);
    for (std::uint32_t k = 0; k < scene.distances.size(); ++k) {
        const DistanceConstraint& c = scene.distances[k];
        if (inverseMass[c.a] == 0 && inverseMass[c.b] == 0) continue;
        links.push_back({c.a, c.b, double{c.restLength}, double{c.compliance}, levels[k], k});
        ++linkCount[c.a];
        ++linkCount[c.b];
    }
    for (std::uint32_t k = 0; k < scene.bends.size(); ++k) {
        const BendConstraint& c = scene.bends[k];
        if (inverseMass[c.a] + inverseMass[c.b] + inverseMass[c.c] == 0) continue;
        bends.push_back({c.a, c.b, c.c, double{c.compliance}, k});
        for (const std::uint32_t end : {c.a, c.b, c.c}) ++bendCount[end];
    }
    for (const Attachment& a : scene.attachments)
        springs.push_back({a.particle, double{a.compliance}, double{a.maxForce}, double{a.maxSpeed}});
    for (const Tether& t : scene.tethers) ropes.push_back({t.particle, t.anchor, double{t.length}});
    std::ranges::stable_sort(ropes, {}, &Rope::particle);
    for (std::size_t g = 0; g < scene.grids.size(); ++g) {
        const Grid& grid = scene.grids[g];
        if (!hasCellVolumes(grid)) continue;
        LatticeLinks kinds{.grid = g, .compliances = {}, .levels = {}};
        for (std::uint32_t kind = 0; kind < grid.kinds; ++kind) {
            kinds.compliances.push_back(double{grid.compliance[kind]});
            double level = kinds.compliances.back() > 0 ? 1 / kinds.compliances.back() : 0; // if none is
            for (std::uint32_t c = grid.firstDistance; c < grid.firstDistance + grid.distanceCount; ++c)
                if (scene.distances[c].restLength == grid.restLength[kind]) level = levels[c];
            kinds.levels.push_back(level);
        }
        lattices.push_back(kinds);
    }
    for (const Plane& plane : scene.planes) {
        walls.push_back({toEigen(plane.normal), double{plane.offset}, double{plane.friction},
                         double{std::max(plane.friction, plane.staticFriction)}, double{plane.restitution}});
    }
}

void requireNoCells(const Scene& scene, const char* solver) {
    for (const Grid& grid : scene.grids)
        if (hasCellVolumes(grid))
            throw std::invalid_argument("grid \"" + grid.name + "\" has cell volumes, which " + solver +
                                        " does not support");
}

State initialState(const Scene& scene) {
    const Problem problem(scene);
    State state;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        const Particle& particle = scene.particles[i];
        state.x.push_back(toEigen(particle.position));
        state.v.push_back(problem.inverseMass[i] > 0 ? toEigen(particle.velocity) : Eigen::Vector3d::Zero());
    }
    for (const Attachment& a : scene.attachments) state.anchors.push_back(toEigen(a.anchor));
    return state;
}

Touched projectOntoWalls(const Problem& problem, std::size_t particle, const Eigen::Vector3d& before,
                         Eigen::Vector3d& x) {
    Touched touched = 0;
    for (std::size_t k = 0; k < problem.walls.size(); ++k) {
        const Wall& wall = problem.walls[k];
        const double constraint = wall.normal.dot(x) - wall.offset - problem.contactOffset[particle];
        if (constraint >= 0) continue;
        const Eigen::Vector3d moved = x - before;
        const Eigen::Vector3d slid = moved - wall.normal.dot(moved) * wall.normal;
        x -= constraint * wall.normal;
        const double most = wall.friction * -constraint;
        x -= slid.norm() <= wall.staticFriction * -constraint ? slid
                                                              : Eigen::Vector3d(most * slid.normalized());
        touched |= Touched{1} << k;
    }
    return touched;
}

void rebound(const Problem& problem, Touched touched, double h, const Eigen::Vector3d& before,
             Eigen::Vector3d& v) {
    const double slowest = 2 * problem.gravity.norm() * h;
    for (std::size_t k = 0; k < problem.walls.size(); ++k) {
        const Wall& wall = problem.walls[k];
        const double approach = -wall.normal.dot(before);
        if ((touched >> k & 1) == 0 || approach <= slowest) continue;
        const double leave = wall.normal.dot(v);
        v += (std::max(leave, wall.restitution * approach) - leave) * wall.normal;
    }
}

HalfKickSubstep::HalfKickSubstep(const Problem& problem, double h, State& state)
    : problem_(problem), h_(h), state_(state), before_(state.x), touched_(state.x.size(), 0) {
    const Eigen::Vector3d fall = h * h / 2 * problem.gravity;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        if (problem.inverseMass[i] > 0) state.x[i] += h * state.v[i] + fall;
    }
    predicted_ = state.x;
}

void HalfKickSubstep::projectWalls() {
    if (problem_.walls.empty()) return;
    for (std::size_t i = 0; i < problem_.size(); ++i) {
        if (problem_.inverseMass[i] > 0)
            touched_[i] |= projectOntoWalls(problem_, i, before_[i], state_.x[i]);
    }
}

void HalfKickSubstep::finish() {
    const double kept = std::exp(-problem_.damping * h_);
    const Eigen::Vector3d halfKick = h_ / 2 * problem_.gravity;
    for (std::size_t i = 0; i < problem_.size(); ++i) {
        if (problem_.inverseMass[i] == 0) continue;
        const Eigen::Vector3d vBefore = state_.v[i];
        const Eigen::Vector3d mean = vBefore + halfKick + (state_.x[i] - predicted_[i]) / h_;
        state_.v[i] = kept * mean + halfKick;
        if (touched_[i] != 0) rebound(problem_, touched_[i], h_, vBefore, state_.v[i]);
    }
}

} // namespace sinew::sim::reference
