// Shapes built from ellipsoids, boxes and cylinders joined by smooth minima (polynomial, after Quilez).
#include "mesh/implicit_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::mesh {
namespace {

/// min(a, b), rounded where they are within `blend` of each other.
double smoothMin(double a, double b, double blend) {
    const double overlap = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - overlap * overlap * overlap * blend / 6;
}

double smoothMax(double a, double b, double blend) {
    return -smoothMin(-a, -b, blend);
}

/// Distance to an ellipsoid, to first order near its surface.
double ellipsoid(const Vector3& x, const Vector3& center, const Vector3& radii) {
    const Vector3 p = x - center;
    const double k0 = p.cwiseQuotient(radii).norm(), k1 = p.cwiseQuotient(radii.cwiseAbs2()).norm();
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

double capsule(const Vector3& x, const Vector3& from, const Vector3& to, double radius) {
    const double along = std::clamp((x - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    return (x - from - along * (to - from)).norm() - radius;
}

} // namespace

double organDistance(const Vector3& x) {
    const double right = ellipsoid(x, {-0.045, 0.005, 0.0}, {0.105, 0.068, 0.085});
    const double left = ellipsoid(x, {0.08, 0.02, 0.012}, {0.09, 0.036, 0.06});
    const double tail = ellipsoid(x, {-0.085, -0.035, 0.02}, {0.052, 0.058, 0.055});
    double body = smoothMin(smoothMin(right, left, 0.045), tail, 0.05);
    // The hollow for the stomach, and the groove of the ligament between the lobes.
    body = smoothMax(body, -ellipsoid(x, {0.05, -0.105, -0.01}, {0.12, 0.1, 0.11}), 0.03);
    body = smoothMax(body, -capsule(x, {0.03, -0.06, 0.078}, {0.042, 0.08, 0.062}, 0.014), 0.022);
    const double bladder = capsule(x, {-0.012, -0.036, 0.066}, {0.0, -0.024, 0.025}, 0.02);
    return smoothMin(body, bladder, 0.012);
}

double slabDistance(const Vector3& x) {
    constexpr double rounding = 0.012;
    const Vector3 outside = x.cwiseAbs() - (Vector3(0.15, 0.03, 0.1) - Vector3::Constant(rounding));
    const double box = outside.cwiseMax(0).norm() + std::min(outside.maxCoeff(), 0.0) - rounding;
    return smoothMax(box, 0.05 - std::hypot(x.x(), x.z()), 0.02);
}

} // namespace sinew::mesh
