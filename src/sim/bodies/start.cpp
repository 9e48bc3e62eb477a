// Sums in double, so that a body far from the origin spins about its true centre.
#include "sinew/start.hpp"

#include "sinew/colliders.hpp"
#include "sinew/inverse_masses.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim {

namespace {

Vec3 middleOf(const Scene& scene, const Body& body) {
    constexpr float far = INFINITY;
    Vec3 low{far, far, far}, high{-far, -far, -far};
    for (std::uint32_t i = 0; i < body.particleCount; ++i) {
        const Vec3& x = scene.particles[body.firstParticle + i].position;
        low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
        high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2, low.z + (high.z - low.z) / 2};
}

void turn(Scene& scene, const Body& body, const Quaternion& rotation) {
    const Vec3 middle = middleOf(scene, body);
    const Pose from{.position = middle}, to{.position = middle, .rotation = rotation};
    for (std::uint32_t i = 0; i < body.particleCount; ++i) {
        Vec3& x = scene.particles[body.firstParticle + i].position;
        x = toWorld(to, toLocal(from, x));
    }
}

struct Center {
    double mass = 0, x = 0, y = 0, z = 0;
};

Center centerOf(const Scene& scene, const Body& body, const std::vector<float>& inverseMass) {
    Center sum;
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
        if (inverseMass[i] == 0) continue;
        const Vec3& x = scene.particles[i].position;
        const double mass = 1 / double{inverseMass[i]};
        sum.mass += mass;
        sum.x += mass * double{x.x};
        sum.y += mass * double{x.y};
        sum.z += mass * double{x.z};
    }
    const double share = sum.mass > 0 ? 1 / sum.mass : 0;
    return {sum.mass, share * sum.x, share * sum.y, share * sum.z};
}

void setVelocities(Scene& scene, const Body& body, const Start& how, const std::vector<float>& inverseMass) {
    const Center center = centerOf(scene, body, inverseMass);
    const double wx = double{how.spin.x}, wy = double{how.spin.y}, wz = double{how.spin.z};
    const auto sum = [](float v, double turned) { return static_cast<float>(double{v} + turned); };
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
        if (inverseMass[i] == 0) continue;
        Particle& particle = scene.particles[i];
        const double x = double{particle.position.x} - center.x, y = double{particle.position.y} - center.y,
                     z = double{particle.position.z} - center.z;
        particle.velocity = {sum(how.velocity.x, wy * z - wz * y), sum(how.velocity.y, wz * x - wx * z),
                             sum(how.velocity.z, wx * y - wy * x)};
    }
}

bool isZero(const Vec3& v) {
    return v.x == 0 && v.y == 0 && v.z == 0;
}

} // namespace

void start(Scene& scene, std::size_t firstBody, const Start& how) {
    const bool moves = !isZero(how.velocity) || !isZero(how.spin);
    const bool turns = std::abs(how.rotation.w) < 1;
    if (!moves && !turns) return;
    const std::vector<float> inverseMass = inverseMasses(scene);
    for (std::size_t b = firstBody; b < scene.bodies.size(); ++b) {
        if (turns) turn(scene, scene.bodies[b], how.rotation);
        if (moves) setVelocities(scene, scene.bodies[b], how, inverseMass);
    }
}

} // namespace sinew::sim
