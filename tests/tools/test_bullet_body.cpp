// Tests that Bullet simulates the same scene, without which the comparison would be invalid.
#include "sinew/bullet_body.hpp"

#include "scenes/load.hpp"
#include "sim/reference/trajectory.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

using namespace sinew;
using tools::BulletBody;

namespace {

/// RMS distance over some frames from the exact motion [body sizes].
double errorOf(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations) {
    constexpr std::uint32_t frames = 12;
    const auto truth = sim::reference::trueTrajectory(scene, {.frames = frames, .dt = double{scene.dt}});
    BulletBody body(scene, substeps, iterations);
    double squares = 0;
    for (std::uint32_t f = 0; f < frames; ++f) {
        body.step();
        const std::vector<Eigen::Vector3d> x = body.positions();
        for (std::size_t i = 0; i < x.size(); ++i) squares += (x[i] - truth.frames[f][i]).squaredNorm();
    }
    return std::sqrt(squares / (frames * static_cast<double>(scene.particles.size()))) /
           sim::reference::bodySize(scene);
}

/// A mass on a spring, with a mean position m g c below its rest length.
sim::Scene spring(float compliance) {
    sim::Scene scene;
    sim::addChain(scene, {.particles = 2, .length = 1, .mass = 2, .compliance = compliance, .pinned = {0}});
    return scene;
}

} // namespace

TEST(BulletBody, FallsAsItsOwnIntegratorDoes) {
    sim::Scene scene;
    scene.particles.push_back({.position = {1, 2, 3}, .velocity = {}, .inverseMass = 0.5f});
    BulletBody body(scene, 4, 1);
    body.step();
    const double h = double{scene.dt} / 4;
    EXPECT_NEAR(body.positions()[0].y(), 2 - 9.81 * h * h * (1 + 2 + 3 + 4), 1e-6);
    EXPECT_EQ(body.positions()[0].x(), 1);
}

TEST(BulletBody, HasTheStiffnessOfTheSceneWhateverTheSubstepsAndIterations) {
    // 1 kg on 1000 N/m swings about 9.81 mm below its rest length, down to twice as far. The strain is small,
    // because Bullet's law of a link, (l^2 - L^2) / (l^2 + L^2), equals ours only for small strains (8 %
    // stiffer at 20 %).
    const sim::Scene scene = spring(0.001f);
    for (const auto& [substeps, iterations] : {std::pair{64u, 1u}, std::pair{256u, 1u}, std::pair{64u, 4u}}) {
        BulletBody body(scene, substeps, iterations);
        double lowest = 0;
        for (int frame = 0; frame < 40; ++frame) {
            body.step();
            EXPECT_EQ(body.positions()[0].norm(), 0) << "the pinned end";
            lowest = std::min(lowest, body.positions()[1].y() + 1);
        }
        EXPECT_NEAR(lowest, -2 * 0.00981, 0.03 * 2 * 0.00981) << substeps << " x " << iterations;
    }
}

TEST(BulletBody, ApproachesTheTrueMotionWithMoreSubsteps) {
    const sim::Scene beam = scenes::loadBuiltIn("beam").scene;
    const double coarse = errorOf(beam, 16, 1), fine = errorOf(beam, 128, 1);
    EXPECT_LT(fine, 0.01);
    EXPECT_LT(fine, coarse / 4);
}

TEST(BulletBody, IsMovedByNothingWhereEverythingIsHeld) {
    sim::Scene scene = spring(0.01f);
    scene.fixed.push_back({1});
    BulletBody body(scene, 8, 2);
    body.step();
    EXPECT_EQ(body.positions()[1].y(), -1);
}
