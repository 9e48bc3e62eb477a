// Parts come and go while a simulation runs. The others have the bits that they have in a world without them.
#include "sim/surface/split_skins.hpp"
#include "sim/world_play.hpp"

using namespace sinew;
using namespace sinew::sim;
using test::box, test::ground, test::Play, test::slidingBoxes, test::stranger, test::Words;

namespace {

// A sheet that falls on a box.
Scene drapedSheet() {
    Scene scene = box({0, 0.02f, 0}, {4, 2, 4});
    addSurfaceFaces(scene, scene.grids[0]);
    addCloth(scene, {.origin = {-0.1f, 0.16f, -0.1f},
                     .size = {12, 12},
                     .spacing = 0.035f,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-4f,
                     .thickness = 0.01f});
    return scene;
}

Scene chain() {
    Scene scene;
    addChain(scene, {.origin = {0, 0.5f, 0}, .direction = {1, 0, 0}, .particles = 20, .pinned = {0}});
    scene.attachments.push_back({.particle = 19, .anchor = {1, 0.5f, 0}, .compliance = 1e-3f});
    return scene;
}

struct Kind {
    const char* name;
    Scene part;
    Settings settings;
};

std::vector<Kind> kinds() {
    const Settings settings{.substeps = 6, .contactRoom = 64};
    Settings forces = settings;
    forces.keepsForces = true;
    Settings levels = settings;
    levels.levels = 2;
    return {{"boxes", slidingBoxes(), settings},
            {"sheet", drapedSheet(), settings},
            {"chain", chain(), settings},
            {"forces", slidingBoxes(), forces},
            {"levels", slidingBoxes(), levels},
            {"jacobi", chain(), {.solver = Solver::jacobi, .substeps = 4, .iterations = 3}}};
}

} // namespace

// Sums over a scene, such as the unit of integer sums, depend on all of its bodies: both worlds always have
// the same ones. In one of them a stranger is exchanged for another, so that all that comes after it moves to
// other indices.
TEST(World, GoesOnWithTheSameBitsWhenOthersComeAndGo) {
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        const bool touches = kind.settings.solver == Solver::split;
        Scene base = touches ? ground() : Scene{};
        const Scene other = box({40, 0.3f, 0}, {3, 2, 4}, touches ? 0.02f : 0);
        Play alone(base, kind.settings), busy(base, kind.settings);
        const PartId stays = alone.world().add(other);
        const PartId expected = alone.world().add(kind.part);
        PartId stranger = busy.world().add(other);
        const PartId kept = busy.world().add(kind.part);
        alone.settle();
        busy.settle();
        for (int round = 0; round < 4; ++round) {
            alone.run(12);
            busy.run(12);
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "round " << round;
            if (round == 0) {
                EXPECT_TRUE(busy.bits(stranger) == alone.bits(stays));
            }
            busy.world().remove(stranger);
            stranger = busy.add(other);
        }
        EXPECT_NE(busy.at(kept).first.particles, alone.at(expected).first.particles);
    }
}

TEST(World, GoesOnWithTheSameBitsInASmallerAndALargerScene) {
    const Settings settings{.substeps = 6, .contactRoom = 64};
    Play alone(ground(), settings), busy(ground(), settings);
    const PartId constant = alone.world().add(stranger(-30)), same = busy.world().add(stranger(-30));
    const PartId first = busy.world().add(stranger(50));
    const PartId kept = busy.world().add(slidingBoxes()), expected = alone.world().add(slidingBoxes());
    alone.settle();
    busy.settle();
    for (int round = 0; round < 3; ++round) {
        alone.run(12);
        busy.run(12);
        EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "round " << round;
        EXPECT_TRUE(busy.bits(same) == alone.bits(constant)) << "round " << round;
        if (round == 0) busy.remove(first);
        if (round == 1) busy.add(stranger());
    }
    EXPECT_EQ(busy.at(kept).first.particles, alone.at(expected).first.particles);
}

