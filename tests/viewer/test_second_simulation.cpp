// Tests of two solvers side by side: in step, with the same input, measured alike, drawn in two halves.
#include "played.hpp"

#include "sim/compile/compile.hpp"
#include "viewer/jobs/second_simulation.hpp"
#include "viewer/render/offscreen.hpp"

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
        : Played(text),
          beside(test::device(), opening.loaded, document.settings(), document.material(), shape, 1) {
        run([&](VkCommandBuffer commands) { beside.recordReset(commands); });
    }
    std::optional<SecondSimulation::Trouble> play(int steps, const StepHands& hands = {}) {
        for (int i = 0; i < steps; ++i) {
            run([&](VkCommandBuffer commands) {
                recordStep(commands, document, hands);
                beside.recordStep(commands, document, hands, 0, true);
                document.recordSkin(commands);
                beside.recordPicture(commands, 0, true);
                probe.record(commands);
            });
            if (auto trouble = beside.settle(0, &probe)) return trouble;
        }
        return std::nullopt;
    }
    std::vector<sim::layout::vec4> placesOf(const sim::Simulation& simulation) {
        return test::queue().download<sim::layout::vec4>(simulation.positions());
    }
    // Largest distance between the same particle in both simulations [m].
    double apart() {
        const auto here = placesOf(document.simulation()), there = placesOf(beside.simulation());
        double most = 0;
        for (std::size_t i = 0; i < here.size(); ++i)
            most = std::max(most, std::hypot(double{here[i].x} - double{there[i].x},
                                             double{here[i].y} - double{there[i].y},
                                             double{here[i].z} - double{there[i].z}));
        return most;
    }
    SecondSimulation beside;
};

TEST(BesideShape, IsReadFromTheCommandLineAndShown) {
    EXPECT_EQ(parseBeside("jacobi"), (BesideShape{sim::Solver::jacobi, 0}));
    EXPECT_EQ(parseBeside("gauss_seidel:4"), (BesideShape{sim::Solver::gaussSeidel, 4}));
    for (const char* bad : {"", "gauss", "split:", "split:0", "split:x", "split:4x", "split:-1", ":4"})
        EXPECT_FALSE(parseBeside(bad)) << bad;
    EXPECT_EQ(toText(BesideShape{sim::Solver::split, 7}), "split, 7 substeps");
    EXPECT_EQ(toText(BesideShape{sim::Solver::split, 1}), "split, 1 substep");
    for (const char* text : {"jacobi:3", "split", "gauss_seidel:12"})
        EXPECT_EQ(shapeOf(knobsOf(*parseBeside(text))), *parseBeside(text));
}

TEST(BesideShape, InsteadOfOneThatCannotPlayTheSceneHasFewerSubsteps) {
    const auto instead = [](std::uint32_t substeps) {
        return shapeInstead({.solver = sim::Solver::split, .substeps = substeps});
    };
    EXPECT_EQ(instead(37), (BesideShape{sim::Solver::split, 8}));
    EXPECT_EQ(instead(8), (BesideShape{sim::Solver::split, 4}));
    EXPECT_EQ(instead(2), (BesideShape{sim::Solver::split, 1}));
    EXPECT_EQ(instead(1), std::nullopt);
}

TEST(SecondSimulation, OfTheSameShapeHasTheSameBits) {
    Pair pair({sim::Solver::split, 4});
    ASSERT_FALSE(pair.play(5));
    EXPECT_EQ(pair.apart(), 0);
    ASSERT_TRUE(pair.beside.apart());
    EXPECT_EQ(pair.beside.apart()->largest, 0);
    EXPECT_EQ(pair.beside.document().steps(), 5u);
}

TEST(SecondSimulation, OfAnotherSolverFallsAlikeAndIsMeasured) {
    Pair pair({sim::Solver::gaussSeidel, 6});
    ASSERT_FALSE(pair.play(10));
    EXPECT_EQ(pair.beside.shape(), (BesideShape{sim::Solver::gaussSeidel, 6}));
    const double fallen = 0.5 * 9.81 * std::pow(10.0 / 60, 2);
    EXPECT_LT(pair.apart(), 0.1 * fallen) << "free fall is the same for all";
    ASSERT_TRUE(pair.beside.apart());
    EXPECT_GT(pair.beside.apart()->rms, 0);
    EXPECT_LT(pair.beside.apart()->rms, pair.beside.apart()->largest);
    EXPECT_NEAR(pair.beside.apart()->largest, pair.apart(), 1e-6 * pair.apart());
    EXPECT_EQ(pair.beside.facts().strainRms.count(), 10u);
    EXPECT_LT(pair.beside.facts().strainRms.newest(), 0.01f);
    EXPECT_FALSE(pair.beside.facts().phases.empty());
    EXPECT_EQ(pair.beside.facts().phases.front().ms.count(), 10u);
}

