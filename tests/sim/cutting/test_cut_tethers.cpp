// Tests of tethers in cut sheets: those across a separating cut end, all others hold.
#include "sim/cutting/cut_body.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstdio>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;
constexpr std::uint32_t columns = 9, rows = 11;
constexpr int steps = 30;

// A very soft sheet that hangs by its two upper corners, carried by tethers.
Scene sheet() {
    Scene scene{.name = "sheet"};
    addCloth(scene, {.origin = {0, 1, 0},
                     .down = {0, -1, 0},
                     .size = {columns, rows},
                     .spacing = spacing,
                     .stretchCompliance = 1,
                     .shearCompliance = 1,
                     .tethers = 2,
                     .pinned = {0, columns - 1},
                     .isCuttable = true});
    return scene;
}

// A cut through the row below the middle, up to `reach` from the left.
test::Sweep levelCut(double reach) {
    return sweepOf({Vector3d(0, 1 - 5.5 * double{spacing}, 0), Vector3d::UnitY()}, reach);
}

// Distance by which the lowest row has fallen.
double fallOf(CutBody& body, int count) {
    body.runner().run(count);
    const std::vector<Vector3d> positions = body.runner().positions();
    double height = 0;
    for (std::uint32_t i = columns * (rows - 1); i < columns * rows; ++i) height += positions[i].y();
    return 1 - double{spacing} * (rows - 1) - height / columns;
}

const double freely = 0.5 * 9.81 * 0.5 * 0.5; // free fall in half a second

} // namespace

TEST(CutTethers, EndWhereACutPartsTheirEnds) {
    CutBody whole(sheet()), body(sheet());
    const double held = fallOf(whole, steps);
    EXPECT_EQ(body.cut(levelCut(1)).pieces, 2u);
    const double fallen = fallOf(body, steps - 1);
    std::printf("the lowest row came down by %.3f m, cut off by %.3f m (freely %.3f m)\n", held, fallen,
                freely);
    EXPECT_LT(held, 0.2 * freely);
    EXPECT_GT(fallen, 0.85 * freely);
}

// A slit leaves the sheet in one piece.
TEST(CutTethers, HoldWhereThePiecesStillHangTogether) {
    CutBody body(sheet());
    EXPECT_EQ(body.cut(levelCut(0.3)).pieces, 1u);
    EXPECT_LT(fallOf(body, steps - 1), 0.2 * freely);
}

TEST(CutTethers, HoldAgainWhenTheCutIsUndone) {
    CutBody body(sheet());
    const vk::Buffer uncut = body.runner().saveTopology();
    body.cut(levelCut(1));
    body.runner().loadTopology(uncut);
    EXPECT_LT(fallOf(body, steps - 1), 0.2 * freely);
}

// The part that was cut off continues to fall after loading the state, although another state came between.
TEST(CutTethers, AreInASavedState) {
    CutBody body(sheet());
    const test::Runner::Saved uncut = body.runner().save();
    body.cut(levelCut(1));
    const test::Runner::Saved cut = body.runner().save();
    body.runner().load(uncut);
    EXPECT_LT(fallOf(body, steps), 0.2 * freely);
    body.runner().load(cut);
    EXPECT_GT(fallOf(body, steps - 1), 0.85 * freely);
}

TEST(CutTethers, GoOnInAnotherSimulation) {
    CutBody body(sheet());
    body.cut(levelCut(1));
    CutBody next(sheet());
    next.runner().takeOver(body.runner());
    EXPECT_GT(fallOf(next, steps - 1), 0.85 * freely);
}

TEST(CutTethers, LeaveTheSameBitsInReversedOrder) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        CutBody body(sheet(), {.substeps = 2, .isReversed = isReversed});
        body.cut(levelCut(1));
        body.runner().run(3);
        hashes.push_back(body.runner().stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}