TEST(World, KeepsGrabsOfParticlesThatMoveToOtherIndices) {
    const Settings settings{.substeps = 5, .contactRoom = 64, .grabs = 2};
    Play alone(ground(), settings), busy(ground(), settings);
    alone.world().add(stranger());
    PartId first = busy.world().add(stranger());
    const PartId kept = busy.world().add(slidingBoxes()), expected = alone.world().add(slidingBoxes());
    alone.settle();
    busy.settle();
    const auto pull = [](Play& play, PartId part, int steps) {
        for (int s = 0; s < steps; ++s) {
            const float height = 0.1f + 0.01f * static_cast<float>(play.steps());
            const std::array<Grab, 2> grabs{
                {{.particle = play.particle(part, 70), .radius = 0.1f, .target = {0.3f, height, 0.2f}},
                 {.particle = play.particle(part, 5), .radius = 0.05f, .target = {-0.3f, 0.3f, 0}}}};
            play.step({.grabs = grabs});
        }
    };
    for (int round = 0; round < 4; ++round) {
        pull(alone, expected, 10);
        pull(busy, kept, 10);
        EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "round " << round;
        busy.world().remove(first);
        first = busy.add(stranger());
    }
    EXPECT_GT(busy.positions(kept)[70].y, 0.3f) << "it was lifted";
}

TEST(World, KeepsCutsWithTheirSurfaces) {
    Scene sheet, block, organ = test::organScene();
    addCloth(sheet, {.origin = {-0.5f, 0.4f, -0.5f},
                     .size = {16, 16},
                     .spacing = 0.06f,
                     .pinned = {0, 15},
                     .isCuttable = true});
    const Lattice lattice{.origin = {-0.2f, 0.1f, -0.2f},
                          .cells = {8, 5, 8},
                          .spacing = 0.05f,
                          .youngModulus = 4e4f,
                          .poissonRatio = 0.4f,
                          .radius = 0.02f,
                          .isCuttable = true};
    addLatticeSkin(block, lattice, addLattice(block, lattice), {0.8f, 0.2f, 0.2f});
    addSurfaceFaces(block, block.grids[0]);
    Scene cuttable; // another body that may be cut
    Lattice other = lattice;
    other.origin = {40, 0.1f, 0};
    other.cells = {4, 3, 5};
    addLatticeSkin(cuttable, other, addLattice(cuttable, other), {0.8f, 0.2f, 0.2f});
    for (const auto& [name, part] : {std::pair{"sheet", sheet}, {"block", block}, {"organ", organ}}) {
        SCOPED_TRACE(name);
        Scene base = ground();
        base.debris = 30;
        const Settings settings{.substeps = 4, .contactRoom = 64};
        Play alone(base, settings), busy(base, settings);
        alone.world().add(cuttable);
        PartId first = busy.world().add(cuttable);
        const PartId kept = busy.world().add(part), expected = alone.world().add(part);
        alone.settle();
        busy.settle();
        const std::array<test::Sweep, 3> strokes{
            test::sweepOf({.point = {0.013, 0.2, 0}, .normal = Eigen::Vector3d(1, 0.1, 0.2).normalized()}, 3),
            test::sweepOf({.point = {0, 0.27, 0.031}, .normal = Eigen::Vector3d(0.1, 1, 1).normalized()}, 3),
            test::sweepOf({.point = {0, 0.2, -0.07}, .normal = Eigen::Vector3d(0.1, 0.2, 1).normalized()},
                          3)};
        for (std::size_t round = 0; round < strokes.size(); ++round) {
            SCOPED_TRACE(round);
            Status before = alone.step({.blade = strokes[round].blade()}),
                   after = busy.step({.blade = strokes[round].blade()});
            EXPECT_EQ(after.linksCut, before.linksCut);
            if (round == 0) {
                EXPECT_GT(after.linksCut, 0u);
            }
            before = alone.run(5);
            after = busy.run(5);
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected));
            busy.world().remove(first);
            first = busy.add(cuttable); // behind what is kept
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "before the next step";
            before = alone.run(5);
            after = busy.run(5);
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "after steps";
            EXPECT_TRUE(busy.surface() == alone.surface());
            EXPECT_EQ(after.linksCutInAll, before.linksCutInAll);
            EXPECT_EQ(after.pieces, before.pieces);
            EXPECT_EQ(after.debris, before.debris);
            EXPECT_EQ(after.debrisParticles, before.debrisParticles);
            EXPECT_EQ(after.debrisMass, before.debrisMass);
            EXPECT_GT(after.pieces, 1u);
        }
    }
}
