// Simple loops over arrays, as a careful programmer would write them for one core.
#include "sinew/sequential.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sinew::tools {

namespace {

using Vec4 = Sequential::Vec4;

float dot(const sim::Vec3& n, const Vec4& x) {
    return n.x * x[0] + n.y * x[1] + n.z * x[2];
}

std::vector<float> inverseMassesOf(const sim::Scene& scene) {
    std::vector<float> result;
    for (const sim::Particle& particle : scene.particles) result.push_back(particle.inverseMass);
    for (const sim::FixedConstraint& fixed : scene.fixed) result[fixed.particle] = 0;
    return result;
}

/// Constraints sorted by colour; each gets the smallest colour that neither of its ends has yet.
std::vector<sim::DistanceConstraint> colorOrdered(const std::vector<sim::DistanceConstraint>& constraints,
                                                  std::size_t particles) {
    std::vector<std::vector<bool>> used(particles);
    const auto isUsed = [&](std::uint32_t i, std::size_t color) {
        return color < used[i].size() && used[i][color];
    };
    std::vector<std::vector<sim::DistanceConstraint>> colors;
    for (const sim::DistanceConstraint& constraint : constraints) {
        std::size_t color = 0;
        while (isUsed(constraint.a, color) || isUsed(constraint.b, color)) ++color;
        for (const std::uint32_t end : {constraint.a, constraint.b}) {
            used[end].resize(std::max(used[end].size(), color + 1));
            used[end][color] = true;
        }
        colors.resize(std::max(colors.size(), color + 1));
        colors[color].push_back(constraint);
    }
    std::vector<sim::DistanceConstraint> ordered;
    for (const auto& color : colors) ordered.insert(ordered.end(), color.begin(), color.end());
    return ordered;
}

} // namespace

Sequential::Sequential(const sim::Scene& scene, const sim::Settings& settings, ConstraintOrder order)
    : planes_(scene.planes), gravity_(scene.gravity), h_(scene.dt / static_cast<float>(settings.substeps)),
      kept_(std::exp(-scene.damping * h_)), substeps_(settings.substeps), iterations_(settings.iterations) {
    const std::vector<float> w = inverseMassesOf(scene);
    for (std::size_t i = 0; i < w.size(); ++i) {
        const sim::Particle& p = scene.particles[i];
        const sim::Vec3 v = w[i] > 0 ? p.velocity : sim::Vec3{};
        x_.push_back({p.position.x, p.position.y, p.position.z, w[i]});
        v_.push_back({v.x, v.y, v.z, w[i]});
        contactOffset_.push_back(p.contactOffset);
    }
    before_ = predicted_ = x_;
    touched_.resize(x_.size());
    const auto constraints =
        order == ConstraintOrder::natural ? scene.distances : colorOrdered(scene.distances, w.size());
    for (const sim::DistanceConstraint& c : constraints) {
        if (w[c.a] == 0 && w[c.b] == 0) continue;
        const float alpha = c.compliance / (h_ * h_);
        rows_.push_back({c.a, c.b, c.restLength, alpha, 1 / (w[c.a] + w[c.b] + alpha), 0, w[c.a], w[c.b]});
    }
}

void Sequential::step() {
    for (std::uint32_t substep = 0; substep < substeps_; ++substep) {
        predict();
        for (std::uint32_t iteration = 0; iteration < iterations_; ++iteration) {
            sweep();
            if (!planes_.empty()) projectPlanes();
        }
        finish();
    }
}

void Sequential::predict() {
    const float half = h_ * h_ / 2;
    before_ = x_;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (x_[i][3] == 0) continue;
        x_[i][0] += h_ * v_[i][0] + half * gravity_.x;
        x_[i][1] += h_ * v_[i][1] + half * gravity_.y;
        x_[i][2] += h_ * v_[i][2] + half * gravity_.z;
    }
    predicted_ = x_;
    for (Row& row : rows_) row.lambda = 0;
    std::ranges::fill(touched_, 0u);
}

void Sequential::sweep() {
    for (Row& row : rows_) {
        Vec4 &a = x_[row.a], &b = x_[row.b];
        const float dx = b[0] - a[0], dy = b[1] - a[1], dz = b[2] - a[2];
        const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
        if (length == 0) continue; // no direction, no correction
        const float change = -(length - row.restLength + row.alpha * row.lambda) * row.inverseDenominator;
        row.lambda += change;
        const float scale = change / length, toA = scale * row.inverseMassA, toB = scale * row.inverseMassB;
        a[0] -= toA * dx, a[1] -= toA * dy, a[2] -= toA * dz;
        b[0] += toB * dx, b[1] += toB * dy, b[2] += toB * dz;
    }
}

void Sequential::projectPlanes() {
    for (std::size_t i = 0; i < x_.size(); ++i) {
        Vec4& x = x_[i];
        if (x[3] == 0) continue;
        for (std::size_t k = 0; k < planes_.size(); ++k) {
            const sim::Plane& plane = planes_[k];
            const sim::Vec3& n = plane.normal;
            const float depth = plane.offset + contactOffset_[i] - dot(n, x);
            if (depth <= 0) continue;
            Vec4 slid{x[0] - before_[i][0], x[1] - before_[i][1], x[2] - before_[i][2], 0};
            const float along = dot(n, slid);
            slid = {slid[0] - along * n.x, slid[1] - along * n.y, slid[2] - along * n.z, 0};
            const float length = std::sqrt(slid[0] * slid[0] + slid[1] * slid[1] + slid[2] * slid[2]);
            // Coulomb friction: undoes the substep's tangential motion, up to friction times depth.
            const float reach = plane.friction * depth, back = length <= reach ? 1 : reach / length;
            x[0] += depth * n.x - back * slid[0];
            x[1] += depth * n.y - back * slid[1];
            x[2] += depth * n.z - back * slid[2];
            touched_[i] |= 1u << k;
        }
    }
}

void Sequential::finish() {
    const Vec4 halfKick{h_ / 2 * gravity_.x, h_ / 2 * gravity_.y, h_ / 2 * gravity_.z, 0};
    const float slowest =
        2 * h_ * std::sqrt(gravity_.x * gravity_.x + gravity_.y * gravity_.y + gravity_.z * gravity_.z);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (x_[i][3] == 0) continue;
        const Vec4 old = v_[i];
        for (std::size_t axis = 0; axis < 3; ++axis)
            v_[i][axis] = kept_ * (old[axis] + halfKick[axis] + (x_[i][axis] - predicted_[i][axis]) / h_) +
                          halfKick[axis];
        for (std::uint32_t rest = touched_[i]; rest != 0; rest &= rest - 1) {
            const sim::Plane& plane = planes_[static_cast<std::size_t>(std::countr_zero(rest))];
            const float approach = -dot(plane.normal, old);
            if (approach <= slowest) continue;
            const float leave = dot(plane.normal, v_[i]);
            const float change = std::max(leave, plane.restitution * approach) - leave;
            v_[i][0] += change * plane.normal.x;
            v_[i][1] += change * plane.normal.y;
            v_[i][2] += change * plane.normal.z;
        }
    }
}

const char* sequentialFlags() {
    return SINEW_SEQUENTIAL_FLAGS;
}

} // namespace sinew::tools
