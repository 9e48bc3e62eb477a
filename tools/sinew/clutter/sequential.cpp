// Simple loops over arrays, as a careful programmer would write them for one core.
#include "sinew/clutter/sequential.hpp"

#include <stdexcept>

namespace sinew::tools::clutter {

Balls ballsOf(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations) {
    Balls balls{.friction = scene.contacts.friction,
                .planes = scene.planes,
                .gravity = scene.gravity,
                .dt = scene.dt,
                .substeps = substeps,
                .iterations = iterations};
    const bool isLoose = scene.distances.empty() && scene.bends.empty() && scene.fixed.empty() &&
                         scene.attachments.empty() && !scene.particles.empty();
    if (isLoose) balls.radius = scene.particles[0].radius;
    for (const sim::Particle& p : scene.particles) {
        if (!isLoose || p.radius != balls.radius || !(p.radius > 0) || !(p.inverseMass > 0))
            throw std::invalid_argument("only loose particles of one radius can be a clutter");
        balls.x.push_back({p.position.x, p.position.y, p.position.z, p.inverseMass});
        balls.v.push_back({p.velocity.x, p.velocity.y, p.velocity.z, p.inverseMass});
    }
    return balls;
}

Sequential::Sequential(Balls balls)
    : balls_(std::move(balls)), before_(balls_.x), predicted_(balls_.x), margin_(0.5f * balls_.radius) {}

void Sequential::step() {
    for (std::uint32_t substep = 0; substep < balls_.substeps; ++substep) {
        predict();
        list();
        for (std::uint32_t iteration = 0; iteration < balls_.iterations; ++iteration) sweep();
        finish();
    }
}

void Sequential::predict() {
    const float h = balls_.h();
    before_ = balls_.x;
    for (std::size_t i = 0; i < before_.size(); ++i) {
        Vec4 &x = balls_.x[i], &v = balls_.v[i];
        v[0] += h * balls_.gravity.x, v[1] += h * balls_.gravity.y, v[2] += h * balls_.gravity.z;
        x[0] += h * v[0], x[1] += h * v[1], x[2] += h * v[2];
    }
    predicted_ = balls_.x;
}

// Lists the pairs again once a ball may have moved by half of the margin since the last list.
void Sequential::list() {
    float most = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
        const Vec4 &a = listed_[i], &b = balls_.x[i];
        const float dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
        most = std::max(most, dx * dx + dy * dy + dz * dz);
    }
    if (!listed_.empty() && most < margin_ * margin_ / 4) return;
    const float reach = 2 * balls_.radius + margin_;
    listed_ = balls_.x;
    grid_.sort(listed_, reach);
    pairs_.clear();
    for (std::uint32_t i = 0; i < listed_.size(); ++i)
        grid_.forEachNear(i, [&](std::uint32_t j) {
            if (j <= i) return;
            const Vec4 &a = listed_[i], &b = listed_[j];
            const float dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
            if (dx * dx + dy * dy + dz * dz < reach * reach) pairs_.push_back({i, j});
        });
}

void Sequential::sweep() {
    const float touching = 2 * balls_.radius;
    for (const auto& [i, j] : pairs_) {
        Vec4 &a = balls_.x[i], &b = balls_.x[j];
        const float dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
        const float square = dx * dx + dy * dy + dz * dz;
        if (square >= touching * touching || square == 0) continue;
        const float length = std::sqrt(square), depth = touching - length, inverse = 1 / length;
        const float nx = dx * inverse, ny = dy * inverse, nz = dz * inverse;
        // Coulomb friction: undoes the pair's slip of this substep, up to friction times depth.
        const Vec4 &oldA = before_[i], &oldB = before_[j];
        float sx = a[0] - oldA[0] - b[0] + oldB[0], sy = a[1] - oldA[1] - b[1] + oldB[1],
              sz = a[2] - oldA[2] - b[2] + oldB[2];
        const float along = sx * nx + sy * ny + sz * nz;
        sx -= along * nx, sy -= along * ny, sz -= along * nz;
        const float reach = balls_.friction * depth, slid = sx * sx + sy * sy + sz * sz;
        const float back = slid <= reach * reach ? 1 : reach / std::sqrt(slid);
        const float share = 1 / (a[3] + b[3]), ofA = a[3] * share, ofB = b[3] * share;
        const float cx = depth * nx - back * sx, cy = depth * ny - back * sy, cz = depth * nz - back * sz;
        a[0] += ofA * cx, a[1] += ofA * cy, a[2] += ofA * cz;
        b[0] -= ofB * cx, b[1] -= ofB * cy, b[2] -= ofB * cz;
    }
    for (std::size_t i = 0; i < balls_.x.size(); ++i) projectPlanes(balls_, balls_.x[i], before_[i]);
}

// Velocities from corrections only: in float, differences of positions drift.
void Sequential::finish() {
    const float perSecond = 1 / balls_.h();
    for (std::size_t i = 0; i < before_.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            balls_.v[i][axis] += (balls_.x[i][axis] - predicted_[i][axis]) * perSecond;
}

} // namespace sinew::tools::clutter
