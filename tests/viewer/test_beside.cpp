// Tests of two solvers side by side: in step, with the same input, measured alike, drawn in two halves.
#include "played.hpp"

#include "sim/compile/compile.hpp"
#include "viewer/beside.hpp"
#include "viewer/draw/offscreen.hpp"

#include <cmath>

namespace sinew::viewer {
namespace {

std::string changed(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
}
const std::string hanging = changed(changed(block, "cuttable = true\n", ""), "[[plane]]\n", "");

// A played scene with a second simulation beside it, in the order of the window's loop.
struct Pair : Played {
    explicit Pair(const BesideShape& shape, const std::string& text = hanging)
        : Played(text), beside(test::device(), opening.loaded, stage.settings(), stage.material(), shape, 1) {
        run([&](VkCommandBuffer commands) { beside.recordReset(commands); });
    }
    std::optional<Beside::Trouble> play(int steps, const StepHands& hands = {}) {
        for (int i = 0; i < steps; ++i) {
            run([&](VkCommandBuffer commands) {
                recordStep(commands, stage, hands);
                beside.recordStep(commands, stage, hands, 0, true);
                stage.recordSkin(commands);
                beside.recordPicture(commands, 0, true);
                probe.record(commands);
            });
            if (auto trouble = beside.settle(0)) return trouble;
        }
        return std::nullopt;
    }
    std::vector<sim::layout::vec4> placesOf(const sim::Simulation& simulation) {
        return test::queue().download<sim::layout::vec4>(simulation.positions());
    }
    // Largest distance between the same particle in both simulations [m].
    double apart() {
        const auto here = placesOf(stage.simulation()), there = placesOf(beside.simulation());
        double most = 0;
        for (std::size_t i = 0; i < here.size(); ++i)
            most = std::max(most, std::hypot(double{here[i].x} - double{there[i].x},
                                             double{here[i].y} - double{there[i].y},
                                             double{here[i].z} - double{there[i].z}));
        return most;
    }
    Beside beside;
};

TEST(BesideShape, IsReadFromTheCommandLineAndShown) {
    EXPECT_EQ(parseBeside("jacobi"), (BesideShape{sim::Solver::jacobi, 0}));
    EXPECT_EQ(parseBeside("gauss_seidel:4"), (BesideShape{sim::Solver::gaussSeidel, 4}));
    for (const char* bad : {"", "gauss", "split:", "split:0", "split:x", "split:4x", "split:-1", ":4"})
        EXPECT_FALSE(parseBeside(bad)) << bad;
    EXPECT_EQ(toText(BesideShape{sim::Solver::split, 7}), "split, 7 substeps");
    for (const char* text : {"jacobi:3", "split", "gauss_seidel:12"})
        EXPECT_EQ(shapeOf(knobsOf(*parseBeside(text))), *parseBeside(text));
}

TEST(Beside, OfTheSameShapeHasTheSameBits) {
    Pair pair({sim::Solver::split, 4});
    ASSERT_FALSE(pair.play(5));
    EXPECT_EQ(pair.apart(), 0);
    EXPECT_EQ(pair.beside.stage().steps(), 5u);
}

TEST(Beside, OfAnotherSolverFallsAlikeAndIsMeasured) {
    Pair pair({sim::Solver::gaussSeidel, 6});
    ASSERT_FALSE(pair.play(10));
    EXPECT_EQ(pair.beside.shape(), (BesideShape{sim::Solver::gaussSeidel, 6}));
    const double fallen = 0.5 * 9.81 * std::pow(10.0 / 60, 2);
    EXPECT_LT(pair.apart(), 0.1 * fallen) << "free fall is the same for all";
    EXPECT_EQ(pair.beside.facts().strainRms.count(), 10u);
    EXPECT_LT(pair.beside.facts().strainRms.newest(), 0.01f);
    EXPECT_FALSE(pair.beside.facts().phases.empty());
    EXPECT_EQ(pair.beside.facts().phases.front().ms.count(), 10u);
}

TEST(Beside, IsHeldByTheSameHandAndPulledByTheSameGravity) {
    Pair pair({sim::Solver::jacobi, 8});
    pair.stage.setGravity(2);
    StepHands hands;
    hands.grabs[0] = {.particle = 0,
                      .radius = 0.2f,
                      .target = {0.3f, 1.2f, 0},
                      .stiffness = 2000,
                      .damping = 90,
                      .maxAcceleration = 400};
    const auto before = pair.placesOf(pair.beside.simulation());
    ASSERT_FALSE(pair.play(1, hands)); // grabs at the current position
    hands.grabs[0].target.y += 0.3f;
    ASSERT_FALSE(pair.play(20, hands));
    const auto held = pair.placesOf(pair.beside.simulation());
    EXPECT_GT(held[0].y, before[0].y + 0.1f) << "lifted";
    const auto first = pair.placesOf(pair.stage.simulation());
    EXPECT_NEAR(first[0].y, held[0].y, 0.05f) << "both follow the hand";
    EXPECT_EQ(pair.beside.stage().gravity().y, -2);
}

TEST(Beside, GoesOnWhereTheFirstStands) {
    Pair pair({sim::Solver::gaussSeidel, 6});
    StepHands hands;
    hands.grabs[0] = {.particle = 0,
                      .radius = 0.2f,
                      .target = {0.3f, 1.2f, 0},
                      .stiffness = 2000,
                      .damping = 90,
                      .maxAcceleration = 400};
    ASSERT_FALSE(pair.play(12, hands));
    ASSERT_GT(pair.apart(), 0);
    pair.run([&](VkCommandBuffer commands) { pair.beside.recordTakeOver(commands, pair.stage); });
    EXPECT_EQ(pair.apart(), 0);
    EXPECT_EQ(pair.beside.stage().steps(), pair.stage.steps());
    EXPECT_EQ(pair.beside.facts().strainRms.count(), 0u) << "what was measured was of another state";
    ASSERT_FALSE(pair.play(2, hands));
}

// The simulation that takes over needs the capacities of the other one.
TEST(Beside, GoesOnWithTheRoomAndTheMaterialThatTheFirstHas) {
    Pair pair({sim::Solver::split, 6}, block);
    ASSERT_FALSE(pair.play(3));
    ASSERT_TRUE(pair.stage.makeSurfaceRoom(4 * pair.stage.settings().cutSurfaceRoom + 200000, test::queue()));
    pair.stage.turnNow({.stiffness = 0.5f});
    pair.run([&](VkCommandBuffer commands) { pair.step(commands); });
    ASSERT_EQ(pair.stage.material(), sim::Material{.stiffness = 0.5f});
    EXPECT_FALSE(pair.beside.stage().hasRoomOf(pair.stage));
    Beside next(test::device(), pair.opening.loaded,
                sim::withRoomsOf(pair.beside.stage().settings(), pair.stage.settings()),
                pair.stage.material(), pair.beside.shape(), 1);
    EXPECT_TRUE(next.stage().hasRoomOf(pair.stage));
    EXPECT_EQ(next.stage().material(), pair.stage.material());
    pair.run([&](VkCommandBuffer commands) { next.recordTakeOver(commands, pair.stage); });
    const auto here = pair.placesOf(pair.stage.simulation()), there = pair.placesOf(next.simulation());
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i)
        EXPECT_TRUE(here[i].x == there[i].x && here[i].y == there[i].y && here[i].z == there[i].z) << i;
}

template <typename Act> std::string refusalOf(const Act& act) {
    try {
        act();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

// The scene asks for a block that may be cut. Its contacts come by default and are no reason.
const std::string cuts = "grid[0] \"block\": may be cut, which solver jacobi does not support: use split";

TEST(Beside, RefusesWhatItsSolverHasNoFormFor) {
    EXPECT_EQ(refusalOf([] { Pair({sim::Solver::jacobi, 8}, block); }), cuts);
    const std::string touching = refusalOf([] {
        Pair({sim::Solver::jacobi, 8}, changed(hanging, "young_", "collides = true\nyoung_"));
    });
    EXPECT_NE(touching.find("not support particles that touch each other"), std::string::npos) << touching;
}

TEST(Stage, RefusesAShapeForWhatTheSceneAsksForAlone) {
    const auto refusal = [](const std::string& text) {
        Scene scene(text);
        scene.stage.setDefaults(scene.opening.loaded.defaults);
        scene.stage.wantShape(sim::Solver::jacobi, 4);
        return refusalOf([&] { scene.stage.reshape(test::queue()); });
    };
    EXPECT_EQ(refusal(block), "none") << "it may be cut, and collides by default, but nothing has cut it";
    const std::string touching = refusal(changed(block, "young_", "collides = true\nyoung_"));
    EXPECT_NE(touching.find("not support particles that touch each other"), std::string::npos) << touching;
}

const std::string sphere = "[solver]\nsubsteps = 4\n[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\n"
                           "voxel = 0.25\ncenter = [0, 2, 0]\n";

bool recovers(const Stage& stage) {
    return stage.scene().grids.at(0).recoveryPressure > 0;
}

TEST(Beside, OfAnotherSolverGoesWithoutTheRecoveryThatTheSceneDoesNotAskFor) {
    for (const sim::Solver solver : {sim::Solver::jacobi, sim::Solver::gaussSeidel}) {
        Pair pair({solver, 6}, sphere);
        EXPECT_TRUE(recovers(pair.stage));
        EXPECT_FALSE(recovers(pair.beside.stage()));
        ASSERT_EQ(pair.beside.notes().size(), 1u);
        EXPECT_EQ(pair.beside.notes()[0],
                  std::string("mesh sphere: no recovery, cells that fold may stay so: it needs solver split, "
                              "the scene is solved by ") +
                      sim::solverName(solver));
        ASSERT_FALSE(pair.play(5));
        EXPECT_EQ(pair.beside.stage().steps(), 5u);
        pair.run([&](VkCommandBuffer commands) { pair.beside.recordTakeOver(commands, pair.stage); });
        ASSERT_FALSE(pair.play(5));
    }
    const Pair same({sim::Solver::split, 6}, sphere);
    EXPECT_TRUE(recovers(same.beside.stage()));
    EXPECT_TRUE(same.beside.notes().empty());
    EXPECT_TRUE(recovers(Pair({sim::Solver::split, 0}, sphere).beside.stage()));
    EXPECT_FALSE(recovers(Pair({sim::Solver::jacobi, 0}, sphere).beside.stage()));
}

TEST(Beside, WarnsOfWhatLoadingInItsShapeWouldWarnOf) {
    const std::string stiff = changed(changed(hanging, "2e4", "2e6"), "substeps = 4", "substeps = 60");
    const auto beside = [&](std::uint32_t substeps) {
        return Pair({sim::Solver::split, substeps}, stiff).beside.warnings();
    };
    EXPECT_EQ(beside(60).size(), 0u);
    EXPECT_EQ(beside(0).size(), 0u);
    ASSERT_EQ(beside(2).size(), 1u);
    EXPECT_NE(beside(2)[0].find("elastic links are softer than asked"), std::string::npos) << beside(2)[0];
    EXPECT_EQ(beside(2), openText(changed(stiff, "substeps = 60", "substeps = 2")).loaded.warnings);
}

TEST(Beside, RefusesTheRecoveryThatTheSceneAsksFor) {
    try {
        const Pair pair({sim::Solver::jacobi, 6}, sphere + "recovery = 2\n");
        FAIL() << "it is played";
    } catch (const std::invalid_argument& error) {
        const std::string why = error.what();
        EXPECT_NE(why.find("grid[0] \"sphere\": "), std::string::npos) << why;
        EXPECT_NE(why.find(": use split"), std::string::npos) << why;
    }
}

// A change of the solver, as a replay makes it, leaves out a default recovery that the solver does not
// support.
TEST(Stage, LeavesDefaultRecoveryOutOfShapesWithoutAFormForIt) {
    Scene scene(sphere);
    Stage& stage = scene.stage;
    const auto play = [&](int steps) {
        for (int i = 0; i < steps; ++i)
            scene.run([&](VkCommandBuffer commands) { stage.recordStep(commands); });
    };
    stage.setDefaults(scene.opening.loaded.defaults);
    play(3);
    stage.wantShape(sim::Solver::gaussSeidel, 6);
    ASSERT_NO_THROW(stage.reshape(test::queue()));
    EXPECT_FALSE(recovers(stage));
    stage.turnNow({.stiffness = 0.5f});
    play(3);
    EXPECT_FALSE(recovers(stage));
    EXPECT_EQ(stage.material(), sim::Material{.stiffness = 0.5f});
    stage.wantShape(sim::Solver::split, 4);
    stage.reshape(test::queue());
    EXPECT_TRUE(recovers(stage));
    EXPECT_EQ(stage.steps(), 6u);
}

TEST(Beside, IsDrawnInTheRightHalf) {
    Pair pair({sim::Solver::split, 4});
    constexpr VkExtent2D whole{161, 80}, half{81, 80};
    Offscreen both(test::device(), whole, pair.opening.light), one(test::device(), half, pair.opening.light);
    const auto drawBoth = [&] {
        pair.run([&](VkCommandBuffer commands) {
            pair.stage.recordSkin(commands);
            pair.beside.recordPicture(commands, 0, false);
            const Overlay none;
            both.recordHalves(commands, pair.opening.camera,
                              {{{pair.stage.simulation(), none}, {pair.beside.simulation(), none}}});
        });
        return both.read();
    };
    const auto drawOne = [&](const sim::Simulation& simulation) {
        pair.run([&](VkCommandBuffer commands) {
            pair.stage.recordSkin(commands);
            pair.beside.recordPicture(commands, 0, false);
            one.record(commands, pair.opening.camera, simulation);
        });
        return one.read();
    };
    // Number of pixels in which a half differs from its own picture, except for the line between the halves.
    const auto differing = [&](const Picture& picture, const Picture& own, std::uint32_t from) {
        int count = 0;
        for (std::uint32_t y = 0; y < half.height; ++y)
            for (std::uint32_t x = 2; x + 2 < half.width; ++x)
                for (std::uint32_t part = 0; part < 3; ++part)
                    count += std::abs(picture.pixels[4 * (y * whole.width + from + x) + part] -
                                      own.pixels[4 * (y * half.width + x) + part]) > 2
                                 ? 1
                                 : 0;
        return count;
    };
    for (int i = 0; i < 20; ++i) // only the first simulation
        pair.run([&](VkCommandBuffer commands) { recordStep(commands, pair.stage, {}); });
    const Picture picture = drawBoth();
    const Picture left = drawOne(pair.stage.simulation()), right = drawOne(pair.beside.simulation());
    EXPECT_EQ(differing(picture, left, 0), 0);
    EXPECT_EQ(differing(picture, right, whole.width - half.width), 0);
    EXPECT_GT(differing(picture, left, whole.width - half.width), 50) << "it has fallen";
}

} // namespace
} // namespace sinew::viewer
