// All balls have one radius, so every pair has the same reach.
#include "sim/collision/contact_scenes.hpp"

#include <algorithm>
#include <random>

namespace sinew::test {

using namespace sim;
using Eigen::Vector3d;

Particle ballAt(const Vec3& position, const Vec3& velocity, float mass) {
    return {.position = position,
            .velocity = velocity,
            .inverseMass = 1 / mass,
            .contactOffset = ballRadius,
            .radius = ballRadius};
}

Particle fixedBallAt(const Vec3& position) {
    Particle ball = ballAt(position);
    ball.inverseMass = 0;
    return ball;
}

Scene weightless() {
    Scene scene;
    scene.gravity = {};
    return scene;
}

void addBalls(Scene& scene, std::uint32_t side, float pitch, float off, const Vec3& center) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> offset(-off, off);
    const auto at = [&](std::uint32_t index) {
        return (static_cast<float>(index) - 0.5f * static_cast<float>(side - 1)) * pitch + offset(random);
    };
    for (std::uint32_t i = 0; i < side * side * side; ++i) {
        const float x = at(i % side), y = at(i / side / side), z = at(i / side % side);
        scene.particles.push_back(ballAt({center.x + x, center.y + y, center.z + z}));
    }
}

double deepestOf(const std::vector<Vector3d>& x) {
    const double reach = 2 * double{ballRadius};
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if ((x[i] - x[j]).squaredNorm() < reach * reach)
                most = std::max(most, (reach - (x[i] - x[j]).norm()) / double{ballRadius});
    return most;
}

Vector3d momentumOf(const Scene& scene, const std::vector<Vector3d>& v) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < v.size(); ++i)
        if (scene.particles[i].inverseMass > 0) sum += v[i] / double{scene.particles[i].inverseMass};
    return sum;
}

} // namespace sinew::test