// Grabs the first particle.
StepHands holding() {
    StepHands hands;
    hands.grabs[0] = {.particle = 0,
                      .radius = 0.2f,
                      .target = {0.3f, 1.2f, 0},
                      .stiffness = 2000,
                      .damping = 90,
                      .maxAcceleration = 400};
    return hands;
}

TEST(SecondSimulation, IsHeldByTheSameHandAndPulledByTheSameGravity) {
    Pair pair({sim::Solver::jacobi, 8});
    pair.document.setGravity(2);
    StepHands hands = holding();
    const auto before = pair.placesOf(pair.beside.simulation());
    ASSERT_FALSE(pair.play(1, hands)); // grabs at the current position
    hands.grabs[0].target.y += 0.3f;
    ASSERT_FALSE(pair.play(20, hands));
    const auto held = pair.placesOf(pair.beside.simulation());
    EXPECT_GT(held[0].y, before[0].y + 0.1f) << "lifted";
    const auto first = pair.placesOf(pair.document.simulation());
    EXPECT_NEAR(first[0].y, held[0].y, 0.05f) << "both follow the hand";
    EXPECT_EQ(pair.beside.document().gravity().y, -2);
}

TEST(SecondSimulation, GoesOnWhereTheFirstStands) {
    Pair pair({sim::Solver::gaussSeidel, 6});
    StepHands hands = holding();
    ASSERT_FALSE(pair.play(12, hands));
    ASSERT_GT(pair.apart(), 0);
    pair.run([&](VkCommandBuffer commands) { pair.beside.recordTakeOver(commands, pair.document); });
    EXPECT_EQ(pair.apart(), 0);
    EXPECT_EQ(pair.beside.document().steps(), pair.document.steps());
    EXPECT_FALSE(pair.beside.apart());
    EXPECT_EQ(pair.beside.facts().strainRms.count(), 0u) << "what was measured was of another state";
    ASSERT_FALSE(pair.play(2, hands));
}

