// Hard case 27: a pyramid of forty rows of balls in a plane, each ball on two of the row below, stays at
// rest.
#include "sim/collision/contact_scenes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/substeps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

// The pyramid stands between two walls without friction, which keep the balls in the plane; a ball would
// otherwise fall off the ridge between two others. Balls in a row are a hundredth of a radius apart.
Scene pyramid(std::uint32_t rows, float friction) {
    Scene scene;
    scene.contacts.friction = friction;
    scene.planes = {{.friction = friction},
                    {.normal = {0, 0, 1}, .offset = -ballRadius},
                    {.normal = {0, 0, -1}, .offset = -ballRadius}};
    const float pitch = 2.01f * ballRadius;
    const float rise = std::sqrt(4 * ballRadius * ballRadius - pitch * pitch / 4);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t i = 0; i < rows - row; ++i)
            scene.particles.push_back(
                ballAt({(static_cast<float>(i) + 0.5f * static_cast<float>(row)) * pitch,
                        ballRadius + static_cast<float>(row) * rise, 0}));
    return scene;
}

struct Stood {
    double moved = 0;             // largest displacement of a ball [m]
    double kinetic = 0, late = 0; // maximum, and value at the end [J]
    std::uint64_t hash = 0;
};

Stood stand(const Scene& scene, const Settings& settings, int quarters) {
    Runner runner(scene, settings);
    const std::vector<Vector3d> start = runner.positions();
    Stood stood;
    for (int quarter = 0; quarter < quarters; ++quarter) {
        const Status status = runner.run(15);
        EXPECT_EQ(status.nonFinite + status.contactRoom + status.slowed, 0u);
        stood.late = kineticEnergy(scene, runner.velocities());
        stood.kinetic = std::max(stood.kinetic, stood.late);
    }
    const std::vector<Vector3d> x = runner.positions();
    for (std::size_t i = 0; i < x.size(); ++i) stood.moved = std::max(stood.moved, (x[i] - start[i]).norm());
    stood.hash = runner.stateHash();
    return stood;
}

} // namespace

TEST(HardContacts, Case27APyramidOfFortyRowsStandsForTenSeconds) {
    const Scene scene = pyramid(40, 0.5f);
    ASSERT_EQ(scene.particles.size(), 820u);
    const SubstepChoice choice = chooseSubsteps(scene, {});
    EXPECT_EQ(choice.reason, SubstepReason::contacts);
    const Stood stood = stand(scene, {}, 40);
    std::printf("%u substeps: moved %.2f mm at most, kinetic energy %.2g J at most, %.2g J at the end\n",
                choice.substeps, 1000 * stood.moved, stood.kinetic, stood.late);
    EXPECT_LE(stood.moved, 0.25 * double{ballRadius});
    EXPECT_LE(stood.late, 1e-3);
    for (const bool isReversed : {false, true})
        EXPECT_EQ(stand(scene, {.isReversed = isReversed}, 2).hash, stand(scene, {}, 2).hash);
}

TEST(HardContacts, Case27APyramidWithoutFrictionDoesNotStand) {
    EXPECT_GE(stand(pyramid(40, 0), {}, 8).moved, 10 * double{ballRadius});
}
