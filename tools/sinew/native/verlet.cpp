// Two arrays of positions alternate, so that a substep has one barrier. Forces of a tile stay in the cache.
#include "sinew/native/verlet.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sinew::tools::native {

namespace {

constexpr std::size_t tileSize = 512; // particles

template <typename Real> std::vector<Real> inverseMassesOf(const sim::Scene& scene) {
    std::vector<Real> result;
    for (const sim::Particle& particle : scene.particles)
        result.push_back(static_cast<Real>(particle.inverseMass));
    for (const sim::FixedConstraint& fixed : scene.fixed) result[fixed.particle] = 0;
    return result;
}

} // namespace

template <typename Real>
Verlet<Real>::Verlet(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t threads)
    : inverseMass_(inverseMassesOf<Real>(scene)), substeps_(substeps), threads_(threads), turn_(threads) {
    h_ = static_cast<Real>(double{scene.dt} / substeps);
    gravity_ = {static_cast<Real>(scene.gravity.x), static_cast<Real>(scene.gravity.y),
                static_cast<Real>(scene.gravity.z)};
    for (std::size_t i = 0; i < size(); ++i) {
        const sim::Particle& p = scene.particles[i];
        const sim::Vec3 v = inverseMass_[i] > 0 ? p.velocity : sim::Vec3{};
        const float x[] = {p.position.x, p.position.y, p.position.z}, speed[] = {v.x, v.y, v.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            x_[axis].push_back(static_cast<Real>(x[axis]));
            v_[axis].push_back(static_cast<Real>(speed[axis]));
        }
    }
    other_ = x_;
    group(scene);
    for (std::uint32_t thread = 1; thread < threads_; ++thread)
        helpers_.emplace_back([this, thread] {
            for (;;) {
                turn_.arrive_and_wait();
                if (isEnding_) return;
                work(thread);
            }
        });
}

template <typename Real> Verlet<Real>::~Verlet() {
    isEnding_ = true;
    turn_.arrive_and_wait();
    for (std::thread& helper : helpers_) helper.join();
}

/// Sorts both ends of every link into runs.
template <typename Real> void Verlet<Real>::group(const sim::Scene& scene) {
    struct End {
        std::uint32_t own = 0;
        std::int32_t offset = 0;
        float rest = 0, compliance = 0;
        auto key() const { return std::tuple(own / tileSize, offset, rest, compliance, own); }
    };
    std::vector<End> ends;
    for (const sim::DistanceConstraint& c : scene.distances) {
        const auto offset = static_cast<std::int32_t>(c.b) - static_cast<std::int32_t>(c.a);
        if (inverseMass_[c.a] > 0) ends.push_back({c.a, offset, c.restLength, c.compliance});
        if (inverseMass_[c.b] > 0) ends.push_back({c.b, -offset, c.restLength, c.compliance});
    }
    std::ranges::sort(ends, {}, &End::key);
    firstRun_.assign((size() + tileSize - 1) / tileSize + 1, 0);
    const End* before = nullptr;
    for (const End& end : ends) {
        const bool goesOn = before && before->own + 1 == end.own &&
                            before->own / tileSize == end.own / tileSize && before->offset == end.offset &&
                            before->rest == end.rest && before->compliance == end.compliance;
        if (goesOn)
            ++runs_.back().count;
        else {
            runs_.push_back({end.own, 1, end.offset, static_cast<Real>(end.rest),
                             static_cast<Real>(1 / double{end.compliance})});
            ++firstRun_[end.own / tileSize + 1];
        }
        before = &end;
    }
    for (std::size_t tile = 1; tile < firstRun_.size(); ++tile) firstRun_[tile] += firstRun_[tile - 1];
}

template <typename Real> void Verlet<Real>::step() {
    turn_.arrive_and_wait();
    work(0);
}

// One thread's part of a step.
template <typename Real> void Verlet<Real>::work(std::uint32_t thread) {
    const std::size_t tiles = firstRun_.size() - 1;
    const std::size_t first = tiles * thread / threads_, end = tiles * (thread + 1) / threads_;
    for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
        const bool isEven = substep % 2 == 0;
        const Real kick = isStart_ && substep == 0 ? h_ / 2 : h_;
        for (std::size_t tile = first; tile < end; ++tile)
            advance(tile, isEven ? x_ : other_, isEven ? other_ : x_, kick);
        turn_.arrive_and_wait();
    }
    if (thread == 0) {
        isStart_ = false;
        if (substeps_ % 2 == 1) x_.swap(other_);
    }
    turn_.arrive_and_wait();
}

template <typename Real> void Verlet<Real>::advance(std::size_t tile, const Axes& from, Axes& to, Real kick) {
    const std::size_t first = tile * tileSize, count = std::min(tileSize, size() - first);
    Real force[3][tileSize] = {};
    for (std::uint32_t r = firstRun_[tile]; r < firstRun_[tile + 1]; ++r) {
        const Run& run = runs_[r];
        const Real* __restrict ax = &from[0][run.first], * __restrict ay = &from[1][run.first], * __restrict az = &from[2][run.first];
        const Real* __restrict bx = ax + run.offset, * __restrict by = ay + run.offset, * __restrict bz = az + run.offset;
        const std::size_t at = run.first - first;
        Real* __restrict fx = force[0] + at, * __restrict fy = force[1] + at, * __restrict fz = force[2] + at;
        const Real k = run.stiffness, rest = run.rest;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const Real dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
            const Real square = dx * dx + dy * dy + dz * dz + Real(1e-30); // ends in one place: no direction
            const Real pull = k * (1 - rest / std::sqrt(square));
            fx[i] += pull * dx;
            fy[i] += pull * dy;
            fz[i] += pull * dz;
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real* __restrict x = &from[axis][first];
        const Real* __restrict w = &inverseMass_[first];
        Real* __restrict next = &to[axis][first], * __restrict v = &v_[axis][first];
        const Real g = gravity_[axis];
        for (std::size_t i = 0; i < count; ++i) {
            v[i] += kick * (w[i] * force[axis][i] + (w[i] > 0 ? g : 0));
            next[i] = x[i] + h_ * v[i];
        }
    }
}

template <typename Real> std::array<double, 3> Verlet<Real>::position(std::size_t particle) const {
    return {double{x_[0][particle]}, double{x_[1][particle]}, double{x_[2][particle]}};
}

template class Verlet<float>;
template class Verlet<double>;

} // namespace sinew::tools::native
