#include "sim/collision/rest_checks.hpp"

#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace sinew::test {

using namespace sim;
using Eigen::Vector3d;

double moved(const std::vector<Vector3d>& x, const Scene& scene) {
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3& p = scene.particles[i].position;
        most = std::max(most, (x[i] - Vector3d(double{p.x}, double{p.y}, double{p.z})).norm());
    }
    return most;
}

void expectStill(const Scene& scene, const Settings& settings, double radius, int steps,
                 const std::string& what) {
    Scene untouched = scene;
    untouched.faces.clear();
    for (Particle& particle : untouched.particles) particle.radius = 0;
    Runner runner(scene, settings), alone(untouched, settings);
    const Status status = runner.run(steps);
    alone.run(steps);
    EXPECT_EQ(status.nonFinite + status.contactRoom, 0u) << what;
    const auto x = runner.positions(), x0 = alone.positions();
    double way = 0;
    for (std::size_t i = 0; i < x.size(); ++i) way = std::max(way, (x[i] - x0[i]).norm() / radius);
    const double energy = kineticEnergy(scene, runner.velocities()),
                 energyAlone = kineticEnergy(scene, alone.velocities());
    std::printf("%s: off by %.2e radii after %d steps (%.2e moved alone), %.1e J (%.1e J)\n", what.c_str(),
                way, steps, moved(x0, scene) / radius, energy, energyAlone);
    EXPECT_LT(way, 1e-4) << what;
    EXPECT_LE(energy, 1.1 * energyAlone + 1e-12) << what << " [J]";
}

void expectRemembered(const Scene& scene, const Settings& settings, int steps) {
    Runner plain(scene, settings);
    plain.run(2 * steps);
    const std::uint64_t hash = plain.stateHash();

    Runner undone(scene, settings);
    undone.run(steps - 1);
    undone.writePosition(3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(undone.run(1).nonFinite, 0u);
    undone.run(steps + 1);
    EXPECT_EQ(undone.stateHash(), hash) << "an undone step";

    Runner saved(scene, settings);
    saved.run(steps);
    const Runner::Saved state = saved.save();
    saved.run(steps / 2);
    saved.load(state);
    saved.run(steps);
    EXPECT_EQ(saved.stateHash(), hash) << "a saved state";

    Runner first(scene, settings);
    first.run(steps);
    Settings roomy = settings;
    roomy.contactRoom = 80;
    Runner larger(scene, roomy);
    larger.takeOver(first);
    larger.run(steps);
    EXPECT_EQ(larger.stateHash(), hash) << "more room";
    larger.reset();
    larger.run(2 * steps);
    EXPECT_EQ(larger.stateHash(), hash) << "a reset";
}

} // namespace sinew::test
