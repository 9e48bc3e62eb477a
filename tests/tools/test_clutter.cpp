// Tests the CPU programs with which `sinew bench --scene clutter` compares the device: they must solve the
// same problem.
#include "sinew/clutter/jacobi.hpp"
#include "sinew/clutter/sequential.hpp"
#include "sinew/overlap.hpp"

#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::tools;

namespace {

constexpr float radius = 0.05f;

sim::Scene clutterOf(std::uint32_t side) {
    sim::Scene scene;
    const float half = 0.055f * static_cast<float>(side) + 0.02f;
    sim::addParticles(
        scene,
        {.center = {0, half + 0.2f, 0}, .count = {side, side, side}, .jitter = 0.005f, .radius = radius});
    scene.contacts.friction = 0.3f;
    scene.planes = {{.friction = 0.3f},
                    {.normal = {1, 0, 0}, .offset = -half, .friction = 0.3f},
                    {.normal = {-1, 0, 0}, .offset = -half, .friction = 0.3f},
                    {.normal = {0, 0, 1}, .offset = -half, .friction = 0.3f},
                    {.normal = {0, 0, -1}, .offset = -half, .friction = 0.3f}};
    return scene;
}

State stateOf(const clutter::Balls& balls) {
    return {balls.x, balls.v};
}

double deepestBehindAPlane(const sim::Scene& scene, const State& state) {
    sim::Scene planes = scene;
    for (sim::Particle& particle : planes.particles) particle.radius = 0;
    return measure(planes, state, {}, 0).penetrationMax.value();
}

double meanSpeed(const State& state) {
    double sum = 0;
    for (const auto& v : state.velocities) sum += std::hypot(double{v[0]}, double{v[1]}, double{v[2]});
    return sum / static_cast<double>(state.velocities.size());
}

double meanHeight(const State& state) {
    double sum = 0;
    for (const auto& x : state.positions) sum += double{x[1]};
    return sum / static_cast<double>(state.positions.size());
}

template <typename Program> State after(Program& program, int steps) {
    for (int i = 0; i < steps; ++i) program.step();
    return stateOf(program.balls());
}

/// Expects five layers of balls at rest in a box that they fill, with overlaps up to `deep` [m].
void expectSettled(const sim::Scene& scene, const State& state, double deep) {
    EXPECT_LE(overlapOf(scene, state)->max, deep);
    EXPECT_LE(deepestBehindAPlane(scene, state), deep);
    EXPECT_GE(meanHeight(state), 0.2) << "half of what five layers of touching balls are high, at least";
    EXPECT_LE(meanHeight(state), 0.3);
    EXPECT_LE(meanSpeed(state), 0.05);
}

} // namespace

TEST(SequentialClutter, ComesToRestInItsBox) {
    const sim::Scene scene = clutterOf(5);
    clutter::Sequential program(clutter::ballsOf(scene, 16, 1));
    expectSettled(scene, after(program, 180), 0.1 * double{radius});
}

TEST(SequentialClutter, FallsFreelyUntilItTouches) {
    const sim::Scene scene = clutterOf(3);
    clutter::Sequential program(clutter::ballsOf(scene, 16, 1));
    const double start = meanHeight(stateOf(program.balls()));
    const double t = 5.0 / 60;
    EXPECT_NEAR(meanHeight(after(program, 5)), start - 9.81 * t * t / 2 * (1 + 1.0 / (5 * 16)), 1e-5);
}

TEST(NativeJacobi, ComesToRestInItsBox) {
    const sim::Scene scene = clutterOf(5);
    clutter::Jacobi program(clutter::ballsOf(scene, 4, 5));
    expectSettled(scene, after(program, 180), 0.4 * double{radius});
}

TEST(NativeJacobi, EndsInTheSameBitsWhicheverThreadIsFaster) {
    const sim::Scene scene = clutterOf(5);
    clutter::Jacobi first(clutter::ballsOf(scene, 4, 5)), second(clutter::ballsOf(scene, 4, 5));
    EXPECT_EQ(stateHash(after(first, 60)), stateHash(after(second, 60)));
}

TEST(Clutter, IsOfLooseParticlesOfOneRadius) {
    sim::Scene scene = clutterOf(3);
    EXPECT_EQ(clutter::ballsOf(scene, 4, 5).x.size(), 27u);
    scene.particles[4].radius = 0.01f;
    EXPECT_THROW(clutter::ballsOf(scene, 4, 5), std::invalid_argument);
    sim::Scene body;
    sim::addLattice(body, {.cells = {2, 2, 2}, .radius = 0.05f});
    EXPECT_THROW(clutter::ballsOf(body, 4, 5), std::invalid_argument);
}
