// Tests that cuttable bodies have contacts by default: a horizontally cut organ rests on its own lower half.
#include "scenes/load.hpp"
#include "sim/cutting/cut_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr float voxel = 0.025f; // [m]

struct Halves {
    std::vector<std::size_t> upper, lower;
};

double middle(const std::vector<Vector3d>& x, const std::vector<std::size_t>& part) {
    double sum = 0;
    for (const std::size_t i : part) sum += x[i].y();
    return sum / static_cast<double>(part.size());
}

double nearest(const std::vector<Vector3d>& x, const Halves& halves) {
    double least = std::numeric_limits<double>::max();
    for (const std::size_t i : halves.upper)
        for (const std::size_t j : halves.lower) least = std::min(least, (x[i] - x[j]).norm());
    return least;
}

// The shipped organ at rest on the floor, cut by a horizontal plane through its middle.
struct CutOrgan {
    scenes::LoadedScene loaded;
    std::unique_ptr<test::CutBody> body;
    Halves halves;
};

CutOrgan cutFlat(const std::string& contacts) {
    scenes::Overrides overrides;
    overrides.voxel = voxel;
    CutOrgan cut{.loaded = scenes::loadText(
                     "[[mesh]]\nname = \"organ\"\ngenerate = \"organ\"\ndetail = 49\nsize = 0.4\n"
                     "center = [0, 0.14, 0]\nyoung_modulus = 2e5\ncuttable = true\n" +
                         contacts + "[[plane]]\nfriction = 0.4\n[contacts]\nfriction = 0.3\n",
                     "organ.toml", overrides),
                 .body = nullptr,
                 .halves = {}};
    cut.loaded.scene.damping = 2;
    cut.loaded.settings.contactRoom = 160;
    cut.body = std::make_unique<test::CutBody>(cut.loaded.scene, cut.loaded.settings);
    EXPECT_EQ(cut.body->runner().run(90).contactRoom, 0u);
    double low = 1e9, high = -1e9;
    for (const Vector3d& x : cut.body->runner().positions()) {
        low = std::min(low, x.y());
        high = std::max(high, x.y());
    }
    const test::CutPlane plane{{0, (low + high) / 2 + 0.003, 0}, {0, 1, 0}};
    const sim::Status status = cut.body->cut(test::sweepOf(plane, 1));
    EXPECT_GE(status.pieces, 2u);
    const auto x = cut.body->runner().positions();
    for (std::size_t i = 0; i < x.size(); ++i)
        (x[i].y() > plane.point.y() ? cut.halves.upper : cut.halves.lower).push_back(i);
    return cut;
}

} // namespace

TEST(AnOrganCutFlat, LiesOnItsOtherHalf) {
    CutOrgan cut = cutFlat("");
    EXPECT_GT(cut.loaded.scene.particles[0].radius, 0) << "what is cuttable collides by default";
    test::Runner& runner = cut.body->runner();
    const auto start = runner.positions();
    const double upper = middle(start, cut.halves.upper), lower = middle(start, cut.halves.lower);
    double least = 1;
    for (int frame = 0; frame < 300; ++frame) {
        const sim::Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u) << frame;
        if (frame % 30 == 29) least = std::min(least, nearest(runner.positions(), cut.halves));
    }
    const auto x = runner.positions();
    const double gap = middle(x, cut.halves.upper) - middle(x, cut.halves.lower);
    std::printf(
        "upper half (%zu) from %.4f to %.4f m, lower (%zu) from %.4f to %.4f m; nearest %.3f voxels\n",
        cut.halves.upper.size(), upper, middle(x, cut.halves.upper), cut.halves.lower.size(), lower,
        middle(x, cut.halves.lower), least / double{voxel});
    EXPECT_NEAR(gap, upper - lower, 0.5 * double{voxel});
    // In the middle of a cell of the other half, the distance would be 0.87 voxels.
    EXPECT_GT(least, 0.93 * double{voxel}) << "no particle of one is inside of the other";
}

TEST(AnOrganCutFlat, FallsThroughItselfWithoutContacts) {
    CutOrgan cut = cutFlat("collides = false\n");
    EXPECT_EQ(cut.loaded.scene.particles[0].radius, 0);
    test::Runner& runner = cut.body->runner();
    const double upper = middle(runner.positions(), cut.halves.upper);
    runner.run(60);
    EXPECT_LT(middle(runner.positions(), cut.halves.upper), upper - double{voxel});
}
