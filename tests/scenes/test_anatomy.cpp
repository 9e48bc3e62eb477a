// Tests an anatomy-like scene: an organ of coarse voxels inside a finely meshed wall that touches it all
// around.
#include "scenes/load.hpp"
#include "sim/runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

using namespace sinew;

namespace {

scenes::LoadedScene organInWall(const std::string& restContact) {
    scenes::LoadedScene loaded =
        scenes::loadText("gravity = [0, 0, 0]\n[solver]\nsubsteps = 4\n"
                         "[contacts]\nfriction = 0.2\nroom = 64\nrest_contact = \"" +
                             restContact +
                             "\"\n[[mesh]]\ngenerate = \"organ\"\nsize = 0.1\nvoxel = 0.005\n"
                             "young_modulus = 2e4\ncollides = true\n"
                             "[[mesh_collider]]\ngenerate = \"organ\"\ndetail = 85\nsize = 0.108\n"
                             "thickness = 0.0005\n",
                         "wall.toml");
    EXPECT_GE(loaded.scene.faces.size(), 30000u);
    return loaded;
}

// Largest displacement of a particle over some steps [radii].
double wayIn(const scenes::LoadedScene& loaded, int steps) {
    test::Runner runner(loaded.scene, loaded.settings);
    const sim::Status status = runner.run(steps);
    EXPECT_EQ(status.nonFinite + status.contactRoom, 0u);
    const auto x = runner.positions();
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const sim::Vec3& p = loaded.scene.particles[i].position;
        most = std::max(most, (x[i] - Eigen::Vector3d(double{p.x}, double{p.y}, double{p.z})).norm());
    }
    return most / double{loaded.scene.particles[0].radius};
}

} // namespace

TEST(AnOrganInAWall, StaysAsItWasPlacedOrPartsAsTheSceneSays) {
    const double kept = wayIn(organInWall("keep"), 6), parted = wayIn(organInWall("part"), 2);
    std::printf("an organ in a wall goes by %.1e radii where it keeps, %.2f where it parts\n", kept, parted);
    EXPECT_LT(kept, 1e-4);
    EXPECT_GT(parted, 0.1);
}