// The simulation that takes over needs the capacities of the other one.
TEST(SecondSimulation, GoesOnWithTheRoomAndTheMaterialThatTheFirstHas) {
    Pair pair({sim::Solver::split, 6}, block);
    ASSERT_FALSE(pair.play(3));
    ASSERT_TRUE(
        pair.document.makeSurfaceRoom(4 * pair.document.settings().cutSurfaceRoom + 200000, test::queue()));
    pair.document.turnNow({.stiffness = 0.5f});
    pair.run([&](VkCommandBuffer commands) { pair.step(commands); });
    ASSERT_EQ(pair.document.material(), sim::Material{.stiffness = 0.5f});
    EXPECT_FALSE(pair.beside.document().hasRoomOf(pair.document));
    SecondSimulation next(test::device(), pair.opening.loaded,
                          sim::withRoomsOf(pair.beside.document().settings(), pair.document.settings()),
                          pair.document.material(), pair.beside.shape(), 1);
    EXPECT_TRUE(next.document().hasRoomOf(pair.document));
    EXPECT_EQ(next.document().material(), pair.document.material());
    pair.run([&](VkCommandBuffer commands) { next.recordTakeOver(commands, pair.document); });
    const auto here = pair.placesOf(pair.document.simulation()), there = pair.placesOf(next.simulation());
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

TEST(SecondSimulation, RefusesWhatItsSolverHasNoFormFor) {
    EXPECT_EQ(refusalOf([] { Pair({sim::Solver::jacobi, 8}, block); }), cuts);
    const std::string touching = refusalOf([] {
        Pair({sim::Solver::jacobi, 8}, changed(hanging, "young_", "collides = true\nyoung_"));
    });
    EXPECT_NE(touching.find("not support particles that touch each other"), std::string::npos) << touching;
}

TEST(Document, RefusesAShapeForWhatTheSceneAsksForAlone) {
    const auto refusal = [](const std::string& text) {
        Scene scene(text);
        scene.document.setDefaults(scene.opening.loaded.defaults);
        scene.document.wantShape(sim::Solver::jacobi, 4);
        return refusalOf([&] { scene.document.reshape(test::queue()); });
    };
    EXPECT_EQ(refusal(block), "none") << "it may be cut, and collides by default, but nothing has cut it";
    const std::string touching = refusal(changed(block, "young_", "collides = true\nyoung_"));
    EXPECT_NE(touching.find("not support particles that touch each other"), std::string::npos) << touching;
}

const std::string sphere = "[solver]\nsubsteps = 4\n[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\n"
                           "voxel = 0.25\ncenter = [0, 2, 0]\n";

bool recovers(const Document& document) {
    return document.scene().grids.at(0).recoveryPressure > 0;
}

TEST(SecondSimulation, OfAnotherSolverGoesWithoutTheRecoveryThatTheSceneDoesNotAskFor) {
    for (const sim::Solver solver : {sim::Solver::jacobi, sim::Solver::gaussSeidel}) {
        Pair pair({solver, 6}, sphere);
        EXPECT_TRUE(recovers(pair.document));
        EXPECT_FALSE(recovers(pair.beside.document()));
        ASSERT_EQ(pair.beside.notes().size(), 1u);
        EXPECT_EQ(pair.beside.notes()[0],
                  std::string("mesh sphere: no recovery, cells that fold may stay so: it needs solver split, "
                              "the scene is solved by ") +
                      sim::solverName(solver));
        ASSERT_FALSE(pair.play(5));
        EXPECT_EQ(pair.beside.document().steps(), 5u);
        pair.run([&](VkCommandBuffer commands) { pair.beside.recordTakeOver(commands, pair.document); });
        ASSERT_FALSE(pair.play(5));
    }
    const Pair same({sim::Solver::split, 6}, sphere);
    EXPECT_TRUE(recovers(same.beside.document()));
    EXPECT_TRUE(same.beside.notes().empty());
    EXPECT_TRUE(recovers(Pair({sim::Solver::split, 0}, sphere).beside.document()));
    EXPECT_FALSE(recovers(Pair({sim::Solver::jacobi, 0}, sphere).beside.document()));
}

TEST(SecondSimulation, WarnsOfWhatLoadingInItsShapeWouldWarnOf) {
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

TEST(SecondSimulation, RefusesTheRecoveryThatTheSceneAsksFor) {
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
TEST(Document, LeavesDefaultRecoveryOutOfShapesWithoutAFormForIt) {
    Scene scene(sphere);
    Document& document = scene.document;
    const auto play = [&](int steps) {
        for (int i = 0; i < steps; ++i)
            scene.run([&](VkCommandBuffer commands) { document.recordStep(commands); });
    };
    document.setDefaults(scene.opening.loaded.defaults);
    play(3);
    document.wantShape(sim::Solver::gaussSeidel, 6);
    ASSERT_NO_THROW(document.reshape(test::queue()));
    EXPECT_FALSE(recovers(document));
    document.turnNow({.stiffness = 0.5f});
    play(3);
    EXPECT_FALSE(recovers(document));
    EXPECT_EQ(document.material(), sim::Material{.stiffness = 0.5f});
    document.wantShape(sim::Solver::split, 4);
    document.reshape(test::queue());
    EXPECT_TRUE(recovers(document));
    EXPECT_EQ(document.steps(), 6u);
}

TEST(SecondSimulation, IsDrawnInTheRightHalf) {
    Pair pair({sim::Solver::split, 4});
    constexpr VkExtent2D whole{161, 80}, half{81, 80};
    Offscreen both(test::device(), whole, pair.opening.light), one(test::device(), half, pair.opening.light);
    const auto drawBoth = [&] {
        pair.run([&](VkCommandBuffer commands) {
            pair.document.recordSkin(commands);
            pair.beside.recordPicture(commands, 0, false);
            const Overlay none;
            both.recordHalves(commands, pair.opening.camera,
                              {{{pair.document.simulation(), none}, {pair.beside.simulation(), none}}});
        });
        return both.read();
    };
    const auto drawOne = [&](const sim::Simulation& simulation) {
        pair.run([&](VkCommandBuffer commands) {
            pair.document.recordSkin(commands);
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
        pair.run([&](VkCommandBuffer commands) { recordStep(commands, pair.document, {}); });
    const Picture picture = drawBoth();
    const Picture left = drawOne(pair.document.simulation()), right = drawOne(pair.beside.simulation());
    EXPECT_EQ(differing(picture, left, 0), 0);
    EXPECT_EQ(differing(picture, right, whole.width - half.width), 0);
    EXPECT_GT(differing(picture, left, whole.width - half.width), 50) << "it has fallen";
}

} // namespace
} // namespace sinew::viewer
